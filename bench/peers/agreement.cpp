// The limits are derived as follows. A peer closes the loops by an elimination in n = 24 coordinates, with a backward
// error of n ε in each coefficient. The efforts amplify it by the condition number of the map between the platform's
// twist and the joints' rates. That is κ(B) over the smallest of the legs' margins, to which their 3 × 3 parts are
// proportional:
//   δτ / max τ ≤ n ε κ                                                                                           (1)
// Accelerations are a difference of wrenches as large as that of the motors, w = T⁻ᵀτ, which the machine's mass matrix
// turns into accelerations; they may be much smaller than that:
//   δa / max a ≤ n ε κ ‖M⁻¹‖ ‖w‖ / max a                                                                         (2)
// Angular parts are multiplied by the machine's length throughout.

#include "bench/peers/agreement.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ursula::bench {
namespace {

constexpr double unknowns = 24, eps = Eigen::NumTraits<double>::epsilon();

double conditionOf(const Matrix6d& A) {
  const auto values = A.jacobiSvd().singularValues();
  return values(0) / values(5);
}

/// [ω; v] as [L ω; v].
Vector6d scaled(Vector6d twist, double length) {
  twist.head<3>() *= length;
  return twist;
}

Vector6d commanded(const Motion<double>& motion) {
  Vector6d out;
  out << motion.omega_dot, motion.p_ddot;
  return out;
}

/// The largest over the poses.
struct Scales {
  double effort = 0, acceleration = 0, condition = 0, wrench_as_acceleration = 0;
};

Scales scalesOf(const Poses& poses) {
  Scales out;
  Workspace<double> work;
  const double L = poses.solver.length();
  Vector6d units = Vector6d::Ones();
  units.head<3>() /= L;
  for (std::size_t k = 0; k < poses.motions.size(); ++k) {
    const Motion<double>& motion = poses.motions[k];
    poses.solver.inverseKinematics(motion, work);
    poses.solver.jacobians(motion, work);
    double margin = 1;
    for (int leg = 0; leg < poses.manipulator().legCount(); ++leg) {
      const LegMargins<double> margins = poses.solver.margins(work, leg);
      margin = std::min(margin, margins.sine / margins.leverage);
    }
    const Matrix6d B = poses.solver.B(work) * units.asDiagonal();
    const Matrix6d M = units.asDiagonal() * poses.solver.massMatrixAtP(motion, work) * units.asDiagonal();
    const Vector6d wrench =
        units.asDiagonal() * poses.solver.T(work).transpose().partialPivLu().solve(poses.efforts[k]);
    out.condition = std::max(out.condition, conditionOf(B) / margin);
    out.effort = std::max(out.effort, poses.efforts[k].cwiseAbs().maxCoeff());
    out.acceleration = std::max(out.acceleration, scaled(commanded(motion), L).norm());
    out.wrench_as_acceleration =
        std::max(out.wrench_as_acceleration, wrench.norm() / M.jacobiSvd().singularValues()(5));
  }
  return out;
}

void requireAll(const std::vector<Vector6d>& answers, const Poses& poses) {
  if (answers.size() != poses.motions.size()) throw std::invalid_argument("an answer for each pose is needed");
}

Agreement inverse(const Answers& answers, const Poses& poses, const Scales& scales) {
  requireAll(answers.efforts, poses);
  double value = 0;
  for (std::size_t k = 0; k < poses.motions.size(); ++k)
    value = larger(value, (answers.efforts[k] - poses.efforts[k]).norm() / scales.effort);
  return {answers.name, "inverse",
          value,        unknowns * eps * scales.condition,
          value,        fmt::format("{:g} eps times a condition number of {:.3g}", unknowns, scales.condition)};
}

Agreement direct(const Answers& answers, const Poses& poses, const Scales& scales) {
  requireAll(answers.twist_rates, poses);
  const double L = poses.solver.length(), size = scales.acceleration;
  const double amplification = scales.wrench_as_acceleration / size;
  const double rounding = unknowns * eps * scales.condition * amplification;
  Agreement out{answers.name,
                "direct",
                0,
                rounding,
                0,
                fmt::format("{:g} eps times a condition number of {:.3g}, and {:.3g} as the motors' wrench makes so "
                            "much more acceleration than is left",
                            unknowns, scales.condition, amplification)};
  double softness = 0;
  for (std::size_t k = 0; k < poses.motions.size(); ++k) {
    Vector6d away = answers.twist_rates[k] - commanded(poses.motions[k]);
    out.value = larger(out.value, scaled(away, L).norm() / size);
    if (!answers.known.empty()) {
      away -= answers.known[k].left_out;
      softness = larger(softness, scaled(answers.known[k].softness, L).norm() / size);
    }
    out.remainder = larger(out.remainder, scaled(away, L).norm() / size);
  }
  if (!answers.known.empty()) {
    out.limit += softness;
    out.basis = "what its yielding constraints leave, beside the term that it leaves out";
  }
  return out;
}

}  // namespace

Answers answersOf(Peer& peer, const Poses& poses) {
  Answers out{peer.name(), {}, {}, {}};
  TreeCoordinates at;
  bool exact = true;
  for (std::size_t k = 0; k < poses.motions.size(); ++k) {
    peer.coordinates(poses.motions[k], poses.joints[k], at);
    if (peer.hasInverse()) out.efforts.push_back(peer.inverseDynamics(at));
    out.twist_rates.push_back(peer.directDynamics(at, poses.efforts[k]));
    out.known.push_back(peer.deviation(at, poses.efforts[k]));
    exact = exact && out.known.back().softness.isZero(0);
  }
  if (exact) out.known.clear();
  return out;
}

std::vector<Agreement> agreementsOf(const Answers& answers, const Poses& poses) {
  const Scales scales = scalesOf(poses);
  std::vector<Agreement> out;
  if (!answers.efforts.empty()) out.push_back(inverse(answers, poses, scales));
  if (!answers.twist_rates.empty()) out.push_back(direct(answers, poses, scales));
  return out;
}

std::vector<Agreement> agreementsOf(const std::vector<std::unique_ptr<Peer>>& peers, const Poses& poses) {
  std::vector<Agreement> out;
  for (const std::unique_ptr<Peer>& peer : peers)
    for (Agreement& agreement : agreementsOf(answersOf(*peer, poses), poses)) out.push_back(std::move(agreement));
  return out;
}

std::string toText(const Agreement& agreement) {
  return fmt::format(
      "{} {}: {:.2g} of the largest{}, limit {:.2g} ({}){}", agreement.name, agreement.task, agreement.value,
      agreement.remainder == agreement.value ? "" : fmt::format(", {:.2g} beside what is known", agreement.remainder),
      agreement.limit, agreement.basis, agreement.holds() ? "" : ": DOES NOT AGREE");
}

}  // namespace ursula::bench

#include "parts/prove/effect.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nocsolver/errors.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

constexpr int instants = 31;

double instantOf(const Scenario& scenario, int k) { return scenario.trajectory->duration() * (k + 0.37) / instants; }

constexpr std::size_t of_dynamics = 2;  ///< number of answers for dynamics; they come first

/// One vector for each kind of quantity.
std::vector<Eigen::VectorXd> answersOf(const Subject& subject, const Motion<double>& motion) {
  const Vector6d torques = subject.torques(motion);
  const KinematicAnswer kinematics = subject.kinematics(motion);
  std::vector<Eigen::VectorXd> out = {torques, subject.accelerations(motion, torques)};
  const auto joints = [&out](const JointVariables<double>& q) { out.insert(out.end(), {q.phi, q.psi, q.theta, q.d}); };
  joints(kinematics.joints.q);
  joints(kinematics.joints.q_dot);
  joints(kinematics.joints.q_ddot);
  out.insert(out.end(), {kinematics.T.reshaped(), kinematics.T_rate.reshaped()});
  for (const BodyMotion<double>& body : kinematics.bodies)
    out.insert(out.end(), {body.c, body.R.reshaped(), body.twist, body.twist_rate});
  return out;
}

/// Returns the allowed difference: that of two right formulations, with some margin and at least a few units of the
/// last place.
Eigen::VectorXd roomBetween(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const double tolerance = 16 * (a - b).cwiseAbs().maxCoeff() + 64 * eps * a.cwiseAbs().maxCoeff();
  return Eigen::VectorXd::Constant(a.size(), tolerance);
}

}  // namespace

RightAnswers::RightAnswers(const Scenario& scenario) {
  const Subject right = nocSubject(*scenario.manipulator, scenario.load);
  const Subject other = longNocSubject(*scenario.manipulator, scenario.load);
  for (int k = 0; k < instants; ++k) try {
      Instant instant{scenario.trajectory->at(instantOf(scenario, k)), {}};
      const auto a = answersOf(right, instant.motion), b = answersOf(other, instant.motion);
      for (std::size_t i = 0; i < a.size(); ++i) instant.answers.push_back({a[i], roomBetween(a[i], b[i])});
      instants_.push_back(std::move(instant));
    } catch (const PoseError&) {
      continue;  // this instant is skipped
    }
}

RightAnswers::Off RightAnswers::offIn(const Subject& subject) const {
  if (instants_.empty()) return Off::dynamics;  // nothing is known about the defect
  Off out = Off::nothing;
  for (const Instant& instant : instants_) try {
      const auto answers = answersOf(subject, instant.motion);
      for (std::size_t i = 0; i < answers.size(); ++i) {
        const auto& [right, tolerance] = instant.answers[i];
        if (((answers[i] - right).array().abs() <= tolerance.array()).all()) continue;
        if (i < of_dynamics) return Off::dynamics;
        out = Off::kinematics;
      }
    } catch (const PoseError&) {
      return Off::dynamics;
    }
  return out;
}

bool movesAlike(const Scenario& a, const Scenario& b) {
  if (a.trajectory == b.trajectory || a.trajectory->duration() != b.trajectory->duration()) return false;
  using M = Motion<double>;
  const auto alike = [&a, &b](const auto& part) {
    double size = 0, off = 0;
    for (int k = 0; k < instants; ++k) {
      const M x = a.trajectory->at(instantOf(a, k)), y = b.trajectory->at(instantOf(a, k));
      size = larger(size, part(x).norm());
      off = larger(off, (part(x) - part(y)).norm());
    }
    return off <= 16 * eps * size;
  };
  return alike([](const M& m) { return m.Q; }) && alike([](const M& m) { return m.p; }) &&
         alike([](const M& m) { return m.omega; }) && alike([](const M& m) { return m.p_dot; }) &&
         alike([](const M& m) { return m.omega_dot; }) && alike([](const M& m) { return m.p_ddot; });
}

bool sayOtherwise(const std::vector<Check>& a, const std::vector<Check>& b, double share) {
  const auto alike = [share](const Check& one, const Check& other) {
    if (one.name != other.name) return false;
    if (one.verdict == Verdict::not_applicable || other.verdict == Verdict::not_applicable) return true;
    const bool both_nan = std::isnan(one.value) && std::isnan(other.value);
    const bool same = both_nan || one.value == other.value;
    // Shares of limits are compared, because rounding may select another instant with another limit.
    const double apart = WorstShare::share(one.value, one.limit) - WorstShare::share(other.value, other.limit);
    return one.verdict == other.verdict && (same || std::abs(apart) <= share);
  };
  return !std::equal(a.begin(), a.end(), b.begin(), b.end(), alike);
}

}  // namespace ursula

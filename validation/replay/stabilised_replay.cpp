#include "validation/replay/stabilised_replay.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <new>

#include "nocsolver/noc/noc.h"
#include "simbody/simbody_loop.h"
#include "validation/replay/radau.h"
#include "validation/replay/windows.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

namespace odeint = boost::numeric::odeint;

/// ω_f over the growth rate of deviations: the poles are −ω_f ± λ, and the term is 4/3 of a constant torque error.
constexpr double stiffness = 2;
constexpr double answer = stiffness * stiffness / (stiffness * stiffness - 1);
/// Largest step times ω_f. The fastest pole, −ω_f − λ, then stays well within the stability region of Dormand and
/// Prince's pair.
constexpr double largest_step = 1.5;
/// The smallest step that is retried with a quarter of it, over the motion's duration.
constexpr double shortest_step = 1e-12;
/// A deviation, m or rad, that is too large to follow: the torques are wrong, and their error is known.
constexpr double lost = 0.1;
constexpr long max_evaluations = 200000;
/// Limit of evaluations for torques that are known to be wrong, of which only the size of the error is sought.
constexpr long max_evaluations_of_wrong = 2000;
/// The relative accuracy of a deviation under wrong torques.
constexpr double three_digits = 1e-3;

/// [δϑ ω; δp ω; δω; δṗ] of the platform, in B: Q = exp(δϑ) Q_c, the others are differences from the commanded motion.
/// The frequency factor makes one tolerance suit both halves.
using Deviation = std::array<double, 12>;

Vector3d part(const Deviation& x, int k) { return Eigen::Map<const Vector3d>(x.data() + 3 * k); }

/// The rotation exp(ϑ) − 1 applied to v, exact to rounding of the small result (Rodrigues).
Vector3d turned(const Vector3d& theta, const Vector3d& v) {
  const double angle = theta.norm();
  const double half = angle > 0 ? std::sin(angle / 2) / (angle / 2) : 1;
  const double full = angle > 0 ? std::sin(angle) / angle : 1;
  const Vector3d across = theta.cross(v);
  return full * across + half * half / 2 * theta.cross(across);
}

/// ϑ̇ for the angular velocity of exp(ϑ) in axes fixed in B (Bortz, IEEE Trans. Aerosp. Electron. Syst. 7 (1971) 61,
/// with body-fixed axes, where the middle term is positive).
Vector3d rotationVectorRate(const Vector3d& theta, const Vector3d& spin) {
  const double angle = theta.norm();
  const Vector3d across = theta.cross(spin);
  const double third = angle > 1e-3 ? (1 - angle / 2 / std::tan(angle / 2)) / (angle * angle) : 1.0 / 12;
  return spin - 0.5 * across + third * theta.cross(across);
}

/// The platform's deviation under given torques and the stabilising term. The legs follow the platform, so the loops
/// stay closed and gaps cannot accumulate.
class Stabilised {
 public:
  template <class Sample>
  Stabilised(const Scenario& scenario, const Amplification& amplification, const std::vector<Sample>& samples)
      : trajectory_(*scenario.trajectory),
        amplification_(amplification),
        loop_(*scenario.manipulator, SimbodyLoop::Topology::ball_per_leg, scenario.load),
        solver_(*scenario.manipulator) {
    for (const Sample& sample : samples) scale_ = std::max(scale_, frequency(sample.motion.t));
  }

  /// The largest torque per unit deviation, N·m/(m/s).
  double gain(const Motion<double>& motion) { return 3 * scale_ * inertia(motion).norm(); }

  bool isLost(const Deviation& x) const { return !(offset(x, 0).norm() < lost && offset(x, 1).norm() < lost); }

  /// The term's frequency ω_f at t, 1/s.
  double frequency(double t) const {
    return stiffness * std::max(amplification_.growthRate(t), 1 / trajectory_.duration());
  }

  long evaluations() const { return evaluations_; }
  bool stiff() const { return isStiff(amplification_, trajectory_.duration()); }

  /// Announces a step of Dormand and Prince's pair from t.
  void foreseeStep(const Subject& subject, double t, double h) const {
    if (subject.foresee && stiff())
      foresee(subject, trajectory_, RadauStep::instants(t, h));
    else if (subject.foresee)
      foresee(subject, trajectory_,
              {t, t + h * (1.0 / 5), t + h * (3.0 / 10), t + h * (4.0 / 5), t + h * (8.0 / 9), t + h});
  }

  void rate(const SimbodyLoop::TorqueHistory& torques, const Deviation& x, Deviation& out, double t) {
    ++evaluations_;
    const Motion<double> commanded = trajectory_.at(t);
    const Vector3d theta = offset(x, 0);
    Motion<double> motion = commanded;
    for (int k = 0; k < 3; ++k) motion.Q.col(k) += turned(theta, commanded.Q.col(k));
    motion.p += offset(x, 1);
    motion.omega += part(x, 2);
    motion.p_dot += part(x, 3);
    loop_.place(motion);
    loop_.accelerate(torques(t) + term(x, commanded));
    const Motion<double> moved = loop_.platform();
    Eigen::Map<Eigen::Matrix<double, 12, 1>>(out.data())
        << scale_ * rotationVectorRate(theta, part(x, 2) - turned(theta, commanded.omega)),
        scale_ * part(x, 3), moved.omega_dot - commanded.omega_dot, moved.p_ddot - commanded.p_ddot;
  }

  /// The torques that the term adds, N·m.
  Vector6d term(const Deviation& x, const Motion<double>& commanded) {
    const double omega = frequency(commanded.t);
    Vector6d pull;
    pull << omega * omega * offset(x, 0) + 2 * omega * part(x, 2),
        omega * omega * offset(x, 1) + 2 * omega * part(x, 3);
    return -inertia(commanded) * pull;
  }

  /// T_PᵀM_P: torques per acceleration of the platform.
  Matrix6d inertia(const Motion<double>& motion) {
    solver_.inverseKinematics(motion, work_);
    solver_.jacobians(motion, work_);
    return solver_.platformShaping(work_).transpose() * solver_.massMatrixAtP(motion, work_);
  }

 private:
  /// δϑ or δp.
  Vector3d offset(const Deviation& x, int k) const { return part(x, k) / scale_; }

  const Trajectory& trajectory_;
  const Amplification& amplification_;
  SimbodyLoop loop_;
  Noc<double> solver_;
  NocWorkspace<double> work_;
  double scale_ = 0;  ///< the largest frequency, 1/s
  long evaluations_ = 0;
};

/// Takes one step, like try_step of Boost.Odeint's controlled steppers.
template <class RateAt>
bool stiffStep(RadauStep& radau, const RateAt& rate, Deviation& deviation, double& t, double& h,
               const RadauStep::Tolerance& tolerance) {
  const auto arrayOf = [](const std::vector<double>& x) {
    Deviation out;
    std::copy(x.begin(), x.end(), out.begin());
    return out;
  };
  const RadauStep::Rate of_vectors = [&](const std::vector<double>& x, std::vector<double>& out, double at) {
    Deviation found;
    rate(arrayOf(x), found, at);
    out.assign(found.begin(), found.end());
  };
  std::vector<double> x(deviation.begin(), deviation.end());
  const std::optional<double> error = radau.tryStep(of_vectors, x, t, h, tolerance);
  const bool accepted = error && *error <= 1;
  if (accepted) {
    deviation = arrayOf(x);
    t += h;
  }
  h *= changeOfStep(error);
  return accepted;
}

/// Follows the deviation from the commanded state to the end of the motion, with the tolerance and the limit of
/// `found`. `torques` are the subject's.
void follow(Stabilised& loop, const Subject& subject, const SimbodyLoop::TorqueHistory& torques,
            const Trajectory& trajectory, const Deadline& deadline, StabilisedReplay& found) {
  const bool stiff = loop.stiff();
  RadauStep radau;
  const auto stepperOf = [](double absolute) {
    return odeint::make_controlled(absolute, three_digits, odeint::runge_kutta_dopri5<Deviation>());
  };
  double tolerance = found.tolerance;
  const double limit = found.limit;
  auto stepper = stepperOf(tolerance);
  const auto rate = [&](const Deviation& x, Deviation& out, double at) { loop.rate(torques, x, out, at); };
  Deviation deviation{};
  const double end = trajectory.duration();
  // With a stiff right-hand side, a stage of too long a step may leave the machine's reach. That counts as a rejected
  // step unless no shorter one helps.
  const auto accepted = [&](double& at, double& h) {
    const double tried = h;
    loop.foreseeStep(subject, at, h);
    try {
      if (stiff) return stiffStep(radau, rate, deviation, at, h, {tolerance, three_digits});
      return stepper.try_step(rate, deviation, at, h) == odeint::success;
    } catch (const std::exception& error) {
      if (isShortage(error) || !(tried > shortest_step * end)) throw;
      h = tried / 4;
      return false;
    }
  };
  double t = 0, step = end;
  while (t < end && found.stopped.empty()) {
    const double left = end - t;
    step = std::min({step, largest_step / loop.frequency(t), left});
    const bool last = step == left;
    deadline.require();
    if (accepted(t, step)) {
      if (last) t = end;
      ++found.steps;
      const double torque = loop.term(deviation, trajectory.at(t)).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
      if (exceeds(torque, found.torque)) found.torque = torque, found.t = t;
      // Under wrong torques, no coordinate need be more accurate than the largest.
      const double size = three_digits * Eigen::Map<const Eigen::Matrix<double, 12, 1>>(deviation.data()).norm();
      if (found.torque > limit && size > 2 * tolerance) stepper = stepperOf(tolerance = size);
      if (loop.isLost(deviation)) found.stopped = "the machine was lost";
    }
    const long most = found.torque > limit ? max_evaluations_of_wrong : max_evaluations;
    if (loop.evaluations() > most && found.stopped.empty()) {
      found.stopped = fmt::format("{} derivative evaluations did not reach the end, but ended", most);
      found.too_long = true;
    }
    found.stopped_at = t;
  }
}

/// Derives the limit and the tolerance from the samples.
template <class Sample>
StabilisedReplay planned(Stabilised& loop, const std::vector<Sample>& samples) {
  StabilisedReplay out;
  double gain = 0;
  for (const Sample& sample : samples) {
    const double here = 2 * sample.conditioning.torqueRounding() + sample.conditioning.rounding(Rounded::effort);
    if (!out.noisiest || !(here <= out.rounding)) out.noisiest = sample.conditioning, out.rounding = here;
    gain = std::max(gain, loop.gain(sample.motion));
  }
  out.answer = answer;
  out.limit = (answer + 0.5) * out.rounding;
  out.tolerance = 0.5 * out.rounding / gain;
  return out;
}

}  // namespace

template <class Sample>
StabilisedReplay stabilisedReplay(const Scenario& scenario, const Subject& subject, const Amplification& amplification,
                                  const std::vector<Sample>& samples, const StabilisedReplay* known,
                                  const Deadline& deadline) {
  Stabilised loop(scenario, amplification, samples);
  const SimbodyLoop::TorqueHistory torques = [&](double t) { return subject.torques(scenario.trajectory->at(t)); };
  StabilisedReplay found = planned(loop, samples);
  if (!std::isfinite(found.limit)) return found;  // it could prove nothing
  if (known != nullptr && known->tolerance == found.tolerance && known->limit == found.limit &&
      known->asked.sameFrom(torques)) {
    const std::optional<Conditioning> noisiest = found.noisiest;
    found = *known;
    found.noisiest = noisiest;
    return found;
  }
  try {
    follow(loop, subject, found.asked.recorded(torques), *scenario.trajectory, deadline, found);
  } catch (const std::exception& error) {  // earlier results are kept
    if (isShortage(error)) throw;
    found.stopped = error.what();
    found.gave_up = true;
  }
  found.evaluations = loop.evaluations();
  return found;
}

template StabilisedReplay stabilisedReplay(const Scenario&, const Subject&, const Amplification&,
                                           const std::vector<Conditions>&, const StabilisedReplay*, const Deadline&);
template StabilisedReplay stabilisedReplay(const Scenario&, const Subject&, const Amplification&,
                                           const std::vector<PointwiseSample>&, const StabilisedReplay*,
                                           const Deadline&);

}  // namespace ursula

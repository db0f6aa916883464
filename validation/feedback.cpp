#include "validation/feedback.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>

#include "nocsolver/solver.h"
#include "validation/judge_replay.h"
#include "validation/replay.h"

namespace ursula {
namespace {

/// Coarser than the replay: the term forgets integration errors instead of amplifying them.
constexpr double feedback_tolerance = 1e-11;

class Stabiliser {
 public:
  Stabiliser(const Scenario& scenario, double frequency)
      : trajectory_(*scenario.trajectory), solver_(*scenario.manipulator), frequency_(frequency) {}

  Vector6d operator()(double t, const JointMotion& joints) {
    const Motion<double> motion = trajectory_.at(t);
    const Matrix6d I = inertia(motion);
    Vector6d deviation = joints.q.phi - solver_.angles(work_).phi;
    for (int i = 0; i < leg_count; ++i) deviation(i) = std::remainder(deviation(i), 2 * 3.14159265358979323846);
    const Vector6d rate = joints.q_dot.phi - solver_.rates(work_).phi;
    return -I * (frequency_ * frequency_ * deviation + 2 * frequency_ * rate);
  }

  /// I(φ) = T_PᵀM_P T_P at a motion.
  Matrix6d inertia(const Motion<double>& motion) {
    solver_.inverseKinematics(motion, work_);
    solver_.jacobians(motion, work_);
    const Matrix6d T = solver_.T(work_);
    return T.transpose() * solver_.massMatrixAtP(motion, work_) * T;
  }

  /// ‖T_P⁻¹‖ with moments over the length: actuator angle for a platform deviation, rad/m. After inertia().
  double anglePerMetre() const {
    Matrix6d T = solver_.T(work_);
    T.topRows<3>() *= solver_.model().length;
    return T.inverse().norm();
  }

 private:
  const Trajectory& trajectory_;
  Solver<double> solver_;
  Workspace<double> work_;
  double frequency_;
};

/// Largest ‖I‖ ‖T_P⁻¹‖ along the motion: torque for a deviation of the platform times ω², N·m per m/s².
double stiffness(Stabiliser& stabiliser, const std::vector<PointwiseSample>& samples) {
  double largest = 0;
  for (const PointwiseSample& sample : samples) {
    const double inertia = stabiliser.inertia(sample.motion).norm();
    largest = std::max(largest, inertia * stabiliser.anglePerMetre());
  }
  return largest;
}

}  // namespace

Check judgeFeedback(const Scenario& scenario, const Subject& subject, const Amplification& amplification,
                    const std::vector<PointwiseSample>& samples) {
  const double duration = scenario.trajectory->duration();
  const double frequency = 3 * std::max(amplification.fastestRate(), 1 / duration);
  const auto stabiliser = std::make_shared<Stabiliser>(scenario, frequency);
  double rounding = 0, largest = 0, position_scale = 0;
  for (const PointwiseSample& sample : samples) {
    rounding = std::max(rounding, sample.torque.limit);
    largest = std::max(largest, sample.torques_simbody.cwiseAbs().maxCoeff());
    position_scale = std::max(position_scale, sample.conditioning.position_scale);
  }
  ReplaySettings settings;
  settings.tolerance = feedback_tolerance;
  settings.end = duration;
  settings.max_evaluations = 6000;  // too few for a minute of the helix: feedback.torque then fails falsely
  settings.feedback = [stabiliser](double t, const JointMotion& joints) { return (*stabiliser)(t, joints); };
  const Replay run = replay(
      scenario, [&](double t) { return subject.torques(scenario.trajectory->at(t)); }, settings);
  if (!run.gave_up.empty()) return notMade("feedback.torque", "N m", "the stabilised replay gave up: " + run.gave_up);

  double value = 0, when = 0;
  for (const ReplayStep& step : run.steps)
    if (!(step.feedback <= value)) value = step.feedback, when = step.t;
  // Errors of the steps within one decay time are what the term works against; it answers a lasting torque error with
  // ω_f²/(ω_f² − λ²) = 9/8 of it.
  const double steps_per_decay = static_cast<double>(run.steps.size()) / (duration * frequency);
  const double gain = (frequency * frequency + 2 * frequency) * stiffness(*stabiliser, samples);
  const double limit = 2 * rounding + gain * errorPerStep(feedback_tolerance, position_scale) * (1 + steps_per_decay);
  return judged(
      "feedback.torque", value, limit, "N m",
      fmt::format("2 x the torque's rounding and {:.3g} N m/m (gain at {:.3g} rad/s) x the integrator's errors "
                  "within a decay time, tolerance {:g}",
                  gain, frequency, feedback_tolerance),
      fmt::format("torque that a weak stabilising term added over the whole motion, {:.3g} of the largest "
                  "torque; shown for t = {:.6g} s of {} steps",
                  largest > 0 ? value / largest : value, when, run.steps.size()));
}

}  // namespace ursula

#include "studies/audit/effect.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <new>

#include "model/instants.h"
#include "nocsolver/noc/noc.h"
#include "validation/replay/replay.h"
#include "validation/subject/subject.h"

namespace ursula::audit {
namespace {

/// τ^a = I φ̈ + C φ̇ − τ^g, with I φ̈ + C φ̇ = Tᵀ(M ṫ + W M t) and ṫ = T φ̈ + Ṫ φ̇. Without friction.
class DynamicsBy36 {
 public:
  DynamicsBy36(const Manipulator& manipulator, const WithFormulaErrors& formula_errors)
      : manipulator_(manipulator), solver_(manipulator, formula_errors) {}

  Vector6d operator()(const Motion<double>& motion) {
    solver_.inverseKinematics(motion, work_);
    solver_.jacobians(motion, work_);
    solver_.twistShapingRate(motion, work_);
    solver_.bodyMotions(motion, work_, bodies_);
    const Vector6d phi_dot = solver_.rates(work_).phi, phi_ddot = solver_.accelerations(work_).phi;
    Vector6d torques = Vector6d::Zero();
    for (int k = 0; k < body_count; ++k) {
      const auto T = work_.T.middleRows<6>(6 * k);
      const Vector6d twist = T * phi_dot, rate = T * phi_ddot + work_.T_rate.middleRows<6>(6 * k) * phi_dot;
      torques += T.transpose() * wrench(k, twist, rate);
    }
    return torques;
  }

 private:
  Vector6d wrench(int k, const Vector6d& twist, const Vector6d& rate) const {
    const Leg& leg = manipulator_.leg(k % leg_count);
    const Link& link = k < leg_count ? leg.proximal : leg.distal;
    const bool platform = k == 2 * leg_count;
    const double mass = platform ? manipulator_.platform().mass : link.mass;
    const Matrix3d& R = bodies_[static_cast<std::size_t>(k)].R;
    const Matrix3d I = R * (platform ? manipulator_.platform().inertia : link.inertia) * R.transpose();
    const Vector3d omega = twist.head<3>();
    Vector6d out;
    out << I * rate.head<3>() + omega.cross(I * omega), mass * (rate.tail<3>() - manipulator_.gravity());
    return out;
  }

  Manipulator manipulator_;
  Noc<double, WithFormulaErrors> solver_;
  NocWorkspace<double> work_;
  BodyMotions<double> bodies_;
};

/// The first time at which P is off by `far`, interpolated between steps; negative for never.
double firstBeyond(const Replay& replay, double far) {
  constexpr int grid = 4096;
  if (replay.steps.empty()) return -1;
  const double start = replay.steps.front().t, span = replay.steps.back().t - start;
  for (int k = 1; k <= grid; ++k) {
    const double t = start + span * k / grid;
    if (interpolated(replay, t).position_error.norm() > far) return t;
  }
  return -1;
}

Vector6d torquesThatHold(const Scenario& scenario, const Motion<double>& motion) {
  const Noc<double> solver(*scenario.manipulator);
  NocWorkspace<double> work;
  return solver.inverseDynamics(motion, work, loadAtP(scenario.load.get(), motion));
}

}  // namespace

Torques torquesWith(const Scenario& scenario, const WithFormulaErrors& formula_errors, bool through_36) {
  if (!through_36) return wrongNocSubject(*scenario.manipulator, scenario.load, formula_errors).torques;
  // The error's effect is the change of (36) from its right result; (37) contains friction and load.
  const auto altered = std::make_shared<DynamicsBy36>(*scenario.manipulator, formula_errors);
  const auto right = std::make_shared<DynamicsBy36>(*scenario.manipulator, WithFormulaErrors());
  const Torques by_37 = nocSubject(*scenario.manipulator, scenario.load).torques;
  return [altered, right, by_37](const Motion<double>& motion) {
    return Vector6d(by_37(motion) + ((*altered)(motion) - (*right)(motion)));
  };
}

double largestTorque(const Scenario& scenario, int samples) {
  double largest = 0;
  for (double t : equallySpaced(scenario.trajectory->duration(), samples))
    largest = std::max(largest, torquesThatHold(scenario, scenario.trajectory->at(t)).cwiseAbs().maxCoeff());
  return largest;
}

AuditEffect effectOf(const Scenario& scenario, const Torques& torques, int samples, double replay_tolerance) {
  AuditEffect effect;
  double largest = 0;
  try {
    for (double t : equallySpaced(scenario.trajectory->duration(), samples)) {
      const Motion<double> motion = scenario.trajectory->at(t);
      const Vector6d right = torquesThatHold(scenario, motion);
      const double error = (torques(motion) - right).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
      largest = std::max(largest, right.cwiseAbs().maxCoeff());
      if (!(error <= effect.torque_error)) effect.torque_error = error;  // keeps a NaN
    }
  } catch (const std::bad_alloc&) {
    throw;  // a lack of memory says nothing about the formula
  } catch (const std::exception& error) {
    effect.refused = error.what();
    return effect;
  }
  effect.relative_error = effect.torque_error / largest;
  ReplaySettings settings;
  settings.tolerance = replay_tolerance;
  settings.end = scenario.trajectory->duration();
  const Replay run = replay(
      scenario, [&](double t) { return torques(scenario.trajectory->at(t)); }, settings);
  effect.to_1_mm = firstBeyond(run, 1e-3);
  effect.to_10_mm = firstBeyond(run, 1e-2);
  effect.replay_end = run.steps.empty() ? 0 : run.steps.back().t;
  effect.end_deviation = run.steps.empty() ? 0 : run.steps.back().position_error.norm();
  return effect;
}

}  // namespace ursula::audit

#include "parts/audit/effect.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <exception>
#include <memory>
#include <new>

#include "model/instants.h"
#include "nocsolver/noc/noc.h"
#include "validation/replay/replay.h"
#include "validation/subject/subject.h"

namespace ursula::audit {
namespace {

/// C q̇ of (36), which is where errors of Ṫ enter.
Vector6d coriolisEfforts(const Noc<double, WithFormulaErrors>& solver, const Motion<double>& motion) {
  NocWorkspace<double> work;
  solver.directDynamics(motion, Vector6d::Zero(), work);
  return solver.C(work) * solver.rates(work).phi;
}

/// The first instant at which P is off by more than `far`, s; negative if none.
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

}  // namespace

Torques torquesWith(const Scenario& scenario, const WithFormulaErrors& formula_errors, bool only_in_36) {
  if (!only_in_36) return wrongNocSubject(*scenario.manipulator, scenario.load, formula_errors).torques;
  using Solver = Noc<double, WithFormulaErrors>;
  const auto altered = std::make_shared<const Solver>(*scenario.manipulator, formula_errors);
  const auto right = std::make_shared<const Solver>(*scenario.manipulator, WithFormulaErrors());
  const Torques by_37 = nocSubject(*scenario.manipulator, scenario.load).torques;
  return [altered, right, by_37](const Motion<double>& motion) {
    return Vector6d(by_37(motion) + (coriolisEfforts(*altered, motion) - coriolisEfforts(*right, motion)));
  };
}

double largestTorque(const Scenario& scenario, int samples) {
  const Torques right = nocSubject(*scenario.manipulator, scenario.load).torques;
  double largest = 0;
  for (double t : equallySpaced(scenario.trajectory->duration(), samples))
    largest = std::max(largest, right(scenario.trajectory->at(t)).cwiseAbs().maxCoeff());
  return largest;
}

AuditEffect effectOf(const Scenario& scenario, const Torques& torques, int samples, double replay_tolerance) {
  AuditEffect effect;
  const Torques expected = nocSubject(*scenario.manipulator, scenario.load).torques;
  double largest = 0;
  try {
    for (double t : equallySpaced(scenario.trajectory->duration(), samples)) {
      const Motion<double> motion = scenario.trajectory->at(t);
      const Vector6d right = expected(motion);
      const double error = (torques(motion) - right).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
      largest = std::max(largest, right.cwiseAbs().maxCoeff());
      effect.torque_error = larger(effect.torque_error, error);
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

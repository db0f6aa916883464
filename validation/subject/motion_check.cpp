#include "validation/subject/motion_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "model/instants.h"
#include "model/legs/leg_type.h"
#include "model/scenario_files.h"
#include "nocsolver/noc/noc.h"
#include "validation/subject/singular_everywhere.h"

namespace ursula {
namespace {

/// The samples, with enough instants between them for `least_intervals`.
std::vector<double> instantsToCheck(const Scenario& scenario) {
  constexpr int least_intervals = 2000;
  const int intervals = scenario.simulation.samples - 1;
  const int parts = (least_intervals + intervals - 1) / intervals;
  return equallySpaced(scenario.trajectory->duration(), intervals * parts + 1);
}

double missed(const Reach& reach) { return std::max({reach.distance - reach.most, reach.least - reach.distance, 0.0}); }

Reach reachOf(const Leg& leg, const Motion<double>& motion) {
  const Vector3d AB = motion.p - leg.base_point + motion.Q * leg.platform_point;
  const Vector3d u = leg.base_axis.stableNormalized();
  return typeOf(leg.kind).reach(leg, {AB.norm(), std::abs(AB.dot(u)), AB.cross(u).norm()});
}

/// ", and by up to 0.3 m, leg 2 at t = 3 s": the largest violation, if it exceeds `already`.
std::string worstMiss(const Scenario& scenario, double already) {
  double most = already, at = 0;
  int worst = -1;
  for (double t : instantsToCheck(scenario)) {
    const Motion<double> motion = scenario.trajectory->at(t);
    for (int i = 0; i < scenario.manipulator->legCount(); ++i) {
      const double by = missed(reachOf(scenario.manipulator->leg(i), motion));
      if (!(by > most)) continue;
      most = by;
      at = t;
      worst = i;
    }
  }
  return worst < 0 ? "" : fmt::format(", and by up to {:.4g} m, leg {} at t = {:.6g} s", most, worst + 1, at);
}

std::string outOfReach(const Scenario& scenario, const PoseError& refusal) {
  const Reach reach = reachOf(scenario.manipulator->leg(refusal.leg()), scenario.trajectory->at(refusal.instant()));
  const bool too_far = refusal.measure() > refusal.bound();
  const double by = std::abs(refusal.measure() - refusal.bound());
  const bool is_mm = too_far && refusal.measure() > 100 * reach.most;
  return fmt::format("leg {} is out of reach at t = {:.6g} s: {} {:.6g} {} {} {:.6g} m; it misses by {:.4g} m{}{}",
                     refusal.leg() + 1, refusal.instant(), reach.before, refusal.measure(), reach.after,
                     too_far ? "at most" : "at least", too_far ? reach.most : reach.least, by, worstMiss(scenario, by),
                     is_mm ? "; are positions given in mm? Expected m" : "");
}

/// Says how far a stretched or folded leg is from its dead centre, as a length.
std::string stretched(const Scenario& scenario, const PoseError& refusal) {
  const Leg& leg = scenario.manipulator->leg(refusal.leg());
  const DeadCentre at = typeOf(leg.kind).deadCentre(reachOf(leg, scenario.trajectory->at(refusal.instant())));
  return fmt::format("leg {} {} at t = {:.6g} s: {}", refusal.leg() + 1, at.state, refusal.instant(), at.measure);
}

std::string onAxis(const Scenario& scenario, const PoseError& refusal) {
  const LegType& type = typeOf(scenario.manipulator->leg(refusal.leg()).kind);
  return fmt::format(
      "leg {} has its platform point on the {} at t = {:.6g} s: {:.3g} m from it, expected more than {:.3g} m, for "
      "there the {} angle is not determined",
      refusal.leg() + 1, type.firstAxis(), refusal.instant(), refusal.measure(), refusal.bound(), type.firstAngle());
}

std::string inWords(const Scenario& scenario, const PoseError& refusal) {
  if (dynamic_cast<const OutOfReach*>(&refusal) != nullptr) return outOfReach(scenario, refusal);
  if (dynamic_cast<const StretchedLeg*>(&refusal) != nullptr) return stretched(scenario, refusal);
  if (dynamic_cast<const PointOnAxis*>(&refusal) != nullptr) return onAxis(scenario, refusal);
  return fmt::format(
      "at t = {:.6g} s the pose is singular, or was passed just before: with all six motors held the platform can "
      "still move, so that no efforts hold it; keep the motion on one side of it",
      refusal.instant());
}

}  // namespace

void requireWhole(const Scenario& scenario) {
  for (const auto& [place, is_there] :
       {std::pair("manipulator", scenario.manipulator != nullptr), {"trajectory", scenario.trajectory != nullptr}})
    if (!is_there) throw InvalidParameter(place, "none", "a scenario that has one");
}

/// det B is continuous wherever the legs reach, so it vanishes between two poses at which its signs differ.
void checkMotion(const Scenario& scenario) {
  requireWhole(scenario);
  const Noc<double> solver(*scenario.manipulator);
  NocWorkspace<double> work;
  double before = 0;
  for (double t : instantsToCheck(scenario)) {
    const Motion<double> motion = scenario.trajectory->at(t);
    solver.inverseKinematics(motion, work);
    solver.jacobians(motion, work);
    const double determinant = work.B_transposed.determinant();
    if (before * determinant < 0)
      throw SingularJacobian("B has crossed a singular pose: its determinant changed sign", -1, t, determinant, 0, "");
    before = std::copysign(1.0, determinant);
  }
}

ScenarioError motionRefusal(const Scenario& scenario, const PoseError& refusal) {
  if (dynamic_cast<const SingularJacobian*>(&refusal) != nullptr)
    if (const auto found = singularEverywhere(scenario))
      return ScenarioError(
          fmt::format("{}: error: the machine is {}", placeInFile(scenario, "manipulator.leg").place, found->words()));
  return ScenarioError(fmt::format("{}: error: the motion cannot be made: {}",
                                   placeInFile(scenario, "trajectory").place, inWords(scenario, refusal)));
}

void tryMotion(const Scenario& scenario) {
  try {
    checkMotion(scenario);
  } catch (const PoseError& refusal) {
    throw motionRefusal(scenario, refusal);
  }
}

}  // namespace ursula

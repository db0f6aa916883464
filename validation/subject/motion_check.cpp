#include "validation/subject/motion_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "model/instants.h"
#include "model/scenario_place.h"
#include "nocsolver/solver.h"

namespace ursula {
namespace {

/// The samples and as many between each two as make `least_intervals`.
std::vector<double> instantsToCheck(const Scenario& scenario) {
  constexpr int least_intervals = 2000;
  const int intervals = scenario.simulation.samples - 1;
  const int parts = (least_intervals + intervals - 1) / intervals;
  return equallySpaced(scenario.trajectory->duration(), intervals * parts + 1);
}

/// A distance that a leg has to span, and what it can, m; with the words around them.
struct Span {
  double distance, least, most;
  const char *before, *after;

  double missed() const { return std::max({distance - most, least - distance, 0.0}); }
};

/// Of crank and rod: across the crank's plane first, then within it.
Span spanOfCrank(const Leg& leg, double along, double across) {
  const double l = leg.proximal.length, s = leg.distal.length;
  if (along > s) return {along, 0, s, "its platform point is", "m from its crank's plane, and its rod spans"};
  const double c = std::sqrt((s - along) * (s + along));
  return {across, std::abs(l - c), l + c, "its platform point is",
          "m from its crank's axis, and from there crank and rod span"};
}

Span spanOf(const Leg& leg, const Motion<double>& motion) {
  const double l = leg.proximal.length, s = leg.distal.length;
  const Vector3d AB = motion.p - leg.base_point + motion.Q * leg.platform_point;
  const Vector3d u = leg.base_axis.stableNormalized();
  const double along = std::abs(AB.dot(u)), across = AB.cross(u).norm();
  const char* const apart = "its base and platform points are";
  switch (leg.kind) {
    case LegKind::UPS:
      return {AB.norm(), s, l + s, apart, "m apart, and its cylinder and rod span"};
    case LegKind::RUS:
      return spanOfCrank(leg, along, across);
    case LegKind::PUS:
      return {across, 0, s, "its platform point is", "m from its rail, and its rod spans"};
    case LegKind::URS:
      break;
  }
  return {AB.norm(), std::abs(l - s), l + s, apart, "m apart, and its two links span"};
}

/// ", and by up to 0.3 m, leg 2 at t = 3 s": where the motion misses most, if that is more than `already`.
std::string worstMiss(const Scenario& scenario, double already) {
  double most = already, at = 0;
  int worst = -1;
  for (double t : instantsToCheck(scenario)) {
    const Motion<double> motion = scenario.trajectory->at(t);
    for (int i = 0; i < scenario.manipulator->legCount(); ++i) {
      const double missed = spanOf(scenario.manipulator->leg(i), motion).missed();
      if (!(missed > most)) continue;
      most = missed;
      at = t;
      worst = i;
    }
  }
  return worst < 0 ? "" : fmt::format(", and by up to {:.4g} m, leg {} at t = {:.6g} s", most, worst + 1, at);
}

std::string outOfReach(const Scenario& scenario, const PoseError& refusal) {
  const Span span = spanOf(scenario.manipulator->leg(refusal.leg()), scenario.trajectory->at(refusal.instant()));
  const bool too_far = refusal.measure() > refusal.bound();
  const double missed = std::abs(refusal.measure() - refusal.bound());
  return fmt::format("leg {} is out of reach at t = {:.6g} s: {} {:.6g} {} {} {:.6g} m; it misses by {:.4g} m{}",
                     refusal.leg() + 1, refusal.instant(), span.before, refusal.measure(), span.after,
                     too_far ? "at most" : "at least", too_far ? span.most : span.least, missed,
                     worstMiss(scenario, missed));
}

/// A knee within √eps of straight: as a length, what its links can span less the distance.
std::string stretched(const Scenario& scenario, const PoseError& refusal) {
  const Leg& leg = scenario.manipulator->leg(refusal.leg());
  const Span span = spanOf(leg, scenario.trajectory->at(refusal.instant()));
  if (leg.kind == LegKind::PUS)
    return fmt::format(
        "leg {} has its rod across its rail at t = {:.6g} s: its platform point is {:.6g} m from the rail, {:.3g} m "
        "less than the rod is long, and there its carriage's speed is not determined",
        refusal.leg() + 1, refusal.instant(), span.distance, span.most - span.distance);
  const bool is_straight = span.most - span.distance < span.distance - span.least;
  return fmt::format(
      "leg {} is {} at t = {:.6g} s: {} {:.6g} m {}, {:.3g} m from where its knee can bend neither way, and there its "
      "speed is not determined",
      refusal.leg() + 1, is_straight ? "stretched straight" : "folded flat", refusal.instant(), span.before,
      span.distance, leg.kind == LegKind::RUS ? "from its crank's axis" : "apart",
      is_straight ? span.most - span.distance : span.distance - span.least);
}

std::string onAxis(const Scenario& scenario, const PoseError& refusal) {
  const auto [axis, angle] = [&]() -> std::pair<const char*, const char*> {
    switch (scenario.manipulator->leg(refusal.leg()).kind) {
      case LegKind::UPS:
        return {"base axis of its universal joint", "leg's"};
      case LegKind::PUS:
        return {"rail of its carriage", "rod's"};
      default:
        return {"axis of its motor", "motor's"};
    }
  }();
  return fmt::format(
      "leg {} has its platform point on the {} at t = {:.6g} s: {:.3g} m from it, expected more than {:.3g} m, for "
      "there the {} angle is not determined",
      refusal.leg() + 1, axis, refusal.instant(), refusal.measure(), refusal.bound(), angle);
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

/// det B is continuous wherever the legs reach, so that it vanishes between unlike signs.
void checkMotion(const Scenario& scenario) {
  requireWhole(scenario);
  const Solver<double> solver(*scenario.manipulator);
  Workspace<double> work;
  double before = 0;
  for (double t : instantsToCheck(scenario)) {
    const Motion<double> motion = scenario.trajectory->at(t);
    solver.inverseKinematics(motion, work);
    solver.jacobians(motion, work);
    const double determinant = solver.determinant(work);
    if (before * determinant < 0)
      throw SingularJacobian("B has crossed a singular pose: its determinant changed sign", -1, t, determinant, 0, "");
    before = std::copysign(1.0, determinant);
  }
}

ScenarioError unmade(const Scenario& scenario, const PoseError& refusal) {
  return ScenarioError(fmt::format("{}: error: the motion cannot be made: {}",
                                   placeInFile(scenario, "trajectory").place, inWords(scenario, refusal)));
}

void tryMotion(const Scenario& scenario) {
  try {
    checkMotion(scenario);
  } catch (const PoseError& refusal) {
    throw unmade(scenario, refusal);
  }
}

}  // namespace ursula

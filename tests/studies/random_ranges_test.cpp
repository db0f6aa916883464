// The ranges of random scenarios: checks the claims of parts/random/random_scenario.h on many draws. Nothing is
// validated.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "parts/fast/solver.h"
#include "tests/studies/drawn_scenarios.h"
#include "validation/limits/conditioning.h"

namespace ursula {
namespace {

/// A quantity of which values as small and as large as these must occur.
struct Range {
  const char* name;
  double low, high;
  std::function<std::vector<double>(const Scenario&)> of;
};

double sizeOf(const Scenario& scenario) {
  double size = 0;
  for (const Leg& leg : scenario.manipulator->parameters().legs) size = std::max(size, leg.proximal.length);
  return size;
}

Vector3d middleOf(const Scenario& scenario, Vector3d Leg::*point) {
  Vector3d middle = Vector3d::Zero();
  for (const Leg& leg : scenario.manipulator->parameters().legs) middle += leg.*point / leg_count;
  return middle;
}

std::vector<double> ofLinks(const Scenario& scenario, const std::function<double(const Link&)>& value) {
  std::vector<double> out;
  for (const Leg& leg : scenario.manipulator->parameters().legs)
    for (const Link* link : {&leg.proximal, &leg.distal}) out.push_back(value(*link));
  return out;
}

double spreadOfMasses(const Scenario& scenario) {
  std::vector<double> masses = ofLinks(scenario, [](const Link& link) { return link.mass; });
  masses.push_back(scenario.manipulator->platform().mass);
  const auto [least, most] = std::minmax_element(masses.begin(), masses.end());
  return *most / *least;
}

Vector3d momentsOf(const Link& link) {
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(link.inertia, Eigen::EigenvaluesOnly).eigenvalues();
}

/// The duration over the time of a fall by about a link's length; none without gravity.
std::vector<double> naturalTimes(const Scenario& scenario) {
  const double gravity = scenario.manipulator->gravity().norm();
  if (gravity == 0) return {};
  return {scenario.trajectory->duration() / std::sqrt(sizeOf(scenario) / gravity)};
}

/// The largest friction, over the moment of a leg's share of the weight at its length.
std::vector<double> frictionShares(const Scenario& scenario) {
  const ManipulatorParameters& machine = scenario.manipulator->parameters();
  std::vector<double> out;
  for (const Leg& leg : machine.legs) {
    const double mass = machine.platform.mass / leg_count + leg.proximal.mass + leg.distal.mass;
    const double torque = mass * machine.gravity.norm() * sizeOf(scenario);
    if (leg.coulomb.theta > 0 && torque > 0) out.push_back(leg.coulomb.theta / torque);
  }
  return out;
}

std::vector<Range> machineRanges() {
  const auto ofMachine = [](auto value) {
    return [value](const Scenario& scenario) { return std::vector<double>{value(scenario)}; };
  };
  const auto ofEveryLink = [](auto value) {
    return [value](const Scenario& scenario) { return ofLinks(scenario, value); };
  };
  return {
      {"size, m", 8e-3, 120, ofMachine(sizeOf)},
      {"platform's mass, kg", 1e-3, 1e6, ofMachine([](const Scenario& s) { return s.manipulator->platform().mass; })},
      {"link's mass, kg", 1e-5, 1e5, ofEveryLink([](const Link& link) { return link.mass; })},
      {"largest mass over smallest", 20, 3e5, ofMachine(spreadOfMasses)},
      {"mass centre over length", -1.3, 2.3,
       ofEveryLink([](const Link& link) { return link.center_of_mass / link.length; })},
      {"inertia over m l²", 3e-6, 0.2,
       ofEveryLink([](const Link& link) { return momentsOf(link)(2) / link.mass / link.length / link.length; })},
      {"least moment over largest (rods)", 1e-5, 0.8,
       ofEveryLink([](const Link& link) { return momentsOf(link)(0) / momentsOf(link)(2); })},
      {"what a lamina lacks", 1e-9, 0.3, ofEveryLink([](const Link& link) {
         const Vector3d moments = momentsOf(link);
         return 1 - moments(2) / (moments(0) + moments(1));
       })},
      {"base from origin, m", 0.01, 3e4,
       ofMachine([](const Scenario& s) { return middleOf(s, &Leg::base_point).norm(); })},
      {"P from platform, sizes", 0.1, 5,
       ofMachine([](const Scenario& s) { return middleOf(s, &Leg::platform_point).norm() / sizeOf(s); })},
      {"platform's mass centre, m from its points", 0.01, 10, ofMachine([](const Scenario& s) {
         return (s.manipulator->platform().center_of_mass - middleOf(s, &Leg::platform_point)).norm();
       })},
      {"axis's slope", 0.01, 1 - 1e-12,
       [](const Scenario& s) {
         std::vector<double> out;
         for (const Leg& leg : s.manipulator->parameters().legs)
           out.push_back(std::abs(leg.base_axis.normalized().z()));
         return out;
       }},
      {"proximal over distal", 0.3, 3,
       [](const Scenario& s) {
         std::vector<double> out;
         for (const Leg& leg : s.manipulator->parameters().legs) out.push_back(leg.proximal.length / leg.distal.length);
         return out;
       }},
      {"dry friction over weight", 1e-4, 0.05, frictionShares}};
}

std::vector<double> kappaOf(const Scenario& scenario) {
  ConditioningProbe probe(*scenario.manipulator, scenario.load);
  double worst = 0;
  for (int k = 0; k <= 20; ++k) {
    const Conditioning c = probe.at(scenario.trajectory->at(scenario.trajectory->duration() * k / 20));
    worst = std::max(worst, c.kappa_B * c.kappa_legs);
  }
  return {worst};
}

std::vector<double> sinesOf(const Scenario& scenario) {
  const Solver<double> solver(*scenario.manipulator);
  Workspace<double> work;
  std::vector<double> out;
  for (int k = 0; k <= 60; ++k) {
    solver.displacements(scenario.trajectory->at(scenario.trajectory->duration() * k / 60), work);
    for (int i = 0; i < leg_count; ++i) out.push_back(solver.margins(work, i).sine);
  }
  return out;
}

std::vector<Range> motionRanges() {
  return {{"duration, natural times", 0.2, 30, naturalTimes},
          {"kappa(B) kappa(legs)", 300, 5e4, kappaOf},
          {"|sin theta|", 0.06, 0.999, sinesOf},
          {"g_z", -200, 15, [](const Scenario& s) { return std::vector<double>{s.manipulator->gravity().z()}; }},
          {"|g|", 2.5, 200, [](const Scenario& s) {
             const double g = s.manipulator->gravity().norm();
             return g > 0 ? std::vector<double>{g} : std::vector<double>{};
           }}};
}

/// The ranges that the scenarios do not span.
std::vector<std::string> notSpanned(const std::vector<Range>& ranges, const std::vector<Scenario>& scenarios) {
  std::vector<std::string> out;
  for (const Range& range : ranges) {
    double low = INFINITY, high = -INFINITY;
    for (const Scenario& scenario : scenarios)
      for (const double value : range.of(scenario)) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
    if (!(low <= range.low && high >= range.high))
      out.push_back(std::string(range.name) + ": " + std::to_string(low) + " to " + std::to_string(high));
  }
  return out;
}

TEST(RandomScenarios, spanTheRangesOfMachines) {
  EXPECT_THAT(notSpanned(machineRanges(), drawnScenarios()), testing::IsEmpty());
}

TEST(RandomScenarios, spanTheRangesOfMotions) {
  EXPECT_THAT(notSpanned(motionRanges(), drawnScenarios()), testing::IsEmpty());
}

/// Negative control: machines of nearly one size and shape span none of the ranges.
TEST(RandomScenarios, wouldBeFoundOutIfAlike) {
  const std::vector<Scenario> same(5, drawnScenarios().front());
  std::vector<Range> ranges = machineRanges();
  EXPECT_EQ(notSpanned(ranges, same).size(), ranges.size());
  ranges = motionRanges();
  EXPECT_EQ(notSpanned(ranges, same).size(), ranges.size());
}

std::string gravityKind(const Vector3d& gravity) {
  const double norm = gravity.norm();
  if (norm == 0) return "no gravity";
  const double slope = gravity.z() / norm;
  if (slope > 0.9) return "gravity up";
  if (slope < -0.9) return "gravity down";
  return std::abs(slope) < 0.1 ? "gravity sideways" : "gravity tilted";
}

/// Whether two rows with different wrenches are less than a hundredth of the motion apart.
bool jumps(const LoadHistory& history, double duration) {
  const std::vector<double>& times = history.knots();
  for (std::size_t i = 1; i < times.size(); ++i)
    if (times[i] - times[i - 1] < 0.01 * duration && history.at(times[i]).force != history.at(times[i - 1]).force)
      return true;
  return false;
}

void addKindsOfMachine(const ManipulatorParameters& machine, std::set<std::string>& kinds) {
  kinds.insert(gravityKind(machine.gravity));
  bool viscous = false, dry = false;
  for (const Leg& leg : machine.legs) {
    kinds.insert(leg.knee == Knee::positive ? "knee out" : "knee in");
    viscous |= leg.friction.theta > 0;
    dry |= leg.coulomb.theta > 0;
    for (const Link& link : {leg.proximal, leg.distal})
      if (link.center_of_mass == 0 || link.center_of_mass == link.length) kinds.insert("mass centre at an end");
    if (leg.base_axis.head<2>().isZero(0)) kinds.insert("axis along z");
  }
  kinds.insert(std::string("friction: ") + (viscous ? "viscous " : "") + (dry ? "dry" : ""));
}

void addKindsOfLoad(const Scenario& scenario, std::set<std::string>& kinds) {
  if (!scenario.load) return void(kinds.insert("no load"));
  const Load& load = *scenario.load;
  kinds.insert(load.frame == Load::Frame::base ? "load in B" : "load in M");
  if (!load.history) return void(kinds.insert("constant load"));
  kinds.insert(jumps(*load.history, scenario.trajectory->duration()) ? "load jumps" : "load table");
}

TEST(RandomScenarios, areOfEveryKind) {
  std::set<std::string> kinds;
  for (const Scenario& scenario : drawnScenarios()) {
    kinds.insert(scenario.trajectory->kind());
    const std::size_t knots = scenario.trajectory->knots().size();
    if (knots > 6) kinds.insert(fmt::format("{} {}", knots > 40 ? "very many" : "many", scenario.trajectory->kind()));
    addKindsOfMachine(scenario.manipulator->parameters(), kinds);
    addKindsOfLoad(scenario, kinds);
  }
  EXPECT_THAT(kinds, testing::UnorderedElementsAre(
                         "helix", "hold", "waypoints", "many waypoints", "samples", "many samples", "very many samples",
                         "no gravity", "gravity up", "gravity down", "gravity sideways", "gravity tilted", "knee out",
                         "knee in", "mass centre at an end", "axis along z", "friction: ", "friction: viscous ",
                         "friction: dry", "friction: viscous dry", "no load", "load in B", "load in M", "constant load",
                         "load table", "load jumps"));
}

TEST(RandomScenarios, areWellConditioned) {
  for (const Scenario& scenario : drawnScenarios()) EXPECT_LT(kappaOf(scenario).front(), 1.01e6) << scenario.text;
}

}  // namespace
}  // namespace ursula

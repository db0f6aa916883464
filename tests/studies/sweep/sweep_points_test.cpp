// A point's scenario depends only on the sweep and the point's index.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "model/machine_numbers.h"
#include "tests/studies/sweep/sweeps.h"

namespace ursula {
namespace {

const std::string random_500 = "design = \"random\"\ncount = 500\n";

TEST(SweepPoints, gridIsTheProductTheLastFastest) {
  const SweepPlan plan = planOf("inverse", "design = \"grid\"\n" + vary("platform.mass", "values = [400, 500]") +
                                               vary("gravity.2", "steps = [-9.0, -10.0, 3]"));
  ASSERT_EQ(plan.points().count(), 6);
  EXPECT_EQ(plan.points().at(0), (std::vector<double>{400, -9}));
  EXPECT_EQ(plan.points().at(1), (std::vector<double>{400, -9.5}));
  EXPECT_EQ(plan.points().at(5), (std::vector<double>{500, -10}));
  EXPECT_EQ(plan.parameters(5), R"({"manipulator.platform.mass":500,"manipulator.gravity.2":-10})");
}

/// Checks means and deviations of 4,000 points, to five standard errors.
TEST(SweepPoints, deviatesHaveTheirDistributions) {
  for (const char* design : {"random", "sobol"}) {
    const SweepPlan plan = planOf("inverse", "design = \"" + std::string(design) + "\"\ncount = 4000\nseed = 5\n" +
                                                 vary("platform.mass", "uniform = [400.0, 600.0]") +
                                                 vary("leg_defaults.proximal.mass", "normal = [10.0, 0.5]") +
                                                 vary("leg_defaults.distal.mass", "relative = 0.1") +
                                                 vary("gravity.0", "plus_minus = 0.3"));
    const double mean[] = {500, 10, 10, 0}, sd[] = {200 / std::sqrt(12.0), 0.5, 1, 0.3 / std::sqrt(3.0)};
    for (std::size_t k = 0; k < 4; ++k) {
      double sum = 0, squares = 0;
      for (std::int64_t i = 0; i < 4000; ++i) {
        const double x = (plan.points().at(i)[k] - mean[k]) / sd[k];
        sum += x;
        squares += x * x;
      }
      EXPECT_LT(std::abs(sum / 4000), 5 / std::sqrt(4000.0)) << design << k;
      EXPECT_NEAR(squares / 4000, 1, 5 * std::sqrt(2.0 / 4000)) << design << k;
    }
  }
}

/// Of Sobol's first 2^m points one is in each of 2^m equal intervals, with or without a digital shift.
TEST(SweepPoints, sobolFillsEvenly) {
  const auto cells = [](const char* design) {
    const SweepPlan plan = planOf("inverse", "design = \"" + std::string(design) + "\"\ncount = 256\n" +
                                                 vary("platform.mass", "uniform = [0.0, 256.0]") +
                                                 vary("gravity.0", "uniform = [0.0, 256.0]"));
    std::array<std::array<int, 256>, 2> count{};
    for (std::int64_t i = 0; i < 256; ++i)
      for (std::size_t k = 0; k < 2; ++k) ++count[k][static_cast<std::size_t>(plan.points().at(i)[k])];
    return count;
  };
  for (const auto& each : cells("sobol")) EXPECT_THAT(each, testing::Each(1));
  EXPECT_THAT(cells("random")[0], testing::Contains(testing::Gt(1)));  // otherwise the test would pass for anything
}

TEST(SweepPoints, hangOnSeedAndIndexAlone) {
  const std::string mass = vary("platform.mass", "uniform = [400.0, 600.0]");
  const SweepPlan plan = planOf("inverse", random_500 + mass), same = planOf("inverse", random_500 + mass),
                  other = planOf("inverse", "seed = 2\n" + random_500 + mass);
  EXPECT_EQ(plan.points().at(499), same.points().at(499));
  EXPECT_NE(plan.points().at(499), other.points().at(499));
  EXPECT_NE(plan.points().at(499), plan.points().at(498));
  EXPECT_EQ(plan.identity().hash, same.identity().hash);
  EXPECT_NE(plan.identity().hash, other.identity().hash);
  // The standard defines both generators exactly, so this value is the same everywhere.
  EXPECT_EQ(plan.parameters(0), R"({"manipulator.platform.mass":483.61680293250924})");
}

TEST(SweepPoints, starVariesEveryLegAndEntryByItself) {
  SweepPlan plan = planOf("inverse", random_500 + vary("leg.*.platform_point.*", "plus_minus = 1e-3"));
  ASSERT_EQ(plan.points().numbers().size(), 18u);
  EXPECT_EQ(plan.points().numbers()[17].key, "manipulator.leg.6.platform_point.2");
  const Scenario nominal = readScenario(helix_file), point = plan.make(3);
  for (int i = 0; i < leg_count; ++i) {
    const Vector3d moved = point.manipulator->leg(i).platform_point - nominal.manipulator->leg(i).platform_point;
    EXPECT_GT(moved.cwiseAbs().minCoeff(), 0);
    EXPECT_LE(moved.cwiseAbs().maxCoeff(), 1.0000001e-3);
  }
}

/// A number's key is its path in derivatives and causes. No two numbers of this machine are equal.
TEST(SweepPoints, everyNumberOfTheMachineIsAKey) {
  std::string scenario = TemporaryFolder::read(URSULA_SCENARIOS "/proving-ground.toml");
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"{ actuated =", "{ phi ="},
                                 {", universal =", ", psi ="},
                                 {", knee =", ", theta ="}})
    for (std::size_t at = 0; (at = scenario.find(from, at)) != std::string::npos;)
      scenario.replace(at, from.size(), to);
  const TemporaryFolder folder;
  const std::string file = folder.write("a.toml", scenario);
  const ManipulatorParameters machine = readScenario(file).manipulator->parameters();
  const std::vector<MachineNumber> numbers = machineNumbers(machine);
  std::string varied;
  for (const MachineNumber& number : numbers) varied += vary(number.path, "values = [1.0]");
  SweepFile sweep = parseSweepFile(sweepText("inverse", "design = \"grid\"\n" + varied), "sweep.toml");
  sweep.scenario = file;
  const SweepPlan plan(sweep);
  ASSERT_EQ(plan.points().numbers().size(), numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k)
    EXPECT_EQ(plan.points().numbers()[k].nominal, numbers[k].get(machine)) << numbers[k].path;
}

TEST(SweepPoints, aDefaultMovesAllLegsAndALegsOwnOnlyIt) {
  SweepPlan all = planOf("inverse", random_500 + vary("leg_defaults.distal.length", "values = [1.5]"));
  SweepPlan one = planOf("inverse", random_500 + vary("leg.3.distal.length", "values = [1.5]"));
  SweepPlan inertia = planOf("inverse", random_500 + vary("leg.2.distal.inertia.2", "values = [0.5]"));
  SweepPlan friction = planOf("inverse", random_500 + vary("leg_defaults.friction.phi", "values = [2.0]"));
  const Scenario nominal = readScenario(helix_file);
  for (int i = 0; i < leg_count; ++i) {
    EXPECT_EQ(all.make(0).manipulator->leg(i).distal.length, 1.5);
    EXPECT_EQ(one.make(0).manipulator->leg(i).distal.length, i == 2 ? 1.5 : 1.4);
    EXPECT_EQ(inertia.make(0).manipulator->leg(i).distal.inertia(2, 2), i == 1 ? 0.5 : 0.015);
    EXPECT_EQ(inertia.make(0).manipulator->leg(i).distal.inertia(0, 0),
              nominal.manipulator->leg(i).distal.inertia(0, 0));
    EXPECT_EQ(friction.make(0).manipulator->leg(i).friction.on(Coordinate::phi), 2);
  }
}

/// `actuated` and `phi` are one number; a leg or the defaults may use either name.
TEST(SweepPoints, frictionVariesByEitherOfItsNames) {
  const TemporaryFolder folder;
  const std::string helix = TemporaryFolder::read(helix_file), defaults = "[manipulator.leg_defaults]\n";
  const auto at = helix.find("\n", helix.find(defaults)) + 1;
  for (const std::string written : {"actuated", "phi"})
    for (const char* varied : {"leg.1.friction.actuated", "leg.1.friction.phi"}) {
      std::string text = helix;
      text.insert(at, "friction = { " + written + " = 3.0 }\n");
      SweepFile sweep = parseSweepFile(sweepText("inverse", random_500 + vary(varied, "relative = 0.1")), "sweep.toml");
      sweep.scenario = folder.write("helix.toml", text);
      SweepPlan plan(sweep);
      EXPECT_EQ(plan.points().numbers()[0].nominal, 3) << written << varied;
      const Scenario point = plan.make(0);
      EXPECT_EQ(point.manipulator->leg(0).friction.phi, plan.points().at(0)[0]) << written << varied;
      EXPECT_EQ(point.manipulator->leg(1).friction.phi, 3) << written << varied;
    }
}

TEST(SweepPoints, limitsOfTheUsersOwnCanVary) {
  const TemporaryFolder folder;
  const std::string scenario =
      folder.write("a.toml", TemporaryFolder::read(helix_file) +
                                 "\n[acceptance]\n\"torque.pointwise\" = 1.0\nreplay.position = 2.0\n");
  SweepPlan plan(parseSweepFile("scenario = \"" + scenario + "\"\nwhat = \"validate\"\ndesign = \"grid\"\n" +
                                    vary("acceptance.\\\"torque.pointwise\\\"", "values = [3.0, 4.0]") +
                                    vary("acceptance.replay.position", "values = [5.0]"),
                                "sweep.toml"));
  std::map<std::string, double> limits;
  for (const AcceptanceLimit& limit : plan.read(1).acceptance) limits[limit.check] = limit.limit;
  EXPECT_EQ(limits.at("torque.pointwise"), 4.0);
  EXPECT_EQ(limits.at("replay.position"), 5.0);
}

TEST(SweepPoints, textIsTheScenarioThatIsMade) {
  SweepPlan plan = planOf("inverse", random_500 + "samples = 33\n" + vary("leg.*.base_axis.*", "plus_minus = 1e-2") +
                                         vary("trajectory.radius", "relative = 0.01") +
                                         vary("platform.inertia.0", "uniform = [1e-9, 2e-9]"));
  for (const std::int64_t i : {0, 7, 499}) {
    const Scenario made = plan.make(i), read = parseScenario(plan.text(i), "point.toml");
    EXPECT_EQ(made.simulation.samples, 33);
    EXPECT_EQ(read.simulation.samples, 33);
    EXPECT_EQ(read.name, "paper-helix-" + std::to_string(i));
    for (int leg = 0; leg < leg_count; ++leg) {
      EXPECT_EQ(made.manipulator->leg(leg).base_axis, read.manipulator->leg(leg).base_axis);
      EXPECT_EQ(made.manipulator->leg(leg).distal.inertia, read.manipulator->leg(leg).distal.inertia);
    }
    EXPECT_EQ(made.manipulator->parameters().platform.inertia, read.manipulator->parameters().platform.inertia);
    EXPECT_EQ(made.trajectory->at(1.1).p, read.trajectory->at(1.1).p);
    EXPECT_EQ(plan.text(i).find("69999999"), std::string::npos) << "0.7 is written as 0.7";
  }
  EXPECT_NE(plan.make(0).trajectory->at(1.1).p, plan.make(7).trajectory->at(1.1).p);
}

}  // namespace
}  // namespace ursula

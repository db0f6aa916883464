// A machine far from the base's origin is judged as the same machine at it.

#include <gtest/gtest.h>

#include <iostream>

#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"

namespace ursula {
namespace {

/// The paper's machine and motion at z = `height`: b Δω̄ is that.
ValidationResult helixAt(double height) {
  Scenario scenario = scenarioOf("paper-helix");
  scenario.text.clear();  // it is not the file's any more
  scenario.simulation.samples = 61;
  ManipulatorParameters machine = scenario.manipulator->parameters();
  for (Leg& leg : machine.legs) leg.base_point.z() += height;
  scenario.manipulator = std::make_shared<const Manipulator>(machine);
  HelixParameters helix;
  helix.radius = 0.2, helix.pitch = 1.2, helix.start_angle = -1.5707963267948966, helix.end_angle = -1.0471975511965976;
  helix.height_phase = 2.2 + height / helix.pitch;
  scenario.trajectory = makeHelix(helix);
  return validate(scenario);
}

class FarAway : public testing::TestWithParam<double> {};

TEST_P(FarAway, everyCheckPassesByLimitsLikeThoseAtTheOrigin) {
  static const ValidationResult near = helixAt(0);
  const ValidationResult far = helixAt(GetParam());
  EXPECT_EQ(others(near.checks, Verdict::pass), "");
  EXPECT_EQ(others(far.checks, Verdict::pass), "");
  ASSERT_EQ(near.checks.size(), far.checks.size());
  double largest = 0;
  for (const Check& check : far.checks) {
    const Check* same = findCheck(near.checks, check.name);
    ASSERT_NE(same, nullptr) << check.name;
    if (check.name == "motion.pose") continue;  // of the positions as they are given, so far from the origin
    EXPECT_LE(check.limit, 10 * same->limit) << check.name;
    EXPECT_GE(check.limit, 0.1 * same->limit) << check.name;
    if (same->limit > 0) largest = std::max(largest, check.limit / same->limit);
  }
  std::cout << "limits grow by up to " << largest << '\n';
  // Results are where the machine is.
  EXPECT_NEAR(far.timeseries.find("p_z_m")->front() - near.timeseries.find("p_z_m")->front(), GetParam(), 1e-9);
  EXPECT_NEAR(far.timeseries.find("sim_p_z_m")->back() - near.timeseries.find("sim_p_z_m")->back(), GetParam(), 1e-8);
  EXPECT_NEAR(far.timeseries.find("p_x_m")->front(), near.timeseries.find("p_x_m")->front(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Kilometres, FarAway, testing::Values(1e3, 1e5),
                         [](const auto& height) { return std::to_string(static_cast<int>(height.param / 1000)); });

}  // namespace
}  // namespace ursula

// A machine far from the base's origin is judged like the same machine at the origin.

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>

#include "tests/support/changed.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/evidence/reference.h"
#include "validation/replay/windowed_replay.h"

namespace ursula {
namespace {

/// The paper's machine and motion at z = `height`, which is b Δω̄.
Scenario helixAt(double height) {
  Scenario scenario = changed(scenarioOf("paper-helix"), ofEachLeg([&](Leg& leg) { leg.base_point.z() += height; }));
  scenario.text.clear();  // the scenario is no longer the file's
  scenario.simulation.samples = 61;
  HelixParameters helix;
  helix.radius = 0.2, helix.pitch = 1.2, helix.start_angle = -1.5707963267948966, helix.end_angle = -1.0471975511965976;
  helix.height_phase = 2.2 + height / helix.pitch;
  scenario.trajectory = makeHelix(helix);
  return scenario;
}

/// The reference at that height, made once for all tests.
std::shared_ptr<const Reference> referenceAt(double height) {
  static std::map<double, std::shared_ptr<const Reference>> made;
  std::shared_ptr<const Reference>& reference = made[height];
  if (!reference) reference = makeReference(helixAt(height));
  return reference;
}

ValidationResult judgedAt(double height) {
  ValidationOptions options;
  options.reference = referenceAt(height);
  return validate(helixAt(height), options);
}

class FarAway : public testing::TestWithParam<double> {};

/// Compares the limits of all quantities at every instant.
TEST_P(FarAway, everythingRoundsAsAtTheOrigin) {
  const auto near = referenceAt(0), far = referenceAt(GetParam());
  EXPECT_EQ(near->natural.origin, Vector3d::Zero());
  EXPECT_NEAR(far->natural.origin.z(), GetParam(), 8);
  double largest = 0;
  for (std::size_t q = 0; q < rounded_count; ++q) {
    const auto limit = [q](const Reference& reference, std::size_t k) {
      return reference.rounding().conditions[k].conditioning.rounding(static_cast<Rounded>(q));
    };
    for (std::size_t k = 1; k + 1 < near->rounding().conditions.size(); ++k) {  // at rest, rates have no size
      const double a = limit(*near, k), b = limit(*far, k);
      if (a == 0 && b == 0) continue;  // a formulation that this build lacks
      EXPECT_LE(b, 10 * a) << q << " at " << k;
      EXPECT_GE(b, 0.1 * a) << q << " at " << k;
      largest = std::max(largest, b / a);
    }
  }
  std::cout << "roundings grow by up to " << largest << '\n';
  const auto lastLimit = [](const Reference& reference) {
    const WindowedReplay& last = reference.replays().windows.back();
    return replayLimit(last, reference.rounding().position_scale, last.window.end());
  };
  EXPECT_LE(lastLimit(*far), 10 * lastLimit(*near));
}

TEST_P(FarAway, everyCheckPassesByLimitsLikeThoseAtTheOrigin) {
  static const ValidationResult near = judgedAt(0);
  const ValidationResult far = judgedAt(GetParam());
  EXPECT_EQ(others(near.checks, Verdict::pass), "");
  EXPECT_EQ(others(far.checks, Verdict::pass), "");
  ASSERT_EQ(near.checks.size(), far.checks.size());
  double largest = 0;
  for (const Check& check : far.checks) {
    const Check* same = findCheck(near.checks, check.name);
    ASSERT_NE(same, nullptr) << check.name;
    // These checks concern the given position, far from the origin, or rates at an instant with another speed. The test
    // above compares them.
    if (check.name == "motion.pose" || check.name.rfind("kinematics.", 0) == 0) continue;
    ASSERT_EQ(check.verdict, same->verdict) << check.name;
    if (check.verdict == Verdict::not_applicable) continue;
    EXPECT_LE(check.limit, 10 * same->limit) << check.name;
    if (same->limit > 0) largest = std::max(largest, check.limit / same->limit);
  }
  std::cout << "limits grow by up to " << largest << '\n';
  // Results are at the machine's place.
  EXPECT_NEAR(far.timeseries.find("p_z_m")->front() - near.timeseries.find("p_z_m")->front(), GetParam(), 1e-9);
  EXPECT_NEAR(far.timeseries.find("sim_p_z_m")->back() - near.timeseries.find("sim_p_z_m")->back(), GetParam(), 1e-8);
  EXPECT_NEAR(far.timeseries.find("p_x_m")->front(), near.timeseries.find("p_x_m")->front(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Kilometres, FarAway, testing::Values(1e3, 1e5),
                         [](const auto& height) { return std::to_string(static_cast<int>(height.param / 1000)); });

}  // namespace
}  // namespace ursula

// Measured rounding of formulations: limits hold at instants that were not measured, do not depend on model errors, and
// hardly depend on the frame.

#include "validation/limits/rounding_profile.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iostream>

#include "base/real50.h"
#include "nocsolver/noc/noc.h"
#include "parts/random/random_scenario.h"
#include "tests/support/changed.h"
#include "tests/validation/scenario_files.h"
#include "validation/subject/frame_change.h"

namespace ursula {
namespace {

constexpr int instants = 31;

/// The quantities of this build, which may lack MuJoCo.
std::vector<Rounded> quantities(const RoundingProfile& profile) {
  std::vector<Rounded> out;
  for (std::size_t q = 0; q < rounded_count; ++q) {
    const auto spreads = profile.spreads(static_cast<Rounded>(q));
    if (static_cast<Rounded>(q) > Rounded::further_engine && *std::max_element(spreads.begin(), spreads.end()) == 0)
      continue;
    out.push_back(static_cast<Rounded>(q));
  }
  return out;
}

/// The conditioning by `profile` at the k-th instant of `scenario`.
Conditioning at(const Scenario& scenario, const RoundingProfile& profile, int k, int of = instants) {
  return profile.at(scenario.trajectory->at(scenario.trajectory->duration() * k / (of - 1)));
}

/// Whether the quantity's rounding depends on the frame, as that of the NOC's direct dynamics does. It is measured at
/// the judged instant and compared with 50 digits.
bool isOfOneFrame(Rounded quantity) { return quantity == Rounded::direct || quantity == Rounded::solver_direct; }

/// Limit over twice the noise that was seen from elsewhere, in units of the shape, which is the same everywhere.
void expectDominance(const Scenario& scenario, unsigned seed, int of = instants) {
  const RoundingProfile profile(scenario, of);
  const double length = at(scenario, profile, 0, of).length;
  const RoundingProfile elsewhere(randomFrameChange(seed, length, *scenario.manipulator).transformed(scenario), of);
  double least = 1e300;
  for (const Rounded quantity : quantities(profile)) {
    if (isOfOneFrame(quantity)) continue;
    const std::vector<double> noise = elsewhere.spreads(quantity);
    for (int k = 0; k < of; ++k) {
      const Conditioning here = at(scenario, profile, k, of);
      const double level = here.levels[static_cast<std::size_t>(quantity)];
      EXPECT_GE(level, 2 * noise[static_cast<std::size_t>(k)])
          << "quantity " << static_cast<int>(quantity) << ", " << k;
      least = std::min(least, level / noise[static_cast<std::size_t>(k)]);
    }
  }
  std::cout << scenario.name << ": levels are at least " << least << " times the noise from elsewhere\n";
}

class Profile : public testing::TestWithParam<std::string> {
 protected:
  Scenario scenario_ = scenarioOf(GetParam());
};

TEST_P(Profile, dominatesTheNoiseSeenFromElsewhere) {
  for (unsigned seed : {1001u, 1002u}) expectDominance(scenario_, seed);
}

/// What was measured is noise: there is some in every quantity, and it is far below what it is the noise of.
TEST_P(Profile, measuresNoiseInEveryQuantity) {
  const RoundingProfile profile(scenario_, instants);
  for (const Rounded quantity : quantities(profile)) {
    std::vector<double> spreads = profile.spreads(quantity);
    ASSERT_EQ(spreads.size(), static_cast<std::size_t>(instants));
    std::sort(spreads.begin(), spreads.end());
    EXPECT_GT(spreads[instants / 2], 0) << static_cast<int>(quantity);
    EXPECT_LT(spreads.back(), 1000) << static_cast<int>(quantity);
  }
}

/// The NOC in doubles against itself in 50 digits: the true errors are below half of the limits.
TEST_P(Profile, dominatesTheTrueErrorOfTheSolver) {
  const RoundingProfile profile(scenario_, instants);
  const Noc<double> solver(*scenario_.manipulator);
  const Noc<Real50> exact(*scenario_.manipulator);
  NocWorkspace<double> work;
  NocWorkspace<Real50> exact_work;
  double closest = 0, closest_direct = 0;
  for (int k = 0; k < 5 * instants; ++k) {
    const Motion<double> motion = scenario_.trajectory->at(scenario_.trajectory->duration() * k / (5 * instants - 1));
    const Motion<Real50> same = exactly(motion);
    const Vector6d load = loadAtP(scenario_.load.get(), motion);
    const Vector6<Real50> exact_load = load.cast<Real50>();
    const Vector6d right = exact.inverseDynamics(same, exact_work, exact_load).cast<double>();
    const Vector6d torques = solver.inverseDynamics(motion, work, load), others = otherTorques(torques);
    const Conditioning here = profile.at(motion);
    closest = std::max(closest, (torques - right).cwiseAbs().maxCoeff() / here.rounding(Rounded::solver));
    const Vector6d moved =
        exact.directDynamics(same, Vector6<Real50>(others.cast<Real50>()), exact_work, exact_load).cast<double>();
    const Vector6d off = solver.directDynamics(motion, others, work, load) - moved;
    const double size = off.tail<3>().norm() + here.length * off.head<3>().norm();
    closest_direct = std::max(closest_direct, size / here.rounding(Rounded::solver_direct));
  }
  std::cout << GetParam() << ": the solver's true errors are at " << closest << " and " << closest_direct
            << " of their limits\n";
  EXPECT_LT(closest, 0.5);
  EXPECT_LT(closest_direct, 0.5);
  EXPECT_GT(closest, 1e-3) << "the limit says nothing";
  EXPECT_GT(closest_direct, 1e-3) << "the limit says nothing";
}

/// Turned with its gravity and the motion, the limits are the same within a factor of two, where they are nearest to a
/// verdict: their largest over the motion, and their mean.
TEST_P(Profile, limitsAreTheSameHoweverTheWorldIsTurned) {
  FrameChange turned;
  turned.turn = Eigen::AngleAxisd(1.1, Vector3d(0.6, -0.64, 0.48)).toRotationMatrix();
  const Scenario there = turned.transformed(scenario_);
  const RoundingProfile a(scenario_, instants), b(there, instants);
  double furthest = 1;
  for (const Rounded quantity : quantities(a)) {
    double largest_a = 0, largest_b = 0, mean = 0;
    for (int k = 0; k < instants; ++k) {
      const double x = at(scenario_, a, k).rounding(quantity), y = at(there, b, k).rounding(quantity);
      largest_a = std::max(largest_a, x), largest_b = std::max(largest_b, y);
      if (x > 0) mean += std::log2(y / x) / instants;
    }
    EXPECT_LT(std::abs(std::log2(largest_b / largest_a)), 1) << "quantity " << static_cast<int>(quantity);
    EXPECT_LT(std::abs(mean), 1) << "quantity " << static_cast<int>(quantity);
    furthest = std::max({furthest, largest_b / largest_a, largest_a / largest_b});
  }
  std::cout << GetParam() << ": limits differ by a factor of up to " << furthest << '\n';
}

/// A machine that is wrong alike in every frame rounds like the right one, so a model error does not widen its own
/// limit.
TEST_P(Profile, knowsNothingOfAWrongModel) {
  const Scenario wrong = changed(scenario_, [](auto& machine) {
    machine.platform.mass *= 1.01;
    machine.legs[2].base_axis += Vector3d(0.01, -0.02, 0.01);
  });
  const RoundingProfile a(scenario_, instants), b(wrong, instants);
  for (const Rounded quantity : quantities(a)) {
    const auto largest = [quantity](const RoundingProfile& of) {
      const auto spreads = of.spreads(quantity);
      return *std::max_element(spreads.begin(), spreads.end());
    };
    EXPECT_LT(largest(b), 3 * largest(a)) << static_cast<int>(quantity);
    EXPECT_GT(largest(b), largest(a) / 3) << static_cast<int>(quantity);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Profile,
                         testing::Values("paper-helix", "near-singular", "millimetres", "proving-ground", "light-legs",
                                         "load-table"),
                         byName);

TEST(RandomProfiles, dominateTheNoiseSeenFromElsewhere) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
    expectDominance(randomScenario(seed), static_cast<unsigned>(2000 + seed), 9);
}

/// A held pose is measured anew at each instant, so its noise is not one repeated number.
TEST(ProfileAt, measuresAHeldPoseAnewAtEachInstant) {
  const RoundingProfile profile(scenarioOf("hold"), instants);
  std::vector<double> spreads = profile.spreads(Rounded::effort);
  std::sort(spreads.begin(), spreads.end());
  EXPECT_GE(std::unique(spreads.begin(), spreads.end()) - spreads.begin(), instants / 2);
  EXPECT_GT(spreads.back(), 0);
}

TEST(ProfileAt, takesTheLargestOfTheFiveInstantsAbout) {
  const Scenario scenario = scenarioOf("paper-helix");
  const RoundingProfile profile(scenario, instants);
  const std::vector<double> spreads = profile.spreads(Rounded::torque);
  for (int k = 0; k < instants; ++k) {
    const auto first = spreads.begin() + std::max(0, k - 2), last = spreads.begin() + std::min(instants, k + 3);
    EXPECT_DOUBLE_EQ(at(scenario, profile, k).levels[static_cast<std::size_t>(Rounded::torque)],
                     rounding_floor + rounding_safety * *std::max_element(first, last));
  }
}

/// Near a singular pose the worst case does not set the limit.
TEST(ProfileAt, hasAFloorThatIsASmallShareOfTheQuantity) {
  const Scenario scenario = scenarioOf("near-singular");
  const RoundingProfile profile(scenario, instants);
  double largest = 0;
  int held = 0;
  for (int k = 0; k < instants; ++k) {
    Conditioning here = at(scenario, profile, k), even = here;
    even.kappa_B = even.kappa_legs = 1;
    const auto q = static_cast<std::size_t>(Rounded::jacobian_rate);
    const double spread = profile.spreads(Rounded::jacobian_rate)[static_cast<std::size_t>(k)];
    const double floor = (here.levels[q] - rounding_safety * spread) * here.shape(Rounded::jacobian_rate);
    const double quantity = even.shape(Rounded::jacobian_rate) / std::numeric_limits<double>::epsilon();
    EXPECT_GT(here.levels[q], rounding_safety * spread);
    largest = std::max(largest, here.shape(Rounded::jacobian_rate) / even.shape(Rounded::jacobian_rate));
    const std::vector<double> spreads = profile.spreads(Rounded::jacobian_rate);
    if (spread < *std::max_element(spreads.begin(), spreads.end())) continue;  // a neighbour's spread is larger
    EXPECT_LE(floor, 1.001 * floor_share * quantity);
    ++held;
  }
  EXPECT_GT(largest, 1e6) << "no worst case is met here";
  EXPECT_GT(held, 0);
}

TEST(ProfileInstants, areEnoughAlsoForFewSamples) {
  EXPECT_EQ(profileInstants(2), 21);
  EXPECT_EQ(profileInstants(31), 31);
  EXPECT_EQ(profileInstants(301), 61);
}

}  // namespace
}  // namespace ursula

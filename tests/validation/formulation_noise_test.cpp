// No formulation excuses itself by its own noise, or by its own spread over changes of frame.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <iostream>

#include "parts/engines/mujoco/mujoco_loop.h"
#include "parts/random/random_scenario.h"
#include "tests/support/matchers.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/evidence/injected_fault.h"
#include "validation/limits/rounding_profile.h"
#include "validation/subject/frame_change.h"

namespace ursula {
namespace {

/// Right formulations spread by at most a tenth of what rounding explains. Over changes of frame, their efforts differ
/// by at most half of their limit.
void expectHonest(const Scenario& given, int instants) {
  const RoundingProfile profile(naturalFrameChange(given).transformed(given), instants);
  double spread = 0, apart = 0;
  for (std::size_t q = 0; q < rounded_count; ++q)
    spread = std::max(spread, profile.largestOfOne(static_cast<Rounded>(q)));
  for (const FrameDifference& each : profile.acrossFrames())
    if (each.difference != 0) apart = std::max(apart, each.difference / each.limit);
  std::cout << given.name << ": " << spread << " of the bound, " << apart << " of the limit over frames\n";
  EXPECT_LT(spread, 0.1) << given.name;
  EXPECT_LT(apart, 0.5) << given.name;
  EXPECT_GT(apart, 0) << given.name;
}

TEST(HonestFormulations, ofShippedScenariosStayFarBelowTheBound) {
  for (const std::string& name : shippedScenarios()) expectHonest(scenarioOf(name), 9);
}

TEST(HonestFormulations, ofRandomMachinesStayFarBelowTheBound) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
    for (const RandomKind kind : {RandomKind::URS, RandomKind::mixture}) expectHonest(randomScenario(seed, kind), 5);
}

using Noise = std::function<Vector6d(const Vector6d& right)>;

/// Off by up to `share`, by a hash of each number's bits.
Noise hashed(double share) {
  return [share](const Vector6d& right) {
    Vector6d out = right;
    for (double& each : out) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &each, sizeof bits);
      each *= 1 + share * (static_cast<double>((bits * 0x9e3779b97f4a7c15U) >> 11) * 0x1p-52 - 1);
    }
    return out;
  };
}

/// Loses digits to two equal terms that cancel and round differently.
Noise cancelled(double terms) {
  return [terms](const Vector6d& right) { return Vector6d(right + (terms * (3 * right) - (3 * terms) * right)); };
}

/// Rounds to a grid, so that the answers to changed inputs are equal: no noise, but an error.
Noise cut(double terms) {
  return [terms](const Vector6d& right) {
    const double size = terms * right.norm();
    return Vector6d((right.array() + size) - size);
  };
}

std::function<Subject(const Subject&)> solverWith(const Noise& noise) {
  return [noise](const Subject& right) {
    Subject out = right;
    out.torques = [torques = right.torques, noise](const Motion<double>& motion) { return noise(torques(motion)); };
    out.rebuilt = nullptr;
    return out;
  };
}

const Scenario& helix() {
  static const Scenario scenario = scenarioOf("paper-helix", 11);
  return scenario;
}

ValidationResult judged(const FormulationFaults& faults) {
  ValidationOptions options{false, false, false};
  const auto fault = std::make_shared<InjectedFault>();
  fault->formulations = faults;
  options.fault = fault;
  const SubjectOf make = [&faults](const Scenario& scenario) {
    return faults.solver ? faults.solver(solverOf(scenario)) : solverOf(scenario);
  };
  return validateMade(helix(), make, options);
}

class NoisySolver : public testing::TestWithParam<std::pair<const char*, Noise>> {};

TEST_P(NoisySolver, isInconclusiveAndSaysWhy) {
  const ValidationResult result = judged({{}, {}, solverWith(GetParam().second)});
  EXPECT_EQ(result.verdict, Verdict::inconclusive);
  for (const char* name :
       {"torque.pointwise", "torque.twin", "torque.maximal", "acceleration.pointwise", "feedback.torque"}) {
    const Check* check = findCheck(result.checks, name);
    ASSERT_NE(check, nullptr) << name;
    EXPECT_EQ(check->verdict, Verdict::inconclusive) << name << ": " << check->why;
    EXPECT_THAT(check->why, HasSubstr("this program's NOC is noisy")) << name;
  }
  EXPECT_EQ(verdictOf(result.checks, "replay.position"), "inconclusive");
  EXPECT_EQ(verdictOf(result.checks, "kinematics.positions"), "pass") << "its kinematics are as they were";
}

INSTANTIATE_TEST_SUITE_P(Noises, NoisySolver,
                         testing::Values(std::pair("hash", hashed(1e-7)), std::pair("cancellation", cancelled(1.1e9))),
                         [](const auto& noise) { return noise.param.first; });

/// Some roundings more are measured, as those of any solver.
TEST(NoisyFormulations, ofSomeRoundingsHaveALimit) {
  EXPECT_EQ(judged({{}, {}, solverWith(hashed(4e-16))}).verdict, Verdict::pass);
}

TEST(NoisyFormulations, thatAreCutOffFail) { EXPECT_EQ(judged({{}, {}, solverWith(cut(1e9))}).verdict, Verdict::fail); }

TEST(NoisyFormulations, areNamedIfTheyAreEngines) {
  FormulationFaults faults;
  faults.further[1].efforts = [noise = hashed(1e-7)](Vector6d& efforts) { efforts = noise(efforts); };
  const ValidationResult result = judged(faults);
  EXPECT_NE(result.verdict, Verdict::pass);
  const Check* maximal = findCheck(result.checks, "torque.maximal");
  ASSERT_NE(maximal, nullptr);
  EXPECT_EQ(maximal->verdict, Verdict::inconclusive);
  EXPECT_THAT(maximal->why, HasSubstr("maximal coordinates is noisy"));
  EXPECT_EQ(verdictOf(result.checks, "torque.pointwise"), "pass");
}

struct Uneven {
  const char *name, *check;  ///< the check that fails first
  FormulationFaults faults;
};

FormulationFaults simbody(const EngineFault& fault) { return {fault, {}, nullptr}; }

FormulationFaults further(std::size_t k, const EngineFault& fault) {
  FormulationFaults out;
  out.further[k] = fault;
  return out;
}

using P = ManipulatorParameters;

/// Errors that differ between an engine's frames, because they depend on a leg, a motor, an axis or the frame.
const std::vector<Uneven> uneven = {
    {"leg", "torque.pointwise", simbody({[](P& m) { m.legs[4].distal.mass *= 1 + 1e-9; }, nullptr})},
    {"motor", "torque.pointwise", simbody({nullptr, [](Vector6d& efforts) { efforts(4) *= 1 + 1e-9; }})},
    {"axis", "torque.pointwise", simbody({[](P& m) { m.gravity.z() *= 1 + 1e-9; }, nullptr})},
    {"leg_in_maximal_coordinates", "torque.maximal",
     further(1, {[](P& m) { m.legs[2].distal.center_of_mass *= 1 + 1e-9; }, nullptr})},
    {"frame", "invariance.engines", further(1, {[](P& m) { m.gravity.x() *= 1 + 1e-9; }, nullptr})},
};

class UnevenEngine : public testing::TestWithParam<Uneven> {};

TEST_P(UnevenEngine, failsAndWidensNoLimit) {
  const RoundingProfile right(helix(), 11), wrong(helix(), 11, {}, GetParam().faults);
  for (const Rounded quantity : {Rounded::torque, Rounded::acceleration, ofFurtherEngine(1)})
    EXPECT_LT(wrong.largestOfOne(quantity), 3 * right.largestOfOne(quantity)) << static_cast<int>(quantity);
  const ValidationResult result = judged(GetParam().faults);
  EXPECT_EQ(result.verdict, Verdict::fail);
  EXPECT_EQ(firstFailing(result.checks), GetParam().check);
  const Check* frames = findCheck(result.checks, "invariance.engines");
  ASSERT_NE(frames, nullptr);
  EXPECT_EQ(frames->verdict, Verdict::fail) << frames->why;
  EXPECT_THAT(frames->why, HasSubstr(GetParam().faults.simbody ? "Simbody, free platform" : "maximal coordinates"));
}

INSTANTIATE_TEST_SUITE_P(Errors, UnevenEngine, testing::ValuesIn(uneven),
                         [](const auto& error) { return error.param.name; });

/// The same for an engine without an error, so that the mechanism itself triggers nothing.
TEST(EvenEngines, pass) {
  EXPECT_EQ(judged(further(1, {[](P&) {}, [](Vector6d&) {}})).verdict, Verdict::pass);
}

}  // namespace
}  // namespace ursula

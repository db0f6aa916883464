// Maximal coordinates and MuJoCo for any number of legs of all kinds with motors anywhere. They are compared with
// vectors from positions in 100 digits, with each other and with the solver, which share only raw parameters. A
// parameter that is wrong in one of them must be seen.

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <string>
#include <thread>

#include "tests/engines/engine_kinds.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

class OnVectors : public testing::TestWithParam<std::string> {};

TEST_P(OnVectors, bothEnginesHaveTheirEfforts) {
  const Scenario scenario = vectorScenario(GetParam());
  double worst = 0;
  for (const VectorRow& row : vectorRows(GetParam())) {
    const Vector6d expected = row.torques.cast<double>();
    for (const Vector6d& found : byEngines(*scenario.manipulator, scenario.load, rounded(row.motion))) {
      EXPECT_LE(largest(found - expected), room * largest(expected));
      worst = std::max(worst, largest(found - expected) / largest(expected));
    }
    EXPECT_GT(largest(expected), 1);
  }
  std::cout << "from the vectors " << worst << '\n';
}

class OnVectorsOfSixLegs : public OnVectors {};

/// Frames and mass centres are those of the contract, and twists are their rates.
TEST_P(OnVectorsOfSixLegs, bodiesMoveAsTheSolversDo) {
  const Scenario scenario = vectorScenario(GetParam());
  MaximalLoop loop(*scenario.manipulator);
  const Noc<double> solver(*scenario.manipulator);
  NocWorkspace<double> work;
  BodyMotions<double> expected;
  for (const VectorRow& row : vectorRows(GetParam())) {
    const Motion<double> motion = rounded(row.motion);
    loop.inverseDynamics(motion);
    solver.inverseKinematics(motion, work);
    solver.bodyMotions(motion, work, expected);
    for (std::size_t b = 0; b < body_count; ++b) {
      const BodyMotion<double> found = loop.bodies()[b];
      EXPECT_LE((found.R - expected[b].R).norm(), room) << b;
      EXPECT_LE((found.c - expected[b].c).norm(), room) << b;
      EXPECT_LE((found.twist - expected[b].twist).norm(), room * (1 + expected[b].twist.norm())) << b;
      EXPECT_LE((found.twist_rate - expected[b].twist_rate).norm(), room * (1 + expected[b].twist_rate.norm())) << b;
    }
  }
}

std::vector<std::string> namesOfSixLegs() {
  std::vector<std::string> names = allNames();
  const auto has_fewer = [](const std::string& name) {
    return vectorScenario(name).manipulator->legCount() < leg_count;
  };
  names.erase(std::remove_if(names.begin(), names.end(), has_fewer), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Machines, OnVectors, testing::ValuesIn(allNames()), byName);
INSTANTIATE_TEST_SUITE_P(Machines, OnVectorsOfSixLegs, testing::ValuesIn(namesOfSixLegs()), byName);

struct Structure {
  const char* name;
  std::vector<LegKind> kinds;
};

const std::vector<Structure> structures = {
    {"URS_3", {U, U, U}}, {"URS_6", {U, U, U, U, U, U}}, {"UPS_3", {T, T, T}},      {"UPS_6", {T, T, T, T, T, T}},
    {"RUS_3", {R, R, R}}, {"RUS_6", {R, R, R, R, R, R}}, {"PUS_3", {P, P, P}},      {"PUS_6", {P, P, P, P, P, P}},
    {"three", {T, R, P}}, {"four", {U, T, R, P}},        {"five", {P, R, U, T, P}}, {"six", {R, P, T, U, P, R}},
};

class OnMachinesAtRandom : public testing::TestWithParam<Structure> {};

/// The states have any pose, twist and twist rate, with motors on any coordinates, friction on all, and a load.
TEST_P(OnMachinesAtRandom, theEnginesAgree) {
  SeededDraws dice(101);
  double from_solver = 0, from_each_other = 0;
  int asked = 0;
  for (int k = 0; asked < 40 && k < 4000; ++k) {
    const KindCase thrown = thrownCase(dice, GetParam().kinds);
    const Manipulator machine(thrown.machine);
    const std::optional<Vector6d> expected = bySolver(machine, thrown.load.get(), thrown.motion);
    if (!expected) continue;
    ++asked;
    const std::vector<Vector6d> found = byEngines(machine, thrown.load, thrown.motion);
    for (const Vector6d& efforts : found)
      from_solver = std::max(from_solver, largest(efforts - *expected) / largest(*expected));
    from_each_other = std::max(from_each_other, largest(found.front() - found.back()) / largest(*expected));
    EXPECT_GT(largest(byEngines(machine, nullptr, thrown.motion)[0] - *expected), 1e3 * room * largest(*expected))
        << "the load is seen";
  }
  std::cout << "from the solver " << from_solver << ", from each other " << from_each_other << '\n';
  EXPECT_EQ(asked, 40);
  EXPECT_LE(from_solver, room);
  EXPECT_LE(from_each_other, room);
  EXPECT_GT(from_solver, 0) << "no two formulations round alike";
}

INSTANTIATE_TEST_SUITE_P(Structures, OnMachinesAtRandom, testing::ValuesIn(structures),
                         [](const auto& each) { return std::string(each.param.name); });

/// Answers are equal to the last bit, whatever was asked before and whatever structures other threads build meanwhile.
TEST(EnginesOfKinds, answerAlikeOnWhateverThread) {
  if (!mujocoAvailable()) GTEST_SKIP() << "built without MuJoCo";
  std::vector<KindCase> cases;
  for (const std::vector<LegKind>& kinds : {std::vector<LegKind>{P, T, R}, {T, P, R}, {R, P, T}, {P, P, R, R}})
    cases.push_back(goodCase(kinds, 103));
  const auto answer = [](const KindCase& one, bool asked_before) {
    MujocoLoop loop(Manipulator(one.machine), one.load);
    Motion<double> other = one.motion;
    other.p_ddot *= 2;
    if (asked_before) loop.inverseDynamics(other);
    return loop.inverseDynamics(one.motion);
  };
  std::vector<Vector6d> found(2 * cases.size());
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < found.size(); ++k)
    threads.emplace_back([&, k] { found[k] = answer(cases[k % cases.size()], true); });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k], answer(cases[k % cases.size()], false));
}

}  // namespace
}  // namespace ursula

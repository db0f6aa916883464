// Every error of parts/wrong_formulas/formula_errors.h changes the solver's results for a moving machine. With no error
// set the results are equal to the last bit.

#include <gtest/gtest.h>

#include <array>
#include <iostream>
#include <map>

#include "nocsolver/noc/noc.h"
#include "parts/wrong_formulas/wrong_noc.h"
#include "tests/support/motions.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

/// All results that a reading can change, kind by kind.
struct Answer {
  explicit Answer(std::string why) : refused(std::move(why)) {}

  Answer(const Noc<double>& solver, const Motion<double>& motion) {
    NocWorkspace<double> work;
    BodyMotions<double> bodies;
    TwistShaping<double> shaping, shaping_rate;
    solver.inverseKinematics(motion, work);
    solver.jacobians(motion, work);
    solver.bodyMotions(motion, work, bodies);
    solver.twistShapingRate(motion, work);
    shaping = work.T;
    shaping_rate = work.T_rate;
    const auto joints = [](const JointVariables<double>& q) {
      Eigen::VectorXd out(18);
      out << q.phi, q.psi, q.theta;
      return out;
    };
    const auto flat = [](const auto& m) { return Eigen::VectorXd(m.reshaped()); };
    kinds["angles"] = joints(solver.angles(work));
    kinds["rates"] = joints(solver.rates(work));
    kinds["accelerations"] = joints(solver.accelerations(work));
    kinds["T"] = flat(solver.platformShaping(work));
    kinds["T rate"] = flat(solver.platformShapingRate(motion, work));
    kinds["shaping"] = flat(shaping);
    kinds["shaping rate"] = flat(shaping_rate);
    kinds["twists"] = kinds["twist rates"] = Eigen::VectorXd(6 * body_count);
    for (int b = 0; b < body_count; ++b) {
      kinds["twists"].segment<6>(6 * b) = bodies[static_cast<std::size_t>(b)].twist;
      kinds["twist rates"].segment<6>(6 * b) = bodies[static_cast<std::size_t>(b)].twist_rate;
    }
    kinds["mass matrix"] = flat(solver.massMatrixAtP(motion, work));
    kinds["torques"] = solver.inverseDynamics(motion, work);
    kinds["direct"] = solver.directDynamics(motion, Vector6d::Ones(), work);
  }

  std::map<std::string, Eigen::VectorXd> kinds;
  std::string refused;
};

Answer altered(const Manipulator& manipulator, const Motion<double>& motion, const WithFormulaErrors& formula_errors) {
  try {
    return Answer(WrongNoc<double>(manipulator, formula_errors), motion);
  } catch (const PoseError& error) {
    return Answer(error.what());
  }
}

/// The kind with the largest relative change in the norm; a refusal counts as 1.
std::pair<std::string, double> largestEffect(const Answer& right, const Answer& wrong) {
  if (!wrong.refused.empty()) return {"refused: " + wrong.refused, 1};
  std::pair<std::string, double> out{"none", 0};
  for (const auto& [kind, values] : right.kinds) {
    const double effect = (wrong.kinds.at(kind) - values).norm() / values.norm();
    if (!(effect <= out.second)) out = {kind, effect};
  }
  return out;
}

class EveryFormulaError : public testing::TestWithParam<int> {};

TEST_P(EveryFormulaError, makesADifference) {
  const Scenario scenario = vectorScenario("random-4");
  SeededDraws dice(17);
  const Motion<double> motion = randomState(scenario, dice);
  const Answer right(Noc<double>(*scenario.manipulator), motion);
  const Answer wrong = altered(*scenario.manipulator, motion, WithFormulaErrors(static_cast<FormulaError>(GetParam())));
  const auto [kind, size] = largestEffect(right, wrong);
  std::cout << "error " << GetParam() << ": " << kind << " off by " << size << '\n';
  EXPECT_GT(size, 1e-4);  // far above rounding, some 1e-14
}

/// Errors from half_coriolis on belong to the general formulation.
INSTANTIATE_TEST_SUITE_P(OfAll, EveryFormulaError, testing::Range(0, static_cast<int>(FormulaError::half_coriolis)));

class Corrections : public testing::TestWithParam<std::string> {};

TEST_P(Corrections, areWhatIsReadWithNoFormulaErrorSet) {
  const Scenario scenario = vectorScenario(GetParam());
  SeededDraws dice(19);
  for (int k = 0; k < 5; ++k) {
    const Motion<double> motion = randomState(scenario, dice);
    const Answer right(Noc<double>(*scenario.manipulator), motion);
    const Answer same = altered(*scenario.manipulator, motion, WithFormulaErrors{});
    ASSERT_EQ(same.refused, "");
    for (const auto& [kind, values] : right.kinds)
      EXPECT_TRUE((same.kinds.at(kind).array() == values.array()).all()) << kind;
  }
}

INSTANTIATE_TEST_SUITE_P(Machines, Corrections, testing::ValuesIn(vectorNames()),
                         [](const auto& name) { return "of_" + std::string(1, name.param.back()); });

TEST(FormulaErrors, canBeSetTogether) {
  const WithFormulaErrors two = WithFormulaErrors(FormulaError::eq15a).set(FormulaError::eq47);
  EXPECT_TRUE(two.has(FormulaError::eq15a) && two.has(FormulaError::eq47));
  EXPECT_FALSE(two.has(FormulaError::eq16));
}

}  // namespace
}  // namespace ursula

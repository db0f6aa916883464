// Compares the solver with tests/vectors, which were made without any of the paper's rate formulas.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "base/real50.h"
#include "nocsolver/noc/noc.h"
#include "tests/nocsolver/rounding.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

/// The promised accuracy of every quantity, relative in the norm over the legs.
constexpr double promised = 1e-12;

/// The largest ‖found − expected‖/‖expected‖ of every kind of quantity; a NaN is kept.
struct Errors {
  double torques = 0, angles = 0, rates = 0, accelerations = 0, motion = 0;

  double worst() const { return std::max({torques, angles, rates, accelerations, motion}); }
};

template <class V, class W>
void widen(double& worst, const V& found, const W& expected) {
  const Vector6<Real50> difference = found.template cast<Real50>() - expected;
  const double error = static_cast<double>(Real50(difference.norm() / expected.norm()));
  worst = error <= worst ? worst : error;
}

template <class S>
void widen(double& worst, const JointVariables<S>& found, const JointVariables<Real50>& expected) {
  widen(worst, found.phi, expected.phi);
  widen(worst, found.psi, expected.psi);
  widen(worst, found.theta, expected.theta);
}

template <class S, class R>
Errors errorsAt(const Noc<S, R>& solver, const Motion<S>& motion, const VectorRow& row, Errors errors) {
  NocWorkspace<S> work;
  widen(errors.torques, solver.inverseDynamics(motion, work), row.torques);
  widen(errors.angles, solver.angles(work), row.q);
  widen(errors.rates, solver.rates(work), row.q_dot);
  widen(errors.accelerations, solver.accelerations(work), row.q_ddot);
  return errors;
}

template <class S>
void widenMotion(double& worst, const Motion<S>& found, const Motion<Real50>& expected) {
  const auto six = [](const auto& a, const auto& b) {
    Vector6<Real50> out;
    out << a.template cast<Real50>(), b.template cast<Real50>();
    return out;
  };
  widen(worst, six(found.p, found.Q.col(0)), six(expected.p, expected.Q.col(0)));
  widen(worst, six(found.Q.col(1), found.Q.col(2)), six(expected.Q.col(1), expected.Q.col(2)));
  widen(worst, six(found.omega, found.p_dot), six(expected.omega, expected.p_dot));
  widen(worst, six(found.omega_dot, found.p_ddot), six(expected.omega_dot, expected.p_ddot));
}

void print(const std::string& what, const Errors& errors) {
  std::cout << what << ": torques " << errors.torques << ", angles " << errors.angles << ", rates " << errors.rates
            << ", accelerations " << errors.accelerations << ", motion " << errors.motion << '\n';
}

class Vectors : public testing::TestWithParam<std::string> {
 protected:
  Scenario scenario_ = vectorScenario(GetParam());
  std::vector<VectorRow> rows_ = vectorRows(GetParam());
};

TEST_P(Vectors, inDoublesFromTheirMotion) {
  const Noc<double> solver(*scenario_.manipulator);
  Errors errors;
  for (const VectorRow& row : rows_) errors = errorsAt(solver, rounded(row.motion), row, errors);
  print("doubles, their motion", errors);
  EXPECT_LE(errors.worst(), promised);
}

TEST_P(Vectors, inDoublesFromTheTrajectory) {
  const Noc<double> solver(*scenario_.manipulator);
  Errors errors;
  for (const VectorRow& row : rows_) {
    const Motion<double> motion = scenario_.trajectory->at(static_cast<double>(row.motion.t));
    widenMotion(errors.motion, motion, row.motion);
    errors = errorsAt(solver, motion, row, errors);
  }
  print("doubles, trajectory", errors);
  EXPECT_LE(errors.worst(), promised);
}

/// In 50 digits only the machine's numbers have errors, because reading rounded them to doubles (0.3420 is none). That
/// is half an ulp of each of the 32 numbers of a leg, the platform and the motion in a torque, times the conditioning.
TEST_P(Vectors, inFiftyDigitsUpToTheRoundingOfTheParameters) {
  const Noc<Real50> solver(*scenario_.manipulator);
  NocWorkspace<Real50> work;
  Errors errors;
  double condition = 0;
  for (const VectorRow& row : rows_) {
    const Motion<Real50> motion = scenario_.trajectory->at(row.motion.t);
    widenMotion(errors.motion, motion, row.motion);
    errors = errorsAt(solver, motion, row, errorsAt(solver, row.motion, row, errors));
    solver.inverseDynamics(motion, work);
    condition = std::max(condition, static_cast<double>(conditionNumber(solver, work)));
  }
  print("50 digits", errors);
  EXPECT_LE(errors.worst(), 32 * 0x1p-53 * condition);
}

/// Controls: another instant's motion, and each level of formulas as printed in our source.
TEST_P(Vectors, areMissedByAWrongMotionAndByWrongFormulas) {
  const Noc<double> solver(*scenario_.manipulator);
  const Errors other = errorsAt(solver, rounded(rows_[1].motion), rows_[2], {});
  EXPECT_GT(std::min({other.torques, other.angles, other.rates, other.accelerations}), 1e9 * promised);
  const auto altered = [&](FormulaError formula_error) {
    const Noc<double, WithFormulaErrors> wrong(*scenario_.manipulator, WithFormulaErrors(formula_error));
    return errorsAt(wrong, rounded(rows_[2].motion), rows_[2], {});
  };
  EXPECT_GT(altered(FormulaError::eq14b).angles, 1e9 * promised);
  EXPECT_GT(altered(FormulaError::eq15a).rates, 1e9 * promised);
  EXPECT_GT(altered(FormulaError::eq19b).accelerations, 1e9 * promised);
  EXPECT_GT(altered(FormulaError::eq23).torques, 1e9 * promised);
}

INSTANTIATE_TEST_SUITE_P(All, Vectors, testing::ValuesIn(vectorNames()), [](const auto& name) {
  std::string out = name.param;
  std::replace(out.begin(), out.end(), '-', '_');
  return out;
});

}  // namespace
}  // namespace ursula

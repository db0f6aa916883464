// Every rate against central differences of the level below, in 50 digits, along motions that turn about all axes.

#include <gtest/gtest.h>

#include <iostream>

#include "base/real50.h"
#include "nocsolver/noc/noc.h"
#include "parts/wrong_formulas/wrong_noc.h"
#include "tests/model/derivatives.h"
#include "tests/nocsolver/rounding.h"
#include "tests/support/motions.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

/// All results of the solver at one instant.
struct Answer {
  Motion<Real50> motion;
  NocWorkspace<Real50> work;
  JointVariables<Real50> q, q_dot, q_ddot;
  Matrix6<Real50> T, T_rate;
  BodyMotions<Real50> bodies;
  TwistShaping<Real50> shaping, shaping_rate;
};

Answer answerAt(const Noc<Real50>& solver, const Motion<Real50>& motion) {
  Answer out;
  out.motion = motion;
  solver.inverseKinematics(motion, out.work);
  solver.jacobians(motion, out.work);
  out.q = solver.angles(out.work);
  out.q_dot = solver.rates(out.work);
  out.q_ddot = solver.accelerations(out.work);
  out.T = solver.platformShaping(out.work);
  out.T_rate = solver.platformShapingRate(motion, out.work);
  solver.bodyMotions(motion, out.work, out.bodies);
  solver.twistShapingRate(motion, out.work);
  out.shaping = out.work.T;
  out.shaping_rate = out.work.T_rate;
  return out;
}

/// The largest mismatch of each level with the derivative of the level below, and of the identities between levels.
struct Mismatch {
  double rates = 0, accelerations = 0, a_ii = 0, T_rate = 0, twists = 0, twist_rates = 0, shaping_rate = 0;
  double t_P = 0, t_P_rate = 0, shaped_twists = 0, shaped_rates = 0;  ///< (24), (25), (32a), (32b)
};

template <class V>
void widen(double& worst, const V& difference) {
  const double error = static_cast<double>(Real50(difference.norm()));
  worst = error <= worst ? worst : error;
}

Vector6<Real50> twistOf(const Motion<Real50>& m) { return (Vector6<Real50>() << m.omega, m.p_dot).finished(); }
Vector6<Real50> twistRateOf(const Motion<Real50>& m) { return (Vector6<Real50>() << m.omega_dot, m.p_ddot).finished(); }

void widenJoints(double& worst, const JointVariables<Real50>& before, const JointVariables<Real50>& after,
                 const JointVariables<Real50>& rate) {
  widen(worst, rate.phi - centralDifference(before.phi, after.phi));
  widen(worst, rate.psi - centralDifference(before.psi, after.psi));
  widen(worst, rate.theta - centralDifference(before.theta, after.theta));
}

void widenBodies(const Answer& before, const Answer& now, const Answer& after, Mismatch& out) {
  Eigen::Matrix<Real50, 6 * body_count, 1> twists, twist_rates;
  for (std::size_t b = 0; b < body_count; ++b) {
    const BodyMotion<Real50>&from = before.bodies[b], &body = now.bodies[b], &to = after.bodies[b];
    const Matrix3<Real50> spin = centralDifference(from.R, to.R) * body.R.transpose();
    Vector6<Real50> twist;
    twist << spin(2, 1), spin(0, 2), spin(1, 0), centralDifference(from.c, to.c);
    widen(out.twists, body.twist - twist);
    widen(out.twist_rates, body.twist_rate - centralDifference(from.twist, to.twist));
    twists.segment<6>(static_cast<Eigen::Index>(6 * b)) = body.twist;
    twist_rates.segment<6>(static_cast<Eigen::Index>(6 * b)) = body.twist_rate;
  }
  widen(out.shaped_twists, now.shaping * now.q_dot.phi - twists);
  widen(out.shaped_rates, now.shaping * now.q_ddot.phi + now.shaping_rate * now.q_dot.phi - twist_rates);
}

Mismatch mismatchOf(const std::string& name, const WithFormulaErrors& errors = {}) {
  const Scenario scenario = vectorScenario(name);
  const WrongNoc<Real50> solver(*scenario.manipulator, errors);
  const auto trajectory = tumbling(scenario, 20);
  Mismatch out;
  for (const double instant : instantsInside(trajectory->duration(), 3)) {
    const Real50 t(instant);
    const Answer before = answerAt(solver, trajectory->at(Real50(t - difference_step)));
    const Answer now = answerAt(solver, trajectory->at(t));
    const Answer after = answerAt(solver, trajectory->at(Real50(t + difference_step)));
    widenJoints(out.rates, before.q, after.q, now.q_dot);
    widenJoints(out.accelerations, before.q_dot, after.q_dot, now.q_ddot);
    widen(out.T_rate, now.T_rate - centralDifference(before.T, after.T));
    widen(out.shaping_rate, now.shaping_rate - centralDifference(before.shaping, after.shaping));
    for (std::size_t i = 0; i < leg_count; ++i)
      widen(out.a_ii, Eigen::Matrix<Real50, 1, 1>(now.work.legs[i].row[0].A_dot -
                                                  centralDifference(before.work.A, after.work.A)(static_cast<int>(i))));
    widen(out.t_P, now.T * now.q_dot.phi - twistOf(now.motion));
    widen(out.t_P_rate, now.T * now.q_ddot.phi + now.T_rate * now.q_dot.phi - twistRateOf(now.motion));
    widenBodies(before, now, after, out);
  }
  return out;
}

/// An identity has rounding only; 50 digits leave it far below what a difference resolves.
constexpr double identity_tolerance = difference_tolerance * 1e-20;

class Kinematics : public testing::TestWithParam<std::string> {};

TEST_P(Kinematics, everyRateIsTheDerivativeOfTheLevelBelow) {
  const Mismatch found = mismatchOf(GetParam());
  std::cout << "rates " << found.rates << ", accelerations " << found.accelerations << ", a_ii " << found.a_ii
            << ", T rate " << found.T_rate << ", twists " << found.twists << ", twist rates " << found.twist_rates
            << ", shaping rate " << found.shaping_rate << '\n';
  EXPECT_LE(found.rates, difference_tolerance);
  EXPECT_LE(found.accelerations, difference_tolerance);
  EXPECT_LE(found.a_ii, difference_tolerance);
  EXPECT_LE(found.T_rate, difference_tolerance);
  EXPECT_LE(found.twists, difference_tolerance);
  EXPECT_LE(found.twist_rates, difference_tolerance);
  EXPECT_LE(found.shaping_rate, difference_tolerance);
}

TEST_P(Kinematics, jacobiansMapJointRatesToTwists) {
  const Mismatch found = mismatchOf(GetParam());
  EXPECT_LE(found.t_P, identity_tolerance);
  EXPECT_LE(found.t_P_rate, identity_tolerance);
  EXPECT_LE(found.shaped_twists, identity_tolerance);
  EXPECT_LE(found.shaped_rates, identity_tolerance);
}

INSTANTIATE_TEST_SUITE_P(Machines, Kinematics, testing::Values("paper-helix", "random-2", "random-5"),
                         [](const auto& name) { return "of_" + std::string(1, name.param.back()); });

/// Control: each formula as printed in our source, or without a term, shows at its own level.
struct WrongFormula {
  FormulaError formula_error;
  double Mismatch::*seen;
};

void PrintTo(const WrongFormula& wrong, std::ostream* out) {
  *out << "error " << static_cast<int>(wrong.formula_error);
}

class WrongKinematics : public testing::TestWithParam<WrongFormula> {};

TEST_P(WrongKinematics, isSeen) {
  const Mismatch found = mismatchOf("random-2", WithFormulaErrors(GetParam().formula_error));
  std::cout << found.*GetParam().seen << '\n';
  EXPECT_GT(found.*GetParam().seen, 1e12 * difference_tolerance);
}

INSTANTIATE_TEST_SUITE_P(AsPrinted, WrongKinematics,
                         testing::Values(WrongFormula{FormulaError::eq15a, &Mismatch::rates},                   //
                                         WrongFormula{FormulaError::eq14b, &Mismatch::rates},                   //
                                         WrongFormula{FormulaError::eq4c, &Mismatch::accelerations},            //
                                         WrongFormula{FormulaError::eq19a, &Mismatch::accelerations},           //
                                         WrongFormula{FormulaError::eq19b, &Mismatch::accelerations},           //
                                         WrongFormula{FormulaError::eq23, &Mismatch::t_P},                      //
                                         WrongFormula{FormulaError::eq26_a_dot, &Mismatch::a_ii},               //
                                         WrongFormula{FormulaError::eq26_b_dot, &Mismatch::T_rate},             //
                                         WrongFormula{FormulaError::eq16, &Mismatch::twists},                   //
                                         WrongFormula{FormulaError::eq17, &Mismatch::twist_rates},              //
                                         WrongFormula{FormulaError::eq43b_omega_dot, &Mismatch::twist_rates},   //
                                         WrongFormula{FormulaError::eq43b_sigma, &Mismatch::twist_rates},       //
                                         WrongFormula{FormulaError::eq43b_doubled, &Mismatch::twist_rates},     //
                                         WrongFormula{FormulaError::drop_centrifugal, &Mismatch::twist_rates},  //
                                         WrongFormula{FormulaError::drop_coriolis, &Mismatch::twist_rates},     //
                                         WrongFormula{FormulaError::drop_link_coupling, &Mismatch::twists},     //
                                         WrongFormula{FormulaError::eq47, &Mismatch::shaped_twists}));

}  // namespace
}  // namespace ursula

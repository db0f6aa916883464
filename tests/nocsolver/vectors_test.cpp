// Compares the solver with tests/vectors, which come from positions alone: no rate formula of the paper made them.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iostream>

#include "base/real50.h"
#include "model/load.h"
#include "nocsolver/noc/noc.h"
#include "parts/wrong_formulas/wrong_noc.h"
#include "tests/nocsolver/rounding.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

/// The promised accuracy of every quantity, relative in the norm over the legs.
constexpr double promised = 1e-12;

/// The largest ‖found − expected‖/‖expected‖ of every kind of quantity; a NaN is kept.
struct Errors {
  double efforts = 0, coordinates = 0, rates = 0, accelerations = 0, motion = 0;

  double worst() const { return std::max({efforts, coordinates, rates, accelerations, motion}); }
};

/// Where nothing is expected, the found norm counts.
template <class V>
void widen(double& worst, const V& found, const Vector6<Real50>& expected) {
  const Vector6<Real50> difference = found.template cast<Real50>() - expected;
  const Real50 size = expected.norm();
  const double error = static_cast<double>(Real50(size > 0 ? Real50(difference.norm() / size) : difference.norm()));
  worst = error <= worst ? worst : error;
}

template <class S>
void widen(double& worst, const JointVariables<S>& found, const JointVariables<Real50>& expected) {
  for (const Coordinate q : {Coordinate::phi, Coordinate::psi, Coordinate::theta, Coordinate::d})
    widen(worst, found.of(q), expected.of(q));
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

template <class S>
Vector6<S> loadOf(const Load* load, const Motion<S>& motion) {
  if (load == nullptr) return Vector6<S>::Zero();
  const Matrix3<S> to_base = load->frame == Load::Frame::platform ? motion.Q : Matrix3<S>(Matrix3<S>::Identity());
  const Vector3<S> force = to_base * load->force.cast<S>();
  Vector6<S> out;
  out << to_base * load->moment.cast<S>() + (motion.Q * load->point.cast<S>()).cross(force), force;
  return out;
}

template <class S>
Errors errorsAt(const Noc<S>& solver, const Load* load, const Motion<S>& motion, const VectorRow& row, Errors errors) {
  NocWorkspace<S> work;
  widen(errors.efforts, solver.inverseDynamics(motion, work, loadOf(load, motion)), row.torques);
  widen(errors.coordinates, solver.angles(work), row.q);
  widen(errors.rates, solver.rates(work), row.q_dot);
  widen(errors.accelerations, solver.accelerations(work), row.q_ddot);
  return errors;
}

void print(const std::string& what, const Errors& errors) {
  std::cout << what << ": efforts " << errors.efforts << ", coordinates " << errors.coordinates << ", rates "
            << errors.rates << ", accelerations " << errors.accelerations << ", motion " << errors.motion << '\n';
}

class Vectors : public testing::TestWithParam<std::string> {
 protected:
  Scenario scenario_ = vectorScenario(GetParam());
  const Load* load_ = scenario_.load.get();
  std::vector<VectorRow> rows_ = vectorRows(GetParam());
};

TEST_P(Vectors, inDoublesFromTheirMotion) {
  const Noc<double> solver(*scenario_.manipulator);
  Errors errors;
  for (const VectorRow& row : rows_) errors = errorsAt(solver, load_, rounded(row.motion), row, errors);
  print("doubles, their motion", errors);
  EXPECT_LE(errors.worst(), promised);
}

TEST_P(Vectors, inDoublesFromTheTrajectory) {
  const Noc<double> solver(*scenario_.manipulator);
  Errors errors;
  for (const VectorRow& row : rows_) {
    const Motion<double> motion = scenario_.trajectory->at(static_cast<double>(row.motion.t));
    widenMotion(errors.motion, motion, row.motion);
    errors = errorsAt(solver, load_, motion, row, errors);
  }
  print("doubles, trajectory", errors);
  EXPECT_LE(errors.worst(), promised);
}

/// All numbers of the `kind-` machines are doubles, so only the vectors' 25th digit remains. Reading rounded the
/// others' (0.3420 is no double). That is half an ulp of each of the 32 numbers of a leg, the platform and the motion
/// in a torque, times the conditioning.
TEST_P(Vectors, inFiftyDigits) {
  const Noc<Real50> solver(*scenario_.manipulator);
  NocWorkspace<Real50> work;
  Errors errors;
  double condition = 0;
  for (const VectorRow& row : rows_) {
    const Motion<Real50> motion = scenario_.trajectory->at(row.motion.t);
    widenMotion(errors.motion, motion, row.motion);
    errors = errorsAt(solver, load_, motion, row, errorsAt(solver, load_, row.motion, row, errors));
    solver.inverseDynamics(motion, work);
    condition = std::max(condition, static_cast<double>(conditionNumber(solver, work)));
  }
  print("50 digits", errors);
  EXPECT_LE(errors.worst(), GetParam().rfind("kind-", 0) == 0 ? 1e-20 : 32 * 0x1p-53 * condition);
}

/// Controls: another instant's motion, another mass, and wrong formulas, each in the quantity that it enters first.
TEST_P(Vectors, areMissedByAWrongMotionAndAWrongMachine) {
  const Noc<double> solver(*scenario_.manipulator);
  const Errors other = errorsAt(solver, load_, rounded(rows_[1].motion), rows_[2], {});
  EXPECT_GT(std::min({other.efforts, other.coordinates, other.rates, other.accelerations}), 1e-6);
  ManipulatorParameters machine = scenario_.manipulator->parameters();
  machine.legs[1].distal.mass *= 1 + 1e-6;
  const Noc<double> heavier{Manipulator(machine)};
  EXPECT_GT(errorsAt(heavier, load_, rounded(rows_[3].motion), rows_[3], {}).efforts, 1e-9);
}

struct WrongFormula {
  FormulaError error;
  double Errors::*seen;
};

class WrongVectors : public testing::TestWithParam<std::string> {};

TEST_P(WrongVectors, areMissed) {
  const Scenario scenario = vectorScenario(GetParam());
  const VectorRow row = vectorRows(GetParam())[2];
  std::vector<WrongFormula> all = {{FormulaError::eq14b, &Errors::coordinates},
                                   {FormulaError::eq15a, &Errors::rates},
                                   {FormulaError::eq19b, &Errors::accelerations}};
  for (const FormulaError error :
       {FormulaError::eq16, FormulaError::eq17, FormulaError::eq23, FormulaError::eq43b_doubled, FormulaError::eq47,
        FormulaError::drop_gyroscopic_legs, FormulaError::drop_platform_centripetal, FormulaError::drop_gravity_legs,
        FormulaError::drop_gravity_platform, FormulaError::drop_link_coupling, FormulaError::drop_friction})
    all.push_back({error, &Errors::efforts});
  if (scenario.manipulator->leg(0).friction.phi == 0) all.pop_back();
  for (const WrongFormula& wrong : all) {
    const WrongNoc<double> solver(*scenario.manipulator, WithFormulaErrors(wrong.error));
    EXPECT_GT(errorsAt(solver, nullptr, rounded(row.motion), row, {}).*wrong.seen, 1e6 * promised)
        << "error " << static_cast<int>(wrong.error);
  }
}

INSTANTIATE_TEST_SUITE_P(All, WrongVectors, testing::ValuesIn(vectorNames()), byName);

INSTANTIATE_TEST_SUITE_P(All, Vectors, testing::ValuesIn(allNames()), byName);

}  // namespace
}  // namespace ursula

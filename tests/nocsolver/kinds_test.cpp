// Compares legs of all kinds with tests/vectors/kind-*, which come from positions alone in 100 digits.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <iostream>

#include "base/real50.h"
#include "model/load.h"
#include "nocsolver/fast/fast_dynamics.h"
#include "nocsolver/noc/noc.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

constexpr double promised = 1e-12;

/// ‖found − expected‖/‖expected‖ over the legs, 0 if both are zero; a NaN is kept.
template <class V>
void widen(double& worst, const V& found, const Vector6<Real50>& expected) {
  const Vector6<Real50> difference = found.template cast<Real50>() - expected;
  const Real50 size = expected.norm();
  const double error = static_cast<double>(Real50(size > 0 ? Real50(difference.norm() / size) : difference.norm()));
  worst = error <= worst ? worst : error;
}

struct Errors {
  double efforts = 0, angles = 0, rates = 0, accelerations = 0;
  double worst() const { return std::max({efforts, angles, rates, accelerations}); }
};

template <class S>
void widen(double& worst, const JointVariables<S>& found, const JointVariables<Real50>& expected) {
  for (const Coordinate q : {Coordinate::phi, Coordinate::psi, Coordinate::theta, Coordinate::d})
    widen(worst, found.of(q), expected.of(q));
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
  widen(errors.angles, solver.angles(work), row.q);
  widen(errors.rates, solver.rates(work), row.q_dot);
  widen(errors.accelerations, solver.accelerations(work), row.q_ddot);
  return errors;
}

void print(const std::string& what, const Errors& errors) {
  std::cout << what << ": efforts " << errors.efforts << ", coordinates " << errors.angles << ", rates " << errors.rates
            << ", accelerations " << errors.accelerations << '\n';
}

class Kinds : public testing::TestWithParam<std::string> {
 protected:
  Scenario scenario_ = vectorScenario(GetParam());
  std::vector<VectorRow> rows_ = vectorRows(GetParam());
};

/// D T = 0 with neither of them zero, and D t = 0: T is the complement of the joints' constraints.
TEST_P(Kinds, shapingIsTheComplementOfTheConstraints) {
  const Noc<double> solver(*scenario_.manipulator);
  NocWorkspace<double> work;

  for (const VectorRow& row : rows_) {
    const Motion<double> motion = rounded(row.motion);
    solver.inverseDynamics(motion, work);
    const TwistShaping<double>& T = work.T;
    Eigen::MatrixXd D = solver.D(motion, work);
    const auto violation = [&] { return (D * T).norm() / (D.norm() * T.norm()); };
    EXPECT_LE(violation(), 1e-13);
    EXPECT_GT(T.colwise().norm().minCoeff(), 1e-3);
    EXPECT_EQ(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(D).rank(), 12 * solver.machine().legs_in_all);
    EXPECT_EQ(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(T).rank(), motor_count);
    for (Eigen::Index k = 0; k < D.rows(); ++k) {  // control: no row is satisfied by chance
      const Eigen::VectorXd row_k = D.row(k);
      D.row(k).setConstant(0.5);
      ASSERT_GT(violation(), 1e-6) << "row " << k;
      D.row(k) = row_k;
    }
  }
}

TEST_P(Kinds, inDoubles) {
  const Noc<double> solver(*scenario_.manipulator);
  Errors errors;
  for (const VectorRow& row : rows_) errors = errorsAt(solver, scenario_.load.get(), rounded(row.motion), row, errors);
  print("doubles", errors);
  EXPECT_LE(errors.worst(), promised);
}

/// All numbers of these machines are doubles, so only rounding in the vectors' 25th digit remains.
TEST_P(Kinds, inFiftyDigits) {
  const Noc<Real50> solver(*scenario_.manipulator);
  Errors errors;
  for (const VectorRow& row : rows_) errors = errorsAt(solver, scenario_.load.get(), row.motion, row, errors);
  print("50 digits", errors);
  EXPECT_LE(errors.worst(), 1e-22);
}

TEST_P(Kinds, theTrajectoryIsTheVectors) {
  for (const VectorRow& row : rows_) {
    const Motion<Real50> motion = scenario_.trajectory->at(row.motion.t);
    EXPECT_LE(static_cast<double>(Real50((motion.p_ddot - row.motion.p_ddot).norm())), 1e-20);
    EXPECT_LE(static_cast<double>(Real50((motion.omega_dot - row.motion.omega_dot).norm())), 1e-20);
  }
}

/// Direct dynamics undoes inverse dynamics.
TEST_P(Kinds, directDynamicsGivesTheMotionBack) {
  const Noc<Real50> solver(*scenario_.manipulator);
  NocWorkspace<Real50> work;
  for (const VectorRow& row : rows_) {
    const auto load = loadOf(scenario_.load.get(), row.motion);
    const Vector6<Real50> found = solver.directDynamics(row.motion, row.torques, work, load);
    Vector6<Real50> expected;
    expected << row.motion.omega_dot, row.motion.p_ddot;
    EXPECT_LE(static_cast<double>(Real50((found - expected).norm() / expected.norm())), 1e-20);
    Vector6<Real50> other = row.torques;
    other(3) *= Real50("1.000001");
    EXPECT_GT(static_cast<double>((solver.directDynamics(row.motion, other, work, load) - expected).norm()), 1e-12);
  }
}

/// Compares T, Ṫ and the twist-shaping matrix with the motion.
TEST_P(Kinds, theJacobiansGiveTwistAndTwistRate) {
  const Noc<Real50> solver(*scenario_.manipulator);
  NocWorkspace<Real50> work;
  for (const VectorRow& row : rows_) {
    solver.inverseKinematics(row.motion, work);
    solver.jacobians(row.motion, work);
    const Motors& motors = scenario_.manipulator->motors();
    const Vector6<Real50> rate = row.q_dot.driven(motors), acceleration = row.q_ddot.driven(motors);
    Vector6<Real50> twist, twist_rate;
    twist << row.motion.omega, row.motion.p_dot;
    twist_rate << row.motion.omega_dot, row.motion.p_ddot;
    const Matrix6<Real50> T = solver.platformShaping(work), T_rate = solver.platformShapingRate(row.motion, work);
    ASSERT_GT(twist.norm(), 0);
    EXPECT_LE(static_cast<double>(Real50((T * rate - twist).norm())), 1e-20);
    EXPECT_LE(static_cast<double>(Real50((T * acceleration + T_rate * rate - twist_rate).norm())), 1e-19);
    BodyMotions<Real50> bodies;
    solver.twistShapingRate(row.motion, work);
    solver.bodyMotions(row.motion, work, bodies);
    for (int b = 0; b < body_count; ++b) {  // (32a), (32b)
      const BodyMotion<Real50>& body = bodies[static_cast<std::size_t>(b)];
      const auto T_b = work.T.middleRows<6>(6 * b), T_b_rate = work.T_rate.middleRows<6>(6 * b);
      EXPECT_LE(static_cast<double>(Real50((T_b * rate - body.twist).norm())), 1e-20);
      EXPECT_LE(static_cast<double>(Real50((T_b * acceleration + T_b_rate * rate - body.twist_rate).norm())), 1e-19);
    }
  }
}

/// (34), (36) and w^N of (31) in 50 digits. I follows from the platform's mass matrix. I q̈ + C q̇ is inverse dynamics
/// without gravity, friction and load. The constraint wrenches do no work.
TEST_P(Kinds, generalisedInertiaAndWrenchesAreThoseOfTheMotion) {
  const Noc<Real50> solver(*scenario_.manipulator);
  ManipulatorParameters bare = scenario_.manipulator->parameters();
  bare.gravity.setZero();
  for (Leg& leg : bare.legs)
    leg.friction = {}, leg.coulomb.phi = leg.coulomb.psi = leg.coulomb.theta = leg.coulomb.d = 0;
  const Noc<Real50> without{Manipulator(bare)};
  NocWorkspace<Real50> work, other;
  const auto near = [](const auto& a, const auto& b, double room) {
    return static_cast<double>(Real50((a - b).norm())) <= room * static_cast<double>(Real50(b.norm()));
  };
  for (const VectorRow& row : rows_) {
    const Vector6<Real50> load = loadOf(scenario_.load.get(), row.motion);
    const Vector6<Real50> efforts = solver.inverseDynamics(row.motion, work, load);
    const Motors& motors = scenario_.manipulator->motors();
    const Vector6<Real50> rate = solver.rates(work).driven(motors),
                          acceleration = solver.accelerations(work).driven(motors);
    const Matrix6<Real50> T_P = solver.platformShaping(work), M_P = solver.massMatrixAtP(row.motion, work);
    solver.twistShapingRate(row.motion, work);
    const Matrix6<Real50> I = solver.I(work), C = solver.C(work);
    EXPECT_TRUE(near(I, Matrix6<Real50>(T_P.transpose() * M_P * T_P), 1e-40));
    EXPECT_TRUE(near(Vector6<Real50>(I * acceleration + C * rate), without.inverseDynamics(row.motion, other), 1e-35));
    EXPECT_FALSE(near(Vector6<Real50>(I * acceleration), without.inverseDynamics(row.motion, other), 1e-9));
    const BodyVector<Real50> w_N = solver.constraintWrench(row.motion, efforts, work, load);
    const Real50 power = (work.T.transpose() * w_N).norm();
    ASSERT_GT(w_N.norm(), 0);
    EXPECT_LE(static_cast<double>(power), 1e-38 * static_cast<double>(Real50(w_N.norm() * work.T.norm())));
  }
}

/// Each wrong term of section 3 shows in efforts, accelerations or D T, if the machine has the term.
TEST_P(Kinds, eachWrongTermOfSectionThreeShows) {
  const Motion<double> motion = rounded(rows_[2].motion);
  const Vector6d load = 100 * Vector6d::Ones();
  NocWorkspace<double> work;
  const auto answers = [&](const FormulaError* formula_error) {
    const Noc<double, WithFormulaErrors> solver(
        *scenario_.manipulator, formula_error != nullptr ? WithFormulaErrors(*formula_error) : WithFormulaErrors());
    Eigen::VectorXd out(24);
    const Vector6d efforts = solver.inverseDynamics(motion, work, load);
    const Eigen::MatrixXd DT = solver.D(motion, work) * work.T;
    out << efforts, solver.directDynamics(motion, Vector6d::Zero(), work, load),
        Vector6d::Constant(DT.norm() / work.T.norm()), solver.platformShapingRate(motion, work).rowwise().sum();
    return out;
  };
  const Eigen::VectorXd right = answers(nullptr);
  for (const FormulaError formula_error : {FormulaError::drop_row_rates,
                                           FormulaError::drop_own_column,
                                           FormulaError::drop_passive_rates,
                                           FormulaError::untwisted_tensors,
                                           FormulaError::untwisted_platform,
                                           FormulaError::mass_for_inertia,
                                           FormulaError::drop_mass_distal,
                                           FormulaError::drop_T_rate,
                                           FormulaError::drop_W,
                                           FormulaError::drop_tau_g,
                                           FormulaError::drop_inertia,
                                           FormulaError::drop_load,
                                           FormulaError::scaled_first_effort,
                                           FormulaError::scaled_efforts,
                                           FormulaError::wrong_D,
                                           FormulaError::drop_gyroscopic_legs,
                                           FormulaError::drop_gyroscopic_platform,
                                           FormulaError::drop_gravity_legs,
                                           FormulaError::drop_gravity_platform,
                                           FormulaError::eq47})
    EXPECT_GT((answers(&formula_error) - right).norm(), 1e-9) << static_cast<int>(formula_error);
}

/// Doubles differ from long doubles by rounding, but are not equal to the last bit.
TEST_P(Kinds, roundInDoubles) {
  const Noc<double> solver(*scenario_.manipulator);
  const Noc<long double> longer(*scenario_.manipulator);
  NocWorkspace<double> work;
  NocWorkspace<long double> long_work;
  double largest = 0;
  for (const VectorRow& row : rows_) {
    const Motion<double> m = rounded(row.motion);
    const auto cast = [](const auto& x) { return x.template cast<long double>().eval(); };
    const Motion<long double> same{m.t,           cast(m.p),         cast(m.Q),     cast(m.omega),
                                   cast(m.p_dot), cast(m.omega_dot), cast(m.p_ddot)};
    const Vector6d found = solver.inverseDynamics(m, work),
                   exact = longer.inverseDynamics(same, long_work).cast<double>();
    largest = std::max(largest, (found - exact).norm() / exact.norm());
  }
  EXPECT_GT(largest, 0);
  EXPECT_LE(largest, promised);
}

/// Controls.
TEST_P(Kinds, aWrongMachineIsMissed) {
  ManipulatorParameters machine = scenario_.manipulator->parameters();
  machine.legs[1].distal.mass *= 1 + 1e-6;
  const Noc<double> heavier{Manipulator(machine)};
  EXPECT_GT(errorsAt(heavier, scenario_.load.get(), rounded(rows_[3].motion), rows_[3], {}).efforts, 1e-9);
  const Noc<double> solver(*scenario_.manipulator);
  const Errors other = errorsAt(solver, scenario_.load.get(), rounded(rows_[1].motion), rows_[2], {});
  EXPECT_GT(std::min({other.efforts, other.angles, other.rates, other.accelerations}), 1e-6);
}

std::string testName(const testing::TestParamInfo<std::string>& name) {
  std::string out = name.param;
  std::replace(out.begin(), out.end(), '-', '_');
  return out;
}

INSTANTIATE_TEST_SUITE_P(All, Kinds, testing::ValuesIn(kindNames()), testName);

}  // namespace
}  // namespace ursula

// Identities between the solver's results, on legs of all kinds. That these are those of the machine is shown against
// tests/vectors by vectors_test.cpp.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include "base/real50.h"
#include "nocsolver/noc/noc.h"
#include "parts/wrong_formulas/wrong_noc.h"
#include "tests/support/numbers.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

class Dynamics : public testing::TestWithParam<std::string> {
 protected:
  Scenario scenario_ = vectorScenario(GetParam());
  std::vector<VectorRow> rows_ = vectorRows(GetParam());
  Vector6<Real50> load_ = Vector6<Real50>::Constant(100);
};

/// D T = 0 with neither of them zero, and D t = 0: T is the complement of the joints' constraints.
TEST_P(Dynamics, shapingIsTheComplementOfTheConstraints) {
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

/// Direct dynamics undoes inverse dynamics, and ignores accelerations in the motion.
TEST_P(Dynamics, directUndoesInverse) {
  const Noc<Real50> solver(*scenario_.manipulator);
  NocWorkspace<Real50> work;
  for (const VectorRow& row : rows_) {
    Vector6<Real50> efforts = solver.inverseDynamics(row.motion, work, load_), expected;
    expected << row.motion.omega_dot, row.motion.p_ddot;
    Motion<Real50> unread = row.motion;
    unread.omega_dot.setConstant(Real50(nan)), unread.p_ddot.setConstant(Real50(nan));
    const Vector6<Real50> found = solver.directDynamics(unread, efforts, work, load_);
    EXPECT_LE(static_cast<double>(Real50((found - expected).norm() / expected.norm())), 1e-32);
    efforts(3) *= Real50("1.000001");
    EXPECT_GT(static_cast<double>((solver.directDynamics(unread, efforts, work, load_) - expected).norm()), 1e-12);
  }
}

/// Compares T, Ṫ and the twist-shaping matrix with the motion.
TEST_P(Dynamics, theJacobiansGiveTwistAndTwistRate) {
  const Noc<Real50> solver(*scenario_.manipulator);
  NocWorkspace<Real50> work;
  for (const VectorRow& row : rows_) {
    solver.inverseKinematics(row.motion, work);
    solver.jacobians(row.motion, work);
    const Motors& motors = scenario_.manipulator->motors();
    const Vector6<Real50> rate = solver.rates(work).driven(motors),
                          acceleration = solver.accelerations(work).driven(motors);
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
TEST_P(Dynamics, generalisedInertiaAndWrenchesAreThoseOfTheMotion) {
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
    const Vector6<Real50> efforts = solver.inverseDynamics(row.motion, work, load_);
    const Motors& motors = scenario_.manipulator->motors();
    const Vector6<Real50> rate = solver.rates(work).driven(motors),
                          acceleration = solver.accelerations(work).driven(motors);
    const Matrix6<Real50> T_P = solver.platformShaping(work), M_P = solver.massMatrixAtP(row.motion, work);
    solver.twistShapingRate(row.motion, work);
    const Matrix6<Real50> I = solver.I(work), C = solver.C(work);
    EXPECT_TRUE(near(I, Matrix6<Real50>(T_P.transpose() * M_P * T_P), 1e-40));
    EXPECT_GT(Matrix6d(M_P.cast<double>()).ldlt().vectorD().minCoeff(), 0);
    EXPECT_TRUE(near(Vector6<Real50>(I * acceleration + C * rate), without.inverseDynamics(row.motion, other), 1e-35));
    EXPECT_FALSE(near(Vector6<Real50>(I * acceleration), without.inverseDynamics(row.motion, other), 1e-9));
    const BodyVector<Real50> w_N = solver.constraintWrench(row.motion, efforts, work, load_);
    const Real50 power = (work.T.transpose() * w_N).norm();
    ASSERT_GT(w_N.norm(), 0);
    EXPECT_LE(static_cast<double>(power), 1e-38 * static_cast<double>(Real50(w_N.norm() * work.T.norm())));
  }
}

/// Each wrong term of section 3 shows in efforts, accelerations or D T, if the machine has the term.
TEST_P(Dynamics, eachWrongTermOfSectionThreeShows) {
  const Motion<double> motion = rounded(rows_[2].motion);
  const Vector6d load = load_.cast<double>();
  NocWorkspace<double> work;
  const auto answers = [&](const FormulaError* formula_error) {
    const WrongNoc<double> solver(*scenario_.manipulator,
                                  formula_error != nullptr ? WithFormulaErrors(*formula_error) : WithFormulaErrors());
    Eigen::VectorXd out(24);
    const Vector6d efforts = solver.inverseDynamics(motion, work, load);
    const Eigen::MatrixXd DT = solver.D(motion, work) * work.T;
    out << efforts, solver.directDynamics(motion, Vector6d::Zero(), work, load),
        Vector6d::Constant(DT.norm() / work.T.norm()), solver.platformShapingRate(motion, work).rowwise().sum();
    return out;
  };
  const Eigen::VectorXd right = answers(nullptr);
  const Matrix3d& inertia = scenario_.manipulator->platform().inertia;
  const bool is_round = inertia.isApprox(inertia(0, 0) * Matrix3d::Identity());  // the paper's is
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
                                           FormulaError::eq47}) {
    const bool of_platforms_axes =
        formula_error == FormulaError::untwisted_platform || formula_error == FormulaError::drop_gyroscopic_platform;
    if (of_platforms_axes && is_round) continue;
    EXPECT_GT((answers(&formula_error) - right).norm(), 1e-9) << static_cast<int>(formula_error);
  }
}

/// Doubles differ from long doubles by rounding, but are not equal to the last bit.
TEST_P(Dynamics, roundInDoubles) {
  const Noc<double> solver(*scenario_.manipulator);
  const Noc<long double> longer(*scenario_.manipulator);
  NocWorkspace<double> work;
  NocWorkspace<long double> long_work;
  double largest = 0;
  for (const VectorRow& row : rows_) {
    const Motion<double> m = rounded(row.motion);
    const Vector6d found = solver.inverseDynamics(m, work),
                   exact = longer.inverseDynamics(castTo<long double>(m), long_work).cast<double>();
    largest = std::max(largest, (found - exact).norm() / exact.norm());
  }
  EXPECT_GT(largest, 0);
  EXPECT_LE(largest, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(All, Dynamics, testing::ValuesIn(allNames()), byName);

}  // namespace
}  // namespace ursula

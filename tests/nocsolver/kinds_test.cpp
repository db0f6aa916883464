// Legs of all kinds against tests/vectors/kind-*, made from positions alone in 100 digits, and against the paper's own
// road where that can be asked.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <iostream>

#include "model/load.h"
#include "model/real50.h"
#include "nocsolver/chain_constraints.h"
#include "nocsolver/solver.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

constexpr double promised = 1e-12;

/// ‖found − expected‖/‖expected‖ over the legs, 0 where both are zero; a NaN stays.
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
Errors errorsAt(const ChainSolver<S>& solver, const Load* load, const Motion<S>& motion, const VectorRow& row,
                Errors errors) {
  ChainWorkspace<S> work;
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

/// D T = 0 with neither of them zero, and D t = 0: T is the complement of what the joints allow.
TEST_P(Kinds, shapingIsTheComplementOfTheConstraints) {
  const ChainSolver<double> solver(*scenario_.manipulator);
  ChainWorkspace<double> work;

  for (const VectorRow& row : rows_) {
    const Motion<double> motion = rounded(row.motion);
    solver.inverseKinematics(motion, work);
    solver.jacobians(motion, work);
    Eigen::Matrix<double, 6 * body_count, motor_count> T;
    solver.twistShaping(motion, work, T);
    Eigen::MatrixXd D = velocityConstraints(solver, motion, work);
    const auto violation = [&] { return (D * T).norm() / (D.norm() * T.norm()); };
    EXPECT_LE(violation(), 1e-13);
    EXPECT_GT(T.colwise().norm().minCoeff(), 1e-3);
    EXPECT_EQ(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(D).rank(), 12 * solver.legCount());
    for (Eigen::Index k = 0; k < D.rows(); ++k) {  // control: no row is met by chance
      const Eigen::VectorXd row_k = D.row(k);
      D.row(k).setConstant(0.5);
      ASSERT_GT(violation(), 1e-6) << "row " << k;
      D.row(k) = row_k;
    }
  }
}

TEST_P(Kinds, inDoubles) {
  const ChainSolver<double> solver(*scenario_.manipulator);
  Errors errors;
  for (const VectorRow& row : rows_) errors = errorsAt(solver, scenario_.load.get(), rounded(row.motion), row, errors);
  print("doubles", errors);
  EXPECT_LE(errors.worst(), promised);
}

/// All numbers of these machines are doubles: nothing but the vectors' 25th digit is left.
TEST_P(Kinds, inFiftyDigits) {
  const ChainSolver<Real50> solver(*scenario_.manipulator);
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

/// What the efforts do is the motion: direct dynamics undoes inverse dynamics.
TEST_P(Kinds, directDynamicsGivesTheMotionBack) {
  const ChainSolver<Real50> solver(*scenario_.manipulator);
  ChainWorkspace<Real50> work;
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

/// T, Ṫ and the twist-shaping matrix against the motion.
TEST_P(Kinds, theJacobiansGiveTwistAndTwistRate) {
  const ChainSolver<Real50> solver(*scenario_.manipulator);
  ChainWorkspace<Real50> work;
  for (const VectorRow& row : rows_) {
    solver.inverseKinematics(row.motion, work);
    solver.jacobians(row.motion, work);
    const Motors& motors = scenario_.manipulator->motors();
    const Vector6<Real50> rate = row.q_dot.driven(motors), acceleration = row.q_ddot.driven(motors);
    Vector6<Real50> twist, twist_rate;
    twist << row.motion.omega, row.motion.p_dot;
    twist_rate << row.motion.omega_dot, row.motion.p_ddot;
    const Matrix6<Real50> T = solver.T(work), T_rate = solver.TRate(row.motion, work);
    ASSERT_GT(twist.norm(), 0);
    EXPECT_LE(static_cast<double>(Real50((T * rate - twist).norm())), 1e-20);
    EXPECT_LE(static_cast<double>(Real50((T * acceleration + T_rate * rate - twist_rate).norm())), 1e-19);
    Eigen::Matrix<Real50, 6 * body_count, motor_count> shaping;
    BodyMotions<Real50> bodies;
    solver.twistShaping(row.motion, work, shaping);
    solver.bodyMotions(row.motion, work, bodies);
    for (int b = 0; b < body_count; ++b)
      EXPECT_LE(static_cast<double>(
                    Real50((shaping.block<6, 6>(6 * b, 0) * rate - bodies[static_cast<std::size_t>(b)].twist).norm())),
                1e-20);
  }
}

/// Controls.
TEST_P(Kinds, aWrongMachineIsMissed) {
  ManipulatorParameters machine = scenario_.manipulator->parameters();
  machine.legs[1].distal.mass *= 1 + 1e-6;
  const ChainSolver<double> heavier{Manipulator(machine)};
  EXPECT_GT(errorsAt(heavier, scenario_.load.get(), rounded(rows_[3].motion), rows_[3], {}).efforts, 1e-9);
  const ChainSolver<double> solver(*scenario_.manipulator);
  const Errors other = errorsAt(solver, scenario_.load.get(), rounded(rows_[1].motion), rows_[2], {});
  EXPECT_GT(std::min({other.efforts, other.angles, other.rates, other.accelerations}), 1e-6);
}

std::string testName(const testing::TestParamInfo<std::string>& name) {
  std::string out = name.param;
  std::replace(out.begin(), out.end(), '-', '_');
  return out;
}

INSTANTIATE_TEST_SUITE_P(All, Kinds, testing::ValuesIn(kindNames()), testName);

/// The paper's machine on the general road.
class PaperOnChains : public testing::TestWithParam<std::string> {};

TEST_P(PaperOnChains, givesWhatThePaperGives) {
  const Scenario scenario = vectorScenario(GetParam());
  ASSERT_TRUE(scenario.manipulator->isOfThePaper());
  const PaperSolver<Real50> paper(*scenario.manipulator);
  const ChainSolver<Real50> chains(*scenario.manipulator);
  PaperWorkspace<Real50> paper_work;
  ChainWorkspace<Real50> work;
  double worst = 0;
  for (const VectorRow& row : vectorRows(GetParam())) {
    const Vector6<Real50> torques = paper.inverseDynamics(row.motion, paper_work);
    widen(worst, chains.inverseDynamics(row.motion, work), torques);
    widen(worst, chains.rates(work), paper.rates(paper_work));
    widen(worst, chains.accelerations(work), paper.accelerations(paper_work));
    const Matrix6<Real50> T = chains.T(work) - paper.T(paper_work);
    const Matrix6<Real50> T_rate = chains.TRate(row.motion, work) - paper.TRate(row.motion, paper_work);
    const Matrix6<Real50> M_P = chains.massMatrixAtP(row.motion, work) - paper.massMatrixAtP(row.motion, paper_work);
    EXPECT_LE(static_cast<double>(Real50(T.norm())), 1e-44);
    EXPECT_LE(static_cast<double>(Real50(T_rate.norm())), 1e-43);
    EXPECT_LE(static_cast<double>(Real50(M_P.norm())), 1e-41);
    TwistShaping<Real50> of_paper, of_chains;
    chains.inverseKinematics(row.motion, work);
    chains.jacobians(row.motion, work);
    paper.twistShaping(row.motion, paper_work, of_paper);
    chains.twistShaping(row.motion, work, of_chains);
    EXPECT_LE(static_cast<double>(Real50((of_paper - of_chains).norm())), 1e-43);
  }
  EXPECT_LE(worst, 1e-44);
}

INSTANTIATE_TEST_SUITE_P(All, PaperOnChains, testing::ValuesIn(vectorNames()), testName);

}  // namespace
}  // namespace ursula

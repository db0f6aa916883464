// T is the natural orthogonal complement of the joints' velocity constraints: D T = 0 (33), with D of rank 72 and T of
// rank 6, neither of them zero. The loops close. D is built from poses alone (tests/nocsolver/mechanism.h).

#include <gtest/gtest.h>

#include <Eigen/QR>

#include "nocsolver/noc/noc.h"
#include "tests/nocsolver/mechanism.h"
#include "tests/nocsolver/rounding.h"
#include "tests/support/motions.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

template <class S, class R>
struct Found {
  Found(const Manipulator& manipulator, const Motion<S>& motion, R reading) : solver(manipulator, reading) {
    solver.inverseKinematics(motion, work);
    solver.jacobians(motion, work);
    solver.bodyMotions(motion, work, bodies);
    solver.twistShaping(motion, work);
    T = work.T;
    D = constraintMatrix(manipulator, bodies);
  }
  Noc<S, R> solver;
  NocWorkspace<S> work;
  BodyMotions<S> bodies;
  TwistShaping<S> T;
  ConstraintMatrix<S> D;

  /// ‖D T‖ over the size of its cancelling terms.
  double violation() const { return (D * T).norm() / (D.norm() * T.norm()); }
};

class Constraints : public testing::TestWithParam<std::string> {
 protected:
  Scenario scenario_ = vectorScenario(GetParam());
  SeededDraws dice_{7};

  template <class R = Corrected>
  Found<double, R> found(const Motion<double>& motion, R reading = R{}) const {
    return Found<double, R>(*scenario_.manipulator, motion, reading);
  }
};

TEST_P(Constraints, areMetByEveryColumnOfT) {
  for (int k = 0; k < 10; ++k) {
    const auto at = found(randomState(scenario_, dice_));
    EXPECT_LE(at.violation(), roundingLimit(at.solver, at.work));
    EXPECT_GT(at.T.colwise().norm().minCoeff(), 0.1);
    EXPECT_GT(at.D.rowwise().norm().minCoeff(), 0.9);
  }
}

TEST_P(Constraints, leaveSixDegreesOfFreedomAndTSpansThem) {
  const auto at = found(randomState(scenario_, dice_));
  EXPECT_EQ(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(at.D).rank(), constraint_count);
  EXPECT_EQ(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(at.T).rank(), leg_count);
}

/// Column j of T turns only leg j's actuator, about −u, at unit rate.
TEST_P(Constraints, leaveTheActuatedRatesFree) {
  const auto at = found(randomState(scenario_, dice_));
  for (int i = 0; i < leg_count; ++i) {
    const Vector3d u = scenario_.manipulator->leg(i).base_axis.normalized();
    const Vector6d rates = -(u.transpose() * at.T.middleRows<3>(6 * i)).transpose();
    EXPECT_LE((rates - Vector6d::Unit(i)).norm(), roundingLimit(at.solver, at.work));
  }
}

TEST_P(Constraints, closeTheLoops) {
  for (int k = 0; k < 10; ++k) {
    const Motion<double> motion = randomState(scenario_, dice_);
    const auto at = found(motion);
    for (int i = 0; i < leg_count; ++i) {
      const Leg& leg = scenario_.manipulator->leg(i);
      const auto index = static_cast<std::size_t>(i);
      const LegJoints<double> joints = legJoints<double>(leg, at.bodies[index], at.bodies[leg_count + index]);
      const double scale = motion.p.norm() + leg.base_point.norm() + leg.platform_point.norm();
      EXPECT_LE((joints.B - motion.p - motion.Q * leg.platform_point).norm(),
                roundingLimit(at.solver, at.work) * scale);
      const double bend = joints.e.cross(joints.s).dot(joints.x);
      EXPECT_EQ(bend < 0, leg.knee == Knee::positive) << "B is on the other side of the knee";
    }
  }
}

/// Controls: with wrong formulas the constraints are violated, or the loops open.
TEST_P(Constraints, areViolatedByWrongFormulas) {
  const Motion<double> motion = randomState(scenario_, dice_);
  for (const FormulaError formula_error : {FormulaError::eq23, FormulaError::eq16, FormulaError::eq47,
                                           FormulaError::eq14b, FormulaError::drop_link_coupling})
    EXPECT_GT(found(motion, WithFormulaErrors(formula_error)).violation(), 1e-4)
        << "error " << static_cast<int>(formula_error);
}

INSTANTIATE_TEST_SUITE_P(Machines, Constraints, testing::ValuesIn(vectorNames()),
                         [](const auto& name) { return "of_" + std::string(1, name.param.back()); });

}  // namespace
}  // namespace ursula

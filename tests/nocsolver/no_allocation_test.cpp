// After a first call, no function uses the heap, for any scalar.

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "base/real50.h"
#include "nocsolver/noc/noc.h"
#include "parts/wrong_formulas/wrong_noc.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

/// Control: the counter counts allocations of operator new, malloc and Eigen.
TEST(AllocationCounter, counts) {
  EXPECT_EQ(allocationsIn([] {}), 0);
  std::unique_ptr<int> kept;
  EXPECT_GE(allocationsIn([&] { kept = std::make_unique<int>(3); }), 1);
  std::vector<double> vector;
  EXPECT_GE(allocationsIn([&] { vector.resize(100); }), 1);
  Eigen::MatrixXd matrix;
  EXPECT_GE(allocationsIn([&] { matrix = Eigen::MatrixXd::Identity(7, 7); }), 1);
  EXPECT_EQ(matrix.trace() + static_cast<double>(vector.size()) + *kept, 110);
}

template <class S>
class NoAllocation : public testing::Test {};

using Scalars = testing::Types<double, float, Real50>;
TYPED_TEST_SUITE(NoAllocation, Scalars);

TYPED_TEST(NoAllocation, inAnyFunctionOfTheSolver) {
  using S = TypeParam;
  const Scenario scenario = vectorScenario("random-4");
  const Noc<S> solver(*scenario.manipulator);
  const Motion<S> motion = castTo<S>(vectorRows("random-4")[2].motion);
  NocWorkspace<S> work;
  BodyMotions<S> bodies;
  TwistShaping<S> shaping, shaping_rate;
  JointVariables<S> q, q_dot, q_ddot;
  Vector6<S> torques, accelerations;
  Matrix6<S> T, T_rate, M_P;
  const auto evaluate = [&](const char* what, const auto& call) {
    call();
    EXPECT_EQ(allocationsIn(call), 0) << what;
  };
  evaluate("displacements", [&] { solver.displacements(motion, work); });
  evaluate("inverseKinematics", [&] { solver.inverseKinematics(motion, work); });
  evaluate("jacobians", [&] { solver.jacobians(motion, work); });
  evaluate("angles", [&] { q = solver.angles(work); });
  evaluate("rates", [&] { q_dot = solver.rates(work); });
  evaluate("accelerations", [&] { q_ddot = solver.accelerations(work); });
  evaluate("T", [&] { T = solver.platformShaping(work); });
  evaluate("TRate", [&] { T_rate = solver.platformShapingRate(motion, work); });
  evaluate("bodyMotions", [&] { solver.bodyMotions(motion, work, bodies); });
  evaluate("twistShaping", [&] { solver.twistShaping(motion, work), shaping = work.T; });
  evaluate("twistShapingRate", [&] { solver.twistShapingRate(motion, work), shaping_rate = work.T_rate; });
  evaluate("massMatrixAtP", [&] { M_P = solver.massMatrixAtP(motion, work); });
  evaluate("inverseDynamics", [&] { torques = solver.inverseDynamics(motion, work, Vector6<S>::Ones()); });
  evaluate("directDynamics", [&] { accelerations = solver.directDynamics(motion, torques, work); });
  const auto nonzero = [](const auto& m) { return static_cast<double>(S(m.norm())) > 0; };
  EXPECT_TRUE(nonzero(q.phi) && nonzero(q_dot.phi) && nonzero(q_ddot.phi) && nonzero(T) && nonzero(T_rate) &&
              nonzero(shaping) && nonzero(shaping_rate) && nonzero(M_P) && nonzero(torques) && nonzero(accelerations) &&
              nonzero(bodies[0].twist_rate));
}

TEST(NoAllocationWithFormulaErrors, either) {
  const Scenario scenario = vectorScenario("random-4");
  const WrongNoc<double> solver(*scenario.manipulator, WithFormulaErrors(FormulaError::eq15a));
  const Motion<double> motion = rounded(vectorRows("random-4")[2].motion);
  NocWorkspace<double> work;
  Vector6d torques;
  EXPECT_EQ(allocationsIn([&] { torques = solver.inverseDynamics(motion, work); }), 0);
  EXPECT_GT(torques.norm(), 0);
}

}  // namespace
}  // namespace ursula

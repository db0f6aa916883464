// The complement of machines with closed loops against references that come from positions alone: loops closed by
// Gauss-Newton in 50 digits, central differences, virtual work. They share no formula with the solver.

#include "nocsolver/loops/loop_solver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <functional>
#include <string>

#include "tests/loops/loop_scenario.h"
#include "validation/mechanism/validate_mechanism.h"

namespace ursula {
namespace {

using testing::HasSubstr;

struct Errors {
  double effort = 0, largest = 0, joint = 0, direct = 0;
  int joints = 0;
};

Errors errorsOf(const MechanismScenario& scenario, const CsvTable& table) {
  const MechanismAlong along(scenario);
  Errors out;
  LoopWork work;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double t = table.at("t_s")[i];
    const loops::VectorXd efforts = along.motion().inverseDynamics(t, work);
    for (Eigen::Index k = 0; k < efforts.size(); ++k) {
      const double expected = table.at(motorColumn(*scenario.mechanism, static_cast<std::size_t>(k), "tau"))[i];
      out.effort = std::max(out.effort, std::abs(efforts(k) - expected));
      out.largest = std::max(out.largest, std::abs(expected));
    }
    for (const LoopSolver::JointValue& joint : along.solver().joints(work))
      if (const auto* column = table.find(joint.name)) {
        out.joint = std::max(out.joint, std::abs((*column)[i] - joint.value));
        ++out.joints;
      }
    const MotorMotion motion = scenario.trajectory->at(t);
    LoopWork other;
    const loops::VectorXd found = along.solver().directDynamics(motion, efforts, work.pose, other);
    out.direct = std::max(out.direct, (found - motion.qddot).norm() / (1 + motion.qddot.norm()));
  }
  return out;
}

class LoopVectors : public testing::TestWithParam<std::string> {};

TEST_P(LoopVectors, effortsAndJointsAreTheReferences) {
  const Errors found = errorsOf(loopScenario(GetParam()), loopVectors(GetParam()));
  ASSERT_GT(found.largest, 0);
  EXPECT_LT(found.effort, 1e-12 * found.largest);
  EXPECT_LT(found.joint, 1e-12);
  EXPECT_LT(found.direct, 1e-9);
}

TEST_P(LoopVectors, aMassOffByATenthOfAPerMilleIsSeen) {
  const MechanismScenario wrong = changedScenario(loopScenario(GetParam()), [](MechanismParameters& machine) {
    for (MechanismBody& body : machine.bodies) body.mass *= 1.0001;
  });
  const Errors found = errorsOf(wrong, loopVectors(GetParam()));
  EXPECT_GT(found.effort, 1e-7 * found.largest);
}

INSTANTIATE_TEST_SUITE_P(Machines, LoopVectors,
                         testing::Values("fourbar", "planar3rrr", "ankle", "delta", "delta_balls", "hexapod_sps",
                                         "rps3", "boom_rub", "jansen", "fourbar_rub", "fourbar_relpose",
                                         "fourbar_sdfrev", "rssr", "sarrus", "klann_rub"),
                         [](const auto& machine) { return machine.param; });

TEST(LoopSolver, holdsIdleRodsAtRestAndNamesThem) {
  const MechanismScenario scenario = loopScenario("hexapod_sps");
  const MechanismAlong along(scenario);
  EXPECT_EQ(along.freedoms().freedoms, 6);
  ASSERT_EQ(along.freedoms().idle.size(), 12U) << "two bodies of each strut";
  LoopWork work;
  static_cast<void>(along.motion().inverseDynamics(0.3, work));
  double moving = 0, spin = 0;
  for (std::size_t b = 0; b < scenario.mechanism->bodies().size(); ++b) {
    const MechanismBody& body = scenario.mechanism->bodies()[b];
    if (along.freedoms().idleBody(b) == nullptr) continue;
    // The line is the axis of the moment of inertia that has no equal.
    const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(body.inertia);
    const Vector3d I = axes.eigenvalues();
    const Vector3d line = axes.eigenvectors().col(I(1) - I(0) > I(2) - I(1) ? 0 : 2);
    const Vector3d omega = work.bodies[b].twist.head<3>();
    moving = std::max(moving, omega.norm());
    spin = std::max(spin, std::abs(omega.dot(work.bodies[b].displacement.linear() * line)));
  }
  EXPECT_GT(moving, 1e-3);
  EXPECT_LT(spin, 1e-12);
}

/// The size of the terms that cancel in the first motor's effort where nothing moves but under gravity along
/// `direction`.
double sizeOfWeights(const std::function<Vector3d(const MechanismJoint&)>& direction) {
  MechanismScenario scenario = changedScenario(loopScenario("fourbar"), [&](MechanismParameters& machine) {
    machine.gravity = machine.gravity.norm() * direction(machine.joints[0]).normalized();
    for (MechanismJoint& joint : machine.joints) joint.stiffness = joint.damping = joint.friction = 0;
  });
  scenario.trajectory = makeMotorHold(1, scenario.trajectory->at(0).q);
  const MechanismAlong along(scenario);
  LoopWork work;
  static_cast<void>(along.motion().inverseDynamics(0, work));
  return along.solver().effortScale(work)(0);
}

/// Weights round in most frames, also where they are square to the motion.
TEST(LoopSolver, theWeightsOfAMachineThatLiesFlatCount) {
  const double upright = sizeOfWeights([](const MechanismJoint& joint) { return joint.axis[0].unitOrthogonal(); });
  const double flat = sizeOfWeights([](const MechanismJoint& joint) { return joint.axis[0]; });
  EXPECT_GT(upright, 1e-3);
  EXPECT_NEAR(flat / upright, 1, 1e-9);
}

class RefusedLoops : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(RefusedLoops, sayWhatIsWrong) {
  const auto& [name, words] = GetParam();
  try {
    const MechanismScenario scenario = loopScenario(std::string("refused/") + name);
    const MechanismAlong along(scenario);
    ADD_FAILURE() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr(words));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Machines, RefusedLoops,
    testing::Values(std::pair("fivebar_one_motor", "1 motor for 2 freedoms; these joints are left free: "),
                    std::pair("fourbar_two_motors", "these motors fight each other or the loops: drive, pivot"),
                    std::pair("fourbar_weld_across_hinge", "1 motor for 0 freedoms"),
                    std::pair("fourbar_out_of_reach", "the loops cannot follow the motors"),
                    std::pair("rssr_rod_unequal", "1 motor for 2 freedoms; these joints are left free: rod_ball"),
                    std::pair("hexapod_seven", "7 motors for 6 freedoms"),
                    std::pair("parallelogram_through", "the pose is singular: passive joints can move"),
                    std::pair("parallelogram_back", "the pose is singular: passive joints can move"),
                    std::pair("parallelogram_touching", "the pose is singular: passive joints can move"),
                    std::pair("parallelogram_standing", "singular: passive joints can move"),
                    std::pair("in_line", "the file's pose is singular: the loop of input, j2, j3 that 'loop'")),
    [](const auto& machine) { return std::string(machine.param.first); });

TEST(RefusedLoops, areFollowedBesideASingularPose) {
  const MechanismScenario scenario = loopScenario("refused/parallelogram_beside");
  const MechanismAlong along(scenario);
  EXPECT_FALSE(along.solver().singularLoop(along.solver().assembled()));
  LoopWork work;
  static_cast<void>(along.motion().inverseDynamics(0.5, work));
  EXPECT_LT(work.reciprocal_condition, 0.1) << "it passes close by";
}

TEST(RefusedLoops, sayTheSingularLoopAndAPoseThatIsNot) {
  const MechanismScenario scenario = loopScenario("refused/in_line");
  try {
    const LoopSolver solver(*scenario.mechanism);
    ADD_FAILURE() << "accepted";
  } catch (const LoopError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'loop' of line 5 closes"));
    EXPECT_THAT(error.what(), HasSubstr("such as with input at "));
    EXPECT_THAT(error.what(), HasSubstr("`key` of [mechanism]"));
  }
  // A little beside the line the loop closes.
  const MechanismScenario bent = changedScenario(scenario, [](MechanismParameters& machine) {
    for (MechanismJoint& joint : machine.joints)
      if (joint.closure) joint.centre_of_child.y() += 0.01;
  });
  EXPECT_NO_THROW(LoopSolver(*bent.mechanism));
}

/// Stands still, but for an instant.
class Excursion : public MotorTrajectory {
 public:
  Excursion(Eigen::VectorXd home, Eigen::VectorXd away) : home_(std::move(home)), away_(std::move(away)) {}
  std::string kind() const override { return "excursion"; }
  double duration() const override { return 1; }
  MotorMotion at(double t) const override {
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(home_.size());
    return {t, t == instant ? away_ : home_, rest, rest};
  }
  static constexpr double instant = 0.501;

 private:
  Eigen::VectorXd home_, away_;
};

TEST(LoopMotions, refuseWithTheInstantAndTheLoop) {
  const MechanismScenario scenario = loopScenario("refused/fourbar_out_of_reach");
  const LoopSolver solver(*scenario.mechanism);
  const Eigen::VectorXd home = solver.motorCoordinates(solver.assembled());
  LoopWork work;
  int refused = 0;
  for (int k = 0; k < 100; ++k) {
    const Excursion trajectory(home, scenario.trajectory->at(0.02 * k).q);
    const LoopMotion motion(solver, trajectory);
    EXPECT_NO_THROW(motion.inverseDynamics(0.5, work));
    try {
      motion.inverseDynamics(Excursion::instant, work);
    } catch (const LoopError& error) {
      ++refused;
      EXPECT_THAT(error.what(), HasSubstr(", at t = 0.501000 s"));
    }
  }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace ursula

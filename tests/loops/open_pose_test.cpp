// Machines whose file's pose is wide open: they are closed by little movement, and every engine follows from there. The
// references are those of the same machines with closed poses.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "nocsolver/loops/loop_solver.h"
#include "tests/loops/loop_scenario.h"
#include "validation/mechanism/validate_mechanism.h"

namespace ursula {
namespace {

using testing::HasSubstr;

Eigen::Isometry3d movedAlong(const MechanismJoint& joint, double by) {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  if (joint.slides()) {
    out.translation() = by * joint.axis[0];
  } else if (joint.kind == JointKind::revolute) {
    out.linear() = Eigen::AngleAxisd(by, joint.axis[0]).toRotationMatrix();
    out.translation() = joint.centre - out.linear() * joint.centre;
  }
  return out;
}

void moveParts(const std::vector<Eigen::Isometry3d>& D, MechanismParameters& machine) {
  for (std::size_t b = 0; b < machine.bodies.size(); ++b) {
    MechanismBody& body = machine.bodies[b];
    body.center_of_mass = (D[b] * body.center_of_mass).eval();
    body.inertia = (D[b].linear() * body.inertia * D[b].linear().transpose()).eval();
    body.frame = D[b] * body.frame;
  }
  for (MechanismJoint& joint : machine.joints) {
    const Eigen::Isometry3d &parent = D[joint.parent], &child = D[joint.child];
    joint.axis = {parent.linear() * joint.axis[0], child.linear() * joint.axis[1]};
    joint.centre = (parent * joint.centre).eval();
    joint.centre_of_child = joint.closure ? Vector3d(child * joint.centre_of_child) : joint.centre;
    if (joint.closure) joint.turn = (parent.linear() * joint.turn * child.linear().transpose()).eval();
  }
}

/// The same machine at another reference pose: each hinge and slide of the file's tree is moved by up to `most`.
void open(double most, MechanismParameters& machine) {
  std::vector<Eigen::Isometry3d> D(machine.bodies.size(), Eigen::Isometry3d::Identity());
  std::vector<char> placed;
  for (const MechanismBody& body : machine.bodies) placed.push_back(body.fixed ? 1 : 0);
  for (bool grown = true; grown;) {
    grown = false;
    for (std::size_t j = 0; j < machine.joints.size(); ++j) {
      MechanismJoint& joint = machine.joints[j];
      if (joint.closure || placed[joint.parent] == 0 || placed[joint.child] != 0) continue;
      const double by = freedomsOf(joint.kind) == 1 ? most * std::sin(1.7 * static_cast<double>(j + 1)) : 0;
      D[joint.child] = D[joint.parent] * movedAlong(joint, by);
      joint.position += by;
      placed[joint.child] = 1;
      grown = true;
    }
  }
  moveParts(D, machine);
}

MechanismScenario openedScenario(const std::string& name, double most) {
  MechanismScenario out =
      changedScenario(loopScenario(name), [most](MechanismParameters& machine) { open(most, machine); });
  out.simulation.samples = 31;
  return out;
}

/// The largest error of efforts against the vectors, relative to the largest effort.
double errorOf(const std::string& name, const MechanismScenario& scenario) {
  const MechanismAlong along(scenario);
  const CsvTable table = loopVectors(name);
  double worst = 0, largest = 0;
  LoopWork work;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const loops::VectorXd efforts = along.motion().inverseDynamics(table.at("t_s")[i], work);
    for (Eigen::Index k = 0; k < efforts.size(); ++k) {
      const double expected = table.at(motorColumn(*scenario.mechanism, static_cast<std::size_t>(k), "tau"))[i];
      worst = std::max(worst, std::abs(efforts(k) - expected));
      largest = std::max(largest, std::abs(expected));
    }
  }
  return worst / largest;
}

class OpenPose : public testing::TestWithParam<const char*> {};

TEST_P(OpenPose, hasTheEffortsOfTheClosedOne) {
  for (const double most : {0.05, 0.4}) {
    const MechanismScenario scenario = openedScenario(GetParam(), most);
    const LoopSolver solver(*scenario.mechanism);
    EXPECT_GT(solver.assemblyGap(), 0.1 * most) << "it tests nothing";
    EXPECT_FALSE(solver.mechanism().start().empty());
    EXPECT_LT(errorOf(GetParam(), scenario), 1e-12) << most;
  }
  const MechanismScenario heavier = changedScenario(openedScenario(GetParam(), 0.4), [](MechanismParameters& machine) {
    for (MechanismBody& body : machine.bodies) body.mass *= 1.0001;
  });
  EXPECT_GT(errorOf(GetParam(), heavier), 1e-7);
}

/// Closing by Newton's steps alone turns coordinates by many revolutions where the gap is wide.
TEST_P(OpenPose, isClosedByLittleMovement) {
  const LoopSolver solver(*openedScenario(GetParam(), 0.4).mechanism);
  EXPECT_GT(solver.assemblyMove().share, 0.01);
  EXPECT_LT(solver.assemblyMove().share, 1.2);
  EXPECT_EQ(LoopSolver(*loopScenario(GetParam()).mechanism).assemblyMove().share > 1e-3, false) << "it is closed";
}

TEST_P(OpenPose, isFollowedByEveryEngine) {
  const MechanismScenario scenario = openedScenario(GetParam(), 0.4);
  const ValidationResult result = validateMechanism(scenario);
  std::string failed;
  for (const Check& check : result.checks)
    if (check.verdict != Verdict::pass && check.verdict != Verdict::not_applicable) failed += check.name + " ";
  EXPECT_EQ(failed, "model.reading ") << "the file is not open";
  for (const char* name : {"torque.pointwise", "torque.twin", "torque.maximal", "invariance.labels"}) {
    const Check* check = findCheck(result.checks, name);
    ASSERT_NE(check, nullptr) << name;
    EXPECT_EQ(check->verdict, Verdict::pass) << name << ": " << check->why;
  }
}

INSTANTIATE_TEST_SUITE_P(Machines, OpenPose,
                         testing::Values("fourbar", "planar3rrr", "ankle", "delta", "rssr", "fourbar_relpose"),
                         [](const auto& machine) { return std::string(machine.param); });

TEST(OpenPoses, startEnginesFromAnotherAssemblyIfToldSo) {
  const MechanismScenario scenario = openedScenario("fourbar", 0.4);
  const LoopSolver solver(*scenario.mechanism);
  Mechanism given = solver.mechanism();
  EXPECT_LT(LoopSolver(given).assemblyMove().share - solver.assemblyMove().share, 1e-9) << "it keeps the start";
  given.startAt({given.bodies().size(), Eigen::Isometry3d::Identity()});
  EXPECT_GT(LoopSolver(given).assemblyGap(), 0.01);
}

TEST(OpenPoses, areSaidWhereJointsMoveMuch) {
  const std::string words = assemblyInWords(LoopSolver(*openedScenario("fourbar", 0.8).mechanism));
  EXPECT_THAT(words, HasSubstr("closing it moves "));
  EXPECT_THAT(words, HasSubstr(" rad, more than any other joint"));
  EXPECT_EQ(assemblyInWords(LoopSolver(*openedScenario("fourbar", 0.02).mechanism)), "");
}

}  // namespace
}  // namespace ursula

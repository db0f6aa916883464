// Wrong places and axes of joints are named by the joint, and nothing is named that is another mistake.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "base/errors.h"
#include "model/mechanism_numbers.h"
#include "tests/validation/loop_machine.h"

namespace ursula {
namespace {

std::size_t jointNamed(const MechanismParameters& machine, const std::string& name) {
  for (std::size_t j = 0; j < machine.joints.size(); ++j)
    if (machine.joints[j].name == name) return j;
  throw std::logic_error("no joint " + name);
}

std::size_t firstClosure(const MechanismParameters& machine) {
  for (std::size_t j = 0; j < machine.joints.size(); ++j)
    if (machine.joints[j].closure) return j;
  throw std::logic_error("no closure");
}

/// Two directions in the four-bar's plane.
Matrix3d planeOfFourbar(const MechanismParameters& machine) {
  const Vector3d normal = machine.joints[jointNamed(machine, "crank_hinge")].axis[0];
  Matrix3d out;
  out << normal.unitOrthogonal(), normal.cross(normal.unitOrthogonal()), normal;
  return out;
}

/// The crank's far end, with the coupler as it is.
void lengthenCrank(double share, MechanismParameters& of) {
  const std::size_t knee = jointNamed(of, "knee"), loop = firstClosure(of);
  const Matrix3d plane = planeOfFourbar(of);
  Vector3d by = share * (of.joints[knee].centre - of.joints[jointNamed(of, "crank_hinge")].centre);
  by -= plane.col(2) * plane.col(2).dot(by);
  MechanismBody& coupler = of.bodies[of.joints[knee].child];
  coupler.frame.translation() += by;
  coupler.center_of_mass += by;
  of.joints[knee].centre += by, of.joints[knee].centre_of_child += by;
  of.joints[loop].centre += by;
}

TEST(LoopGeometry, lengthOfALinkIsNamed) {
  const Machine machine("fourbar");
  const NamedCause result =
      named(judgeChanged(machine, [](MechanismParameters& of) { lengthenCrank(0.01, of); }), CauseKind::parameter);
  EXPECT_EQ(result.parameter, "body.crank.length");
  EXPECT_EQ(result.unit, "m");
  EXPECT_NEAR(result.found.value_or(0) / result.expected.value_or(1), 1.01, 1e-9);
}

/// In the plane, along no axis of a body: the place has no single number.
TEST(LoopGeometry, anchorOfAPlanarLoopIsNamed) {
  const Machine machine("fourbar");
  const std::size_t loop = firstClosure(machine.parameters());
  const ValidationResult result = judgeChanged(machine, [&](MechanismParameters& of) {
    of.joints[loop].centre_of_child += 1e-3 * planeOfFourbar(of) * Vector3d(0.6, -0.8, 0);
  });
  const MechanismJoint& joint = machine.mechanism().joints()[loop];
  ASSERT_TRUE(result.cause) << result.cause_words.cause;
  EXPECT_EQ(result.cause->parameter, "joint." + joint.name + ".position") << result.cause_words.cause;
  EXPECT_EQ(result.cause->joint, joint.name);
  EXPECT_EQ(result.cause->body, machine.mechanism().bodies()[joint.child].name);
}

TEST(LoopGeometry, anchorOfASpatialLoopIsNamedWithItsNumber) {
  const Machine machine("delta");
  const std::size_t loop = firstClosure(machine.parameters());
  const MechanismJoint& joint = machine.mechanism().joints()[loop];
  const Eigen::Isometry3d& frame = machine.mechanism().bodies()[joint.child].frame;
  const ValidationResult result = judgeChanged(
      machine, [&](MechanismParameters& of) { of.joints[loop].centre_of_child += 1e-3 * frame.linear().col(1); });
  ASSERT_TRUE(result.cause) << result.cause_words.cause;
  EXPECT_EQ(result.cause->parameter, "joint." + joint.name + ".position.1") << result.cause_words.cause;
  EXPECT_NEAR(result.cause->expected.value_or(0), (frame.inverse() * joint.centre_of_child)(1), 1e-12);
  EXPECT_NEAR(result.cause->found.value_or(0) - result.cause->expected.value_or(0), 1e-3, 1e-9);
}

TEST(LoopGeometry, tiltedAxisIsNamed) {
  const Machine machine("delta");
  const std::size_t motor = machine.mechanism().motors()[1];
  const ValidationResult result = judgeChanged(machine, [&](MechanismParameters& of) {
    Vector3d& axis = of.joints[motor].axis[0];
    axis = (axis + 0.01 * axis.unitOrthogonal()).normalized();
  });
  ASSERT_TRUE(result.cause) << result.cause_words.cause;
  EXPECT_EQ(result.cause->joint, machine.mechanism().joints()[motor].name);
  EXPECT_EQ(result.cause->parameter, "joint." + result.cause->joint + ".axis") << result.cause_words.cause;
}

/// Two numbers by different shares, and efforts that no machine needs.
TEST(LoopGeometry, nothingElseIsNamed) {
  const Machine machine("fourbar");
  const ValidationResult two = judgeChanged(machine, [](MechanismParameters& of) {
    lengthenCrank(0.01, of);
    of.joints[firstClosure(of)].centre_of_child += 0.002 * planeOfFourbar(of).col(0);
  });
  EXPECT_EQ(two.verdict, Verdict::fail);
  EXPECT_FALSE(two.cause) << two.cause_words.cause;
  EXPECT_TRUE(two.causes_together.empty()) << two.cause_words.cause;
  const ValidationResult wave = judgeEfforts(machine, [](std::size_t i, MotorEfforts& tau) {
    const double t = static_cast<double>(i) / 60;
    tau(0) += 0.01 * std::sin(7 * t) * std::exp(t);
  });
  EXPECT_FALSE(wave.cause) << wave.cause_words.cause;
}

/// A number that a cause names makes the wrong efforts where the scenario has it.
TEST(LoopGeometry, numbersOfCausesAreThoseOfTheScenario) {
  const Machine machine("fourbar", [](MechanismParameters& of) {
    for (MechanismJoint& joint : of.joints)
      if (joint.kind == JointKind::revolute && !joint.closure)
        joint.damping = 0.2, joint.friction = 0.3, joint.stiffness = 2, joint.spring_reference = 0.4,
        joint.rotor_inertia = 0.05;
  });
  const MechanismParameters right = machine.parameters();
  const std::string body = "body." + right.bodies.back().name + ".";
  std::set<std::string> kinds;
  for (const std::string& name : mechanismNumbers(right)) {
    if (name.rfind("body.", 0) == 0 && name.rfind(body, 0) != 0) continue;
    MechanismParameters wrong = right, pasted = right;
    const double is = mechanismNumber(right, name);
    setMechanismNumber(name, is + 0.01 * std::max(std::abs(is), 1e-2), wrong);
    const std::vector<MotorEfforts> efforts = machine.efforts(wrong);
    const ValidationResult result = machine.judge(efforts);
    if (!result.cause || result.cause->kind != CauseKind::parameter || !result.cause->found) continue;
    const std::string& key = result.cause->parameter;
    ASSERT_NO_THROW(setMechanismNumber(key, *result.cause->found, pasted)) << name << ": " << key;
    EXPECT_NEAR(mechanismNumber(right, key), *result.cause->expected, 1e-9) << key;
    const std::vector<MotorEfforts> found = machine.efforts(pasted);
    for (std::size_t i = 0; i < efforts.size(); ++i) EXPECT_LT((found[i] - efforts[i]).norm(), 1e-7) << key;
    kinds.insert(key.substr(key.rfind('.') + 1));
  }
  for (const char* kind : {"mass", "damping", "friction", "armature", "stiffness", "springref"})
    EXPECT_EQ(kinds.count(kind), 1U) << kind;
  EXPECT_EQ(mechanismNumbers(right).front(), "gravity.0");
  EXPECT_THROW(mechanismNumber(right, "mechanism.gravity.0"), InvalidParameter);
}

}  // namespace
}  // namespace ursula

// Bodies that spin freely about their own line: the reference has the same masses, welded, without axial inertia.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "simbody/simbody_mechanism.h"
#include "tests/loops/loop_scenario.h"
#include "tests/support/idle_wheels.h"
#include "validation/mechanism/validate_mechanism.h"

namespace ursula {
namespace {

using testing::HasSubstr;
using testing::UnorderedElementsAre;

MechanismScenario withWheels(const std::string& name) {
  MechanismScenario scenario = loopScenario(name);
  scenario.simulation.samples = 31;
  const std::size_t carrier = scenario.mechanism->output();
  return changedScenario(scenario, [&](MechanismParameters& machine) { addWheels(machine, carrier); });
}

/// The largest difference of the efforts, relative to the largest effort.
double apart(const MechanismScenario& a, const MechanismScenario& b) {
  const MechanismAlong along_a(a), along_b(b);
  double out = 0, largest = 0;
  LoopWork work;
  for (const double share : {0.0, 0.13, 0.37, 0.61, 0.94}) {
    const double t = share * a.trajectory->duration();
    const loops::VectorXd efforts = along_a.motion().inverseDynamics(t, work);
    out = std::max(out, (efforts - along_b.motion().inverseDynamics(t, work)).cwiseAbs().maxCoeff());
    largest = std::max(largest, efforts.cwiseAbs().maxCoeff());
  }
  return out / largest;
}

class IdleBodies : public testing::TestWithParam<const char*> {};

TEST_P(IdleBodies, areNamedAndHaveTheEffortsOfWeldedOnesWithoutAxialInertia) {
  const MechanismScenario scenario = withWheels(GetParam());
  EXPECT_THAT(MechanismAlong(scenario).freedoms().idleNames(),
              UnorderedElementsAre("wheel", "wheel_on_wheel", "other_wheel"));
  const MechanismScenario welded = changedScenario(scenario, weldWheels);
  EXPECT_LT(apart(scenario, welded), 1e-12);
  const MechanismScenario heavier = changedScenario(welded, [](MechanismParameters& machine) {
    for (MechanismBody& body : machine.bodies)
      if (body.name == "other_wheel") body.mass *= 1.001;
  });
  EXPECT_GT(apart(scenario, heavier), 1e-9);
}

TEST_P(IdleBodies, passAndWrongEffortsFail) {
  const MechanismScenario scenario = withWheels(GetParam());
  const ValidationResult result = validateMechanism(scenario);
  std::string failed;
  for (const Check& check : result.checks)
    if (check.verdict != Verdict::pass && check.verdict != Verdict::not_applicable) failed += check.name + " ";
  EXPECT_EQ(result.verdict, Verdict::pass) << failed;
  EXPECT_EQ(findCheck(result.checks, "kinematics.twists")->verdict, Verdict::pass);
  MechanismSubject wrong;
  wrong.about = {"wrong", Formulation::external};
  const MechanismScenario other = changedScenario(scenario, [](MechanismParameters& machine) {
    for (MechanismBody& body : machine.bodies)
      if (body.name == "wheel") body.mass *= 1.0001;
  });
  const MechanismAlong along(other);
  wrong.answers = [&](const std::vector<MechanismQuestion>& questions) {
    std::vector<MotorEfforts> out;
    LoopWork work;
    for (const MechanismQuestion& each : questions) out.push_back(along.motion().inverseDynamics(each.motion.t, work));
    return out;
  };
  EXPECT_EQ(validateMechanism(scenario, wrong).verdict, Verdict::fail);
}

INSTANTIATE_TEST_SUITE_P(Machines, IdleBodies, testing::Values("fourbar", "ankle", "delta"),
                         [](const auto& machine) { return std::string(machine.param); });

/// Neither the spin of a rod between two balls nor that of a wheel is compared, whatever the output body is.
TEST(IdleOutput, isComparedButForItsSpin) {
  for (const auto& [name, body] : {std::pair("rssr", "rod"), std::pair("fourbar", "wheel")}) {
    MechanismScenario scenario = std::string(body) == "rod" ? loopScenario(name) : withWheels(name);
    for (MechanismJoint& joint : scenario.read.machine.joints) joint.friction = 0;  // too stiff to replay
    scenario.mechanism = std::make_shared<Mechanism>(scenario.read.machine, body);
    const ValidationResult result = validateMechanism(scenario);
    for (const Check& each : result.checks)  // the file has friction
      EXPECT_TRUE(each.verdict != Verdict::fail || each.name == "model.reading") << name << ": " << each.name;
    const Check* check = findCheck(result.checks, "replay.orientation");
    ASSERT_NE(check, nullptr);
    EXPECT_EQ(check->verdict, Verdict::pass) << name << ": " << check->why;
  }
  const IdleBody rod{1, "rod", Vector3d::UnitZ()};
  const auto turned = [](const Vector3d& axis) { return Eigen::Isometry3d(Eigen::AngleAxisd(1e-3, axis)); };
  const Eigen::Isometry3d none = Eigen::Isometry3d::Identity();
  EXPECT_NEAR(turnBetween(turned(Vector3d::UnitX()), none, &rod), 1e-3, 1e-9);
  EXPECT_NEAR(turnBetween(turned(Vector3d::UnitZ()), none, &rod), 0, 1e-15);
  EXPECT_NEAR(turnBetween(turned(Vector3d::UnitZ()), none, nullptr), 1e-3, 1e-9);
}

TEST(IdleOutput, isNotTheDefault) {
  for (const char* name : {"fourbar", "delta"}) {
    const MechanismScenario without = loopScenario(name), with = withWheels(name);
    EXPECT_EQ(Mechanism(with.read.machine).output(), Mechanism(without.read.machine).output()) << name;
  }
  const Mechanism rssr(loopScenario("rssr").read.machine);
  EXPECT_NE(rssr.bodies()[rssr.output()].name, "rod");
  // An unequal wheel is no idle one.
  MechanismParameters machine = withWheels("fourbar").read.machine;
  machine.bodies.back().inertia(0, 0) *= 1.01;
  EXPECT_EQ(machine.bodies[Mechanism(machine).output()].name, "other_wheel");
}

/// A ball in a socket at its centre may turn about every line.
TEST(IdleBall, isHeldAtRest) {
  MechanismScenario scenario = withWheels("ankle");
  const auto ball = [](double more) {
    return [more](MechanismParameters& machine) {
      MechanismBody& body = machine.bodies.back();
      body.inertia = (0.01 + more) * Matrix3d::Identity();
      if (more != 0) body.inertia(0, 0) -= more;
      machine.joints.back().kind = JointKind::ball;
      machine.joints.back().axis[0].setZero();
      machine.joints.back().centre = machine.joints.back().centre_of_child = body.center_of_mass;
    };
  };
  EXPECT_EQ(validateMechanism(changedScenario(scenario, ball(0))).verdict, Verdict::pass);
  EXPECT_THROW(MechanismAlong(changedScenario(scenario, ball(1e-3))), std::runtime_error);
}

using Change = void (*)(MechanismBody& wheel, MechanismJoint& hinge);

class WheelsWithEffect : public testing::TestWithParam<std::pair<const char*, Change>> {};

TEST_P(WheelsWithEffect, areFreedomsThatNeedMotors) {
  const MechanismScenario scenario = changedScenario(withWheels("fourbar"), [](MechanismParameters& machine) {
    GetParam().second(machine.bodies.back(), machine.joints.back());
  });
  try {
    const MechanismAlong along(scenario);
    ADD_FAILURE() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("1 motor for 2 freedoms; these joints are left free: other_wheel_hinge"));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Changes, WheelsWithEffect,
    testing::Values(
        std::pair<const char*, Change>("off_centre", [](auto& wheel, auto&) { wheel.center_of_mass.x() += 1e-3; }),
        std::pair<const char*, Change>("unequal", [](auto& wheel, auto&) { wheel.inertia(0, 0) *= 1.01; }),
        std::pair<const char*, Change>("damped", [](auto&, auto& hinge) { hinge.damping = 1e-3; }),
        std::pair<const char*, Change>("rubbing", [](auto&, auto& hinge) { hinge.friction = 1e-3; }),
        std::pair<const char*, Change>("sprung", [](auto&, auto& hinge) { hinge.stiffness = 1e-3; }),
        std::pair<const char*, Change>("with_a_rotor", [](auto&, auto& hinge) { hinge.rotor_inertia = 1e-3; })),
    [](const auto& change) { return std::string(change.param.first); });

}  // namespace
}  // namespace ursula

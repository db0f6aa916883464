// What the readers carry for a mechanism, and what the user's choices make of it. Each test has a file that must not do
// the same.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "base/scalar.h"
#include "tests/exchange/read_mechanism.h"

namespace ursula::exchange {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string loops = std::string(URSULA_SOURCE) + "/tests/vectors/loops/";

MechanismChoices fourbarChoices() {
  MechanismChoices out;
  out.motors = {"crank_hinge"};
  out.gravity = Vector3d(0, 0, -9.81);
  return out;
}

void expectSame(const ModelRead& a, const ModelRead& b) {
  constexpr double rounding = 1e-15;
  ASSERT_EQ(a.machine.bodies.size(), b.machine.bodies.size());
  for (std::size_t i = 0; i < a.machine.bodies.size(); ++i) {
    const MechanismBody &x = a.machine.bodies[i], &y = b.machine.bodies[i];
    SCOPED_TRACE(x.name);
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.fixed, y.fixed);
    if (x.fixed) continue;
    EXPECT_EQ(x.mass, y.mass);
    EXPECT_LE((x.center_of_mass - y.center_of_mass).norm(), rounding);
    EXPECT_LE((x.inertia - y.inertia).norm(), rounding);
  }
  ASSERT_EQ(a.machine.joints.size(), b.machine.joints.size());
  for (std::size_t j = 0; j < a.machine.joints.size(); ++j) {
    const MechanismJoint &x = a.machine.joints[j], &y = b.machine.joints[j];
    SCOPED_TRACE(x.name);
    EXPECT_EQ(x.kind, y.kind);
    EXPECT_EQ(x.closure, y.closure);
    EXPECT_EQ(std::pair(x.parent, x.child), std::pair(y.parent, y.child));
    EXPECT_LE((x.centre - y.centre).norm(), rounding);
    EXPECT_LE((x.centre_of_child - y.centre_of_child).norm(), rounding);
    EXPECT_LE(x.kind == JointKind::revolute ? (x.axis[0] - y.axis[0]).norm() : 0, rounding);
    EXPECT_EQ(x.position, y.position);
    EXPECT_EQ(x.driven, y.driven);
  }
  EXPECT_EQ(a.machine.motors, b.machine.motors);
  EXPECT_EQ(a.machine.gravity, b.machine.gravity);
}

TEST(ReadFourbar, isTheSameInThreeFormats) {
  const ModelRead mjcf = readMechanismModel(loops + "fourbar.xml", fourbarChoices());
  ASSERT_EQ(mjcf.machine.joints.size(), 4U);
  EXPECT_TRUE(mjcf.machine.joints[3].closure);
  EXPECT_EQ(mjcf.machine.joints[3].kind, JointKind::ball);
  for (const char* other : {"fourbar.sdf", "fourbar.urdf"}) {
    SCOPED_TRACE(other);
    const ModelRead model = readMechanismModel(loops + other, fourbarChoices());
    expectSame(mjcf, model);
    EXPECT_THAT(model.warnings, IsEmpty());
  }
}

TEST(ReadFourbar, motorsOfTheFile) {
  for (const char* file : {"fourbar.xml", "fourbar.urdf"})
    EXPECT_THAT(readMechanismModel(loops + file, {}).machine.motors, ElementsAre("crank_hinge")) << file;
  EXPECT_THAT(readMechanismModel(loops + "fourbar.sdf", {}).machine.motors, IsEmpty());
}

TEST(ReadMechanism, theOtherLoopsAreRead) {
  EXPECT_THAT(readMechanismModel(loops + "ankle.xml", {}).machine.motors, ElementsAre("motor0", "motor1"));
  EXPECT_EQ(readMechanismModel(loops + "planar3rrr.xml", {}).machine.motors.size(), 3U);
  const ModelRead delta = readMechanismModel(loops + "delta.xml", {});
  EXPECT_EQ(jointOf(delta, "plate_free").kind, JointKind::free);
  EXPECT_FALSE(jointOf(delta, "plate_free").closure);
  EXPECT_EQ(jointOf(delta, "arm0_motor").rotor_inertia, 0.003);
  EXPECT_EQ(std::count_if(delta.machine.joints.begin(), delta.machine.joints.end(),
                          [](const MechanismJoint& joint) { return joint.closure; }),
            6);
}

/// A hinge `h` and a slide `s` in a row, with more attributes of each.
std::string chain(const std::string& of_hinge, const std::string& of_slide = "", const std::string& more = "",
                  const std::string& of_body = "") {
  return "<mujoco><worldbody><body name='a'><joint name='h' axis='0 1 0' " + of_hinge +
         "/><inertial pos='0 0 1' mass='1' diaginertia='1 1 1'/><body name='b' pos='0 0 1' " + of_body +
         "><joint name='s' type='slide' " + of_slide +
         "/><inertial pos='0 0 1' mass='2' diaginertia='1 1 1'/></body></body></worldbody><actuator><motor joint='s' "
         "gear='7'/><motor joint='h'/></actuator>" +
         more + "</mujoco>";
}

TEST(ReadSprings, ofMjcfAreInCoordinatesOfTheFile) {
  const ModelRead model = mechanismOf("springs.xml", chain("stiffness='3' springref='30' ref='45' damping='0.5'",
                                                           "stiffness='4' springref='30' ref='2' frictionloss='0.25'"));
  const MechanismJoint &h = jointOf(model, "h"), &s = jointOf(model, "s");
  EXPECT_EQ(h.stiffness, 3);
  EXPECT_NEAR(h.spring_reference, pi / 6, 1e-15);
  EXPECT_NEAR(h.position, pi / 4, 1e-15);
  EXPECT_EQ(h.damping, 0.5);
  EXPECT_EQ(s.stiffness, 4);
  EXPECT_EQ(s.spring_reference, 30) << "a length has no angle's unit";
  EXPECT_EQ(s.position, 2);
  EXPECT_EQ(s.friction, 0.25);
  EXPECT_THAT(together(model.assumptions), HasSubstr("s: Coulomb friction is smoothed"));
  const ModelRead none = mechanismOf("none.xml", chain("ref='45'"));
  EXPECT_EQ(jointOf(none, "h").stiffness, 0);
  EXPECT_THAT(refusal("sd.xml", chain("springdamper='1 1'")), HasSubstr("dof_damping"));
  EXPECT_THAT(refusal("sn.xml", chain("stiffness='-1'")), HasSubstr("below zero"));
}

TEST(ReadSprings, ofSdf) {
  const auto text = [](const std::string& dynamics, const std::string& type = "revolute") {
    return "<sdf version='1.9'><model name='m'><link name='a'/><joint name='j' type='" + type +
           "'><parent>world</parent><child>a</child><axis><xyz>0 0 1</xyz><dynamics>" + dynamics +
           "</dynamics></axis></joint></model></sdf>";
  };
  const std::string spring =
      "<spring_stiffness>2.5</spring_stiffness><spring_reference>-0.75</spring_reference><damping>1</damping>";
  const ModelRead model = mechanismOf("spring.sdf", text(spring));
  EXPECT_EQ(jointOf(model, "j").stiffness, 2.5);
  EXPECT_EQ(jointOf(model, "j").spring_reference, -0.75);
  EXPECT_EQ(jointOf(model, "j").damping, 1);
  EXPECT_EQ(jointOf(mechanismOf("plain.sdf", text("")), "j").stiffness, 0);
  EXPECT_THAT(refusal("ball.sdf", text(spring, "ball")), HasSubstr("a spring of stiffness 2.5"));
  MechanismChoices without;
  without.leave_out = {"springs", "ball-friction"};
  const ModelRead left = mechanismOf("ball.sdf", text(spring, "ball"), without);
  EXPECT_EQ(jointOf(left, "j").stiffness, 0);
  EXPECT_THAT(together(left.assumptions), HasSubstr("j: Its spring is left out (2.5"));
}

TEST(ReadSprings, ofGazeboInUrdf) {
  const auto text = [](const std::string& of) {
    return "<robot name='r'><link name='a'/><link "
           "name='b'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' "
           "iyz='0'/></inertial></link><joint name='j' type='continuous'><parent link='a'/><child "
           "link='b'/></joint><gazebo reference='" +
           of + "'><springStiffness>6</springStiffness><springReference>0.5</springReference></gazebo></robot>";
  };
  const ModelRead model = mechanismOf("spring.urdf", text("j"));
  EXPECT_EQ(jointOf(model, "j").stiffness, 6);
  EXPECT_EQ(jointOf(model, "j").spring_reference, 0.5);
  EXPECT_THAT(refusal("wrong.urdf", text("k")), HasSubstr("no joint has that name"));
}

TEST(ReadGravity, isOffForOneBody) {
  EXPECT_TRUE(bodyOf(mechanismOf("comp.xml", chain("", "", "", "gravcomp='1'")), "b").weightless);
  EXPECT_FALSE(bodyOf(mechanismOf("comp.xml", chain("", "", "", "gravcomp='1'")), "a").weightless);
  EXPECT_FALSE(bodyOf(mechanismOf("comp.xml", chain("", "", "", "gravcomp='0'")), "b").weightless);
  EXPECT_THAT(refusal("half.xml", chain("", "", "", "gravcomp='0.5'")), HasSubstr("gravcomp 0.5"));
  EXPECT_THAT(refusal("motor.xml", chain("actuatorgravcomp='true'", "", "", "gravcomp='1'")), HasSubstr("body b"));
  EXPECT_EQ(refusal("motor.xml", chain("actuatorgravcomp='true'")), "none");
}

TEST(ReadMotors, keepTheOrderOfTheActuators) {
  const ModelRead model = mechanismOf("order.xml", chain(""));
  EXPECT_THAT(model.machine.motors, ElementsAre("s", "h"));
  EXPECT_THAT(together(model.assumptions),
              HasSubstr("s: The actuator's gear is left out: efforts are the joint's own"));
  MechanismChoices choices;
  choices.motors = {"h"};
  const ModelRead chosen = mechanismOf("order.xml", chain(""), choices);
  EXPECT_THAT(chosen.machine.motors, ElementsAre("h"));
  EXPECT_FALSE(jointOf(chosen, "s").driven);
  choices.motors = {"hh"};
  EXPECT_THAT(refusal("order.xml", chain(""), choices),
              testing::AllOf(HasSubstr("mechanism.motors"), HasSubstr("did you mean 'h'")));
  EXPECT_THAT(refusal("tendon.xml", chain("", "", "<actuator><motor tendon='t'/></actuator>")), HasSubstr("tendon t"));
  EXPECT_THAT(refusal("gear.xml", chain("", "", "<equality><joint joint1='h' joint2='s'/></equality>")),
              testing::AllOf(HasSubstr("as a gear does"), HasSubstr("without it")));
}

TEST(ReadRubbing, ofBallsAndFreeJoints) {
  const auto text = [](const std::string& joint) {
    return "<mujoco><worldbody><body name='a'><joint name='j' " + joint +
           "/><inertial pos='0 0 1' mass='1' diaginertia='1 1 1'/></body></worldbody></mujoco>";
  };
  const ModelRead ball = mechanismOf("ball.xml", text("type='ball' damping='2' armature='0.5'"));
  EXPECT_EQ(jointOf(ball, "j").damping, 2);
  EXPECT_EQ(jointOf(ball, "j").rotor_inertia, 0.5);
  const std::string rubs = text("type='ball' frictionloss='2'");
  EXPECT_THAT(refusal("rubs.xml", rubs), HasSubstr("leave_out = [\"ball-friction\"]"));
  MechanismChoices choices;
  choices.leave_out = {"ball-friction"};
  const ModelRead left = mechanismOf("rubs.xml", rubs, choices);
  EXPECT_EQ(jointOf(left, "j").friction, 0);
  EXPECT_THAT(together(left.assumptions), HasSubstr("j: Its Coulomb friction is left out (2"));
  EXPECT_EQ(jointOf(mechanismOf("hinge.xml", text("frictionloss='2' armature='3'"), choices), "j").friction, 2);
  choices.leave_out = {"passive-armature", "passive-friction"};
  const ModelRead passive = mechanismOf("hinge.xml", text("frictionloss='2' damping='1' armature='3'"), choices);
  EXPECT_FALSE(jointOf(passive, "j").isLoaded());
  choices.motors = {"j"};
  EXPECT_EQ(jointOf(mechanismOf("hinge.xml", text("armature='3'"), choices), "j").rotor_inertia, 3) << "a motor's";
  choices.leave_out = {"sprigns"};
  EXPECT_THAT(refusal("hinge.xml", text(""), choices), HasSubstr("did you mean 'springs'"));
}

TEST(ReadFluid, isRefusedUnlessLeftOut) {
  const std::string text = chain("", "", "<option density='1.2' viscosity='1e-5'/>");
  EXPECT_THAT(refusal("fluid.xml", text),
              testing::AllOf(HasSubstr("density 1.2"), HasSubstr("leave_out = [\"fluid\"]")));
  MechanismChoices choices;
  choices.leave_out = {"fluid"};
  const std::string said = together(mechanismOf("fluid.xml", text, choices).assumptions);
  EXPECT_THAT(said, testing::AllOf(HasSubstr("(1.2 kg/m³)"), HasSubstr("(1e-05 Pa·s)")));
  EXPECT_THAT(together(mechanismOf("dry.xml", chain(""), choices).assumptions), testing::Not(HasSubstr("fluid")));
}

}  // namespace
}  // namespace ursula::exchange

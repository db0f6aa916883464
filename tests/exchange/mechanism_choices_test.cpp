// What a mechanism is made of where a file leaves it open: what floats, the user's choices, keyframes, other files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/exchange/read_mechanism.h"

namespace ursula::exchange {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// Two cranks that carry a bar by balls; nothing is the parent of the bar, or nothing joins it, by `joints`.
std::string bars(const std::string& joints, const std::string& more = "") {
  const auto link = [](const std::string& name) {
    return "<link name='" + name +
           "'><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial></link>";
  };
  const auto hinge = [](const std::string& name) {
    return "<joint name='" + name + "_hinge' type='revolute'><parent>world</parent><child>" + name +
           "</child><axis><xyz>0 1 0</xyz></axis></joint>";
  };
  return "<sdf version='1.9'><model name='m'>" + link("left") + link("right") + link("bar") + hinge("left") +
         hinge("right") + joints + more + "</model></sdf>";
}

TEST(ReadFloating, linksThatClosuresHoldAreInTheTree) {
  const std::string balls =
      "<joint name='l' type='ball'><parent>bar</parent><child>left</child></joint>"
      "<joint name='r' type='ball'><parent>bar</parent><child>right</child></joint>";
  const ModelRead model = mechanismOf("bars.sdf", bars(balls));
  EXPECT_EQ(bodyOf(model, "bar").mass, 1);
  EXPECT_FALSE(jointOf(model, "l").closure) << "the bar hangs on it";
  EXPECT_TRUE(jointOf(model, "r").closure);

  const ModelRead apart = mechanismOf("apart.sdf", bars(""));
  EXPECT_THROW(bodyOf(apart, "bar"), std::out_of_range);
  EXPECT_THAT(together(apart.assumptions), HasSubstr("bar: This body floats"));
  EXPECT_EQ(apart.machine.bodies.at(jointOf(apart, "right_hinge").child).name, "right");
}

TEST(ReadFloating, aMachineNeedsABase) {
  const std::string text =
      "<sdf version='1.9'><model name='m'><link name='trunk'/><link name='arm'/><joint name='j' "
      "type='revolute'><parent>trunk</parent><child>arm</child><axis><xyz>0 1 0</xyz></axis></joint></model></sdf>";
  EXPECT_THAT(refusal("floats.sdf", text), testing::AllOf(HasSubstr("base = "), HasSubstr("trunk, arm")));
  MechanismChoices choices;
  choices.base = "trunk";
  EXPECT_TRUE(bodyOf(mechanismOf("floats.sdf", text, choices), "trunk").fixed);
  choices.base = "trnk";
  EXPECT_THAT(refusal("floats.sdf", text, choices),
              testing::AllOf(HasSubstr("mechanism.base"), HasSubstr("did you mean 'trunk'")));

  const std::string legged =
      "<mujoco><worldbody><body name='trunk'><freejoint/><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/><body "
      "name='leg'><joint name='j'/><inertial pos='0 0 0' mass='1' diaginertia='1 1 "
      "1'/></body></body></worldbody><actuator><motor joint='j'/></actuator></mujoco>";
  EXPECT_THAT(refusal("legged.xml", legged), HasSubstr("base = "));
  choices.base = "trunk";
  const ModelRead held = mechanismOf("legged.xml", legged, choices);
  EXPECT_EQ(held.machine.joints.size(), 1U);
  EXPECT_THAT(together(held.assumptions), HasSubstr("Both of its bodies stand still"));
}

/// A floating base by slides and a ball, as files of legged machines have it.
TEST(ReadFloating, slidesAndABallHoldNoBase) {
  const std::string inertial = "<inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>";
  const std::string text =
      "<mujoco><worldbody><body name='trunk'><joint name='x' type='slide'/><joint name='y' type='slide'/><joint "
      "name='z' type='slide'/><joint name='o' type='ball'/>" +
      inertial + "<body name='leg'><joint name='j'/>" + inertial +
      "</body></body></worldbody><actuator><motor joint='j'/></actuator></mujoco>";
  EXPECT_EQ(mechanismOf("slides.xml", text).machine.joints.size(), 5U);
  MechanismChoices choices;
  choices.base = "trunk";
  const ModelRead held = mechanismOf("slides.xml", text, choices);
  ASSERT_EQ(held.machine.joints.size(), 1U);
  EXPECT_EQ(held.machine.joints[0].name, "j");
  choices.base = "leg";
  EXPECT_EQ(mechanismOf("slides.xml", text, choices).machine.joints.size(), 5U) << "the trunk has a mass";
}

TEST(ReadChoices, anotherBaseOfUrdfSetsItsRootFree) {
  const std::string inertial =
      "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>";
  const std::string text =
      "<robot name='r'><link name='a'>" + inertial + "</link><link name='b'>" + inertial +
      "</link><joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint></robot>";
  const ModelRead plain = mechanismOf("base.urdf", text);
  EXPECT_TRUE(bodyOf(plain, "a").fixed);
  EXPECT_THAT(together(plain.assumptions), HasSubstr("root link stands still"));
  MechanismChoices choices;
  choices.base = "b";
  const ModelRead model = mechanismOf("base.urdf", text, choices);
  EXPECT_TRUE(bodyOf(model, "b").fixed);
  EXPECT_FALSE(bodyOf(model, "a").fixed);
  EXPECT_THAT(together(model.assumptions), testing::Not(HasSubstr("root link stands still")));
  EXPECT_THAT(refusal("light.urdf", "<robot name='r'><link name='a'/></robot>"), HasSubstr("has a mass"));
}

TEST(ReadChoices, closeAndGravity) {
  MechanismChoices choices;
  choices.close = {"left:bar", "bar:right"};
  choices.gravity = Vector3d(1, 2, 3);
  const ModelRead model = mechanismOf("close.sdf", bars(""), choices);
  EXPECT_EQ(jointOf(model, "close left:bar").kind, JointKind::ball);
  EXPECT_FALSE(jointOf(model, "close left:bar").closure) << "the bar hangs on it";
  EXPECT_TRUE(jointOf(model, "close bar:right").closure);
  EXPECT_EQ(model.machine.gravity, Vector3d(1, 2, 3));
  EXPECT_THAT(together(model.assumptions), testing::Not(HasSubstr("gravity")));
  EXPECT_THAT(together(mechanismOf("close.sdf", bars("")).assumptions), HasSubstr("gives no gravity"));
  for (const auto& [pair, word] : {std::pair("left", "\"A:B\""), std::pair("lft:bar", "did you mean 'left'")}) {
    choices.close = {pair};
    EXPECT_THAT(refusal("close.sdf", bars(""), choices), testing::AllOf(HasSubstr("mechanism.close"), HasSubstr(word)));
  }
}

/// A pendulum that a weld with relpose holds half a metre above the file's pose; its slide reaches there at a keyframe.
std::string keyed(const std::string& keys) {
  return "<mujoco><compiler angle='radian'/><worldbody><body name='a' pos='1 0 0'><joint name='s' type='slide' axis='0 "
         "0 1' "
         "ref='0.25'/><joint name='h' axis='0 1 0'/><inertial pos='0 0 1' mass='1' diaginertia='1 1 1'/></body>"
         "<body name='c'><inertial pos='0 0 1' mass='1' diaginertia='1 1 1'/></body></worldbody>"
         "<equality><weld name='w' body1='c' body2='a' relpose='1 0 0.5 1 0 0 0'/></equality><keyframe>" +
         keys + "</keyframe></mujoco>";
}

TEST(ReadKeyframe, closesWhatTheFilesPoseLeavesOpen) {
  const ModelRead model =
      mechanismOf("key.xml", keyed("<key name='other' qpos='0 0'/><key name='home' qpos='0.75 0'/>"));
  EXPECT_EQ(jointOf(model, "s").position, 0.75);
  EXPECT_LE((bodyOf(model, "a").frame.translation() - Vector3d(1, 0, 0.5)).norm(), 1e-15);
  EXPECT_LE((bodyOf(model, "a").center_of_mass - Vector3d(1, 0, 1.5)).norm(), 1e-15);
  EXPECT_LE((jointOf(model, "w").closing().translation()).norm(), 1e-15);
  EXPECT_FALSE(jointOf(model, "h").isOpen());
  EXPECT_THAT(together(model.assumptions), HasSubstr("keyframe 'home'"));
  EXPECT_THAT(model.warnings, IsEmpty());

  for (const char* keys : {"<key qpos='0.25 0.1'/>", "<key qpos='0.75 0'/><key qpos='0.75 0'/>"}) {
    const ModelRead open = mechanismOf("open.xml", keyed(keys));
    EXPECT_EQ(jointOf(open, "s").position, 0.25) << keys;
    EXPECT_THAT(together(open.assumptions), HasSubstr("Keyframes are left out")) << keys;
    EXPECT_THAT(together(open.warnings), HasSubstr("w: This joint is open")) << keys;
  }
  EXPECT_THAT(refusal("short.xml", keyed("<key name='home' qpos='0.75'/>")),
              HasSubstr("qpos has 1 numbers, expected 2"));
}

TEST(ReadKeyframe, isThatWhichTheUserNames) {
  const std::string keys = "<key name='home' qpos='0.75 0'/><key name='other' qpos='0.5 0'/>";
  MechanismChoices choices;
  choices.key = "other";
  const ModelRead model = mechanismOf("named.xml", keyed(keys), choices);
  EXPECT_EQ(jointOf(model, "s").position, 0.5);
  EXPECT_THAT(together(model.assumptions), HasSubstr("keyframe 'other'"));
  choices.key = "othr";
  EXPECT_THAT(refusal("named.xml", keyed(keys), choices),
              HasSubstr("no keyframe 'othr', expected one of 'home', 'other', did you mean 'other'?"));
}

TEST(ReadIncludes, besideTheModel) {
  const std::string inner = "<mujocoinclude><body name='in'><joint/><geom size='0.1'/></body></mujocoinclude>";
  const std::string outer =
      "<mujoco><worldbody><include file='FILE'/><body name='own'><joint name='j'/><geom "
      "size='0.1'/></body></worldbody></mujoco>";
  const auto with = [&](const std::string& file) {
    std::string out = outer;
    return out.replace(out.find("FILE"), 4, file);
  };
  written("inner.xml", inner);
  const ModelRead model = mechanismOf("outer.xml", with("inner.xml"));
  EXPECT_EQ(model.machine.bodies.at(1).name, "in");
  EXPECT_EQ(model.machine.joints.at(0).name, "joint of in");
  EXPECT_EQ(bodyOf(model, "own").mass, bodyOf(model, "in").mass);
  EXPECT_THAT(refusal("outer.xml", with("missing.xml")), HasSubstr("does not lie beside the model"));
  EXPECT_THAT(refusal("outer.xml", with("outer.xml")), HasSubstr("included twice"));
  EXPECT_THAT(refusal("outer.xml", with("../read_mechanism_ReadIncludes/inner.xml")),
              HasSubstr("out of the model's folder"));
  written("bad.xml", "<mujocoinclude><body>\n</mujocoinclude>");
  EXPECT_THAT(refusal("outer.xml", with("bad.xml")), HasSubstr("bad.xml:"));
}

TEST(ReadNames, areOfTheirOwn) {
  const ModelRead model = mechanismOf("names.xml",
                                      "<mujoco><worldbody><body><joint/><geom size='1'/></body><body><joint/><geom "
                                      "size='1'/></body></worldbody></mujoco>");
  EXPECT_EQ(model.machine.joints.at(0).name, "joint of line 1");
  EXPECT_EQ(model.machine.joints.at(1).name, "joint of line 1 (2)");
  EXPECT_EQ(model.machine.bodies.at(2).name, "body of line 1 (2)");
}

TEST(ReadMeshes, ofBodiesThatStandStillHaveNoEffect) {
  const auto text = [](const std::string& joint, const std::string& compiler) {
    return "<mujoco><compiler " + compiler + "/><worldbody><body name='base'>" + joint +
           "<geom type='mesh' mesh='m'/><body name='a'><joint name='j'/><geom "
           "size='0.1'/></body></body></worldbody></mujoco>";
  };
  EXPECT_THAT(together(mechanismOf("mesh.xml", text("", "")).assumptions),
              HasSubstr("base: The mass of this body's mesh"));
  EXPECT_THAT(refusal("mesh.xml", text("<joint name='k'/>", "")), HasSubstr("body base needs an <inertial>"));
  EXPECT_THAT(refusal("mesh.xml", text("", "settotalmass='3'")), HasSubstr("body base needs an <inertial>"));
}

TEST(ReadMoments, thatNoBodyHasAreSaid) {
  const auto text = [](const std::string& moments) {
    return "<mujoco><worldbody><body name='a'><joint name='j'/><inertial pos='0 0 0' mass='1' diaginertia='" + moments +
           "'/></body></worldbody></mujoco>";
  };
  EXPECT_THAT(together(mechanismOf("bad.xml", text("1 1 3")).warnings), HasSubstr("a: The largest principal moment"));
  EXPECT_THAT(mechanismOf("good.xml", text("1 2 3")).warnings, IsEmpty());
}

}  // namespace
}  // namespace ursula::exchange

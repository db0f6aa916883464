// MuJoCo's own reader against this program's, on model files that were made without either.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "parts/engines/mujoco/mujoco_reading.h"
#include "parts/engines/voting_engines.h"
#include "parts/exchange/import.h"
#include "tests/base/temporary_folder.h"

namespace ursula {
namespace {

std::string fileOf(const std::string& name) { return std::string(URSULA_VECTORS) + "/loops/" + name; }

class MujocosReader : public testing::Test {
 protected:
  void SetUp() override {
    if (!mujocoAvailable()) GTEST_SKIP() << "without MuJoCo";
  }
};

TEST_F(MujocosReader, findsTheSameNumbers) {
  for (const char* name : {"fourbar.xml", "planar3rrr.xml", "ankle.xml", "delta.xml", "fourbar.urdf"}) {
    const ReadingDifference found = readByMujoco(fileOf(name), exchange::readModel(fileOf(name)), {});
    EXPECT_EQ(found.refusal, "") << name;
    EXPECT_GT(found.bodies, 1) << name;
    EXPECT_GT(found.joints, 1) << name;
    EXPECT_LT(found.value, found.limit) << name << ": " << found.where;
  }
}

/// A weld that closes a loop joins two bodies, which MuJoCo keeps apart.
TEST_F(MujocosReader, keepsWeldedClosuresApart) {
  const std::string text = R"(<mujoco><worldbody>
    <body name="a"><inertial pos="0 0 0.1" mass="1" diaginertia="1 1 1"/><joint name="j" axis="0 1 0"/></body>
    <body name="b" pos="0 0 1"><freejoint/><inertial pos="0 0 0.1" mass="2" diaginertia="1 1 1"/></body>
    </worldbody><equality><weld body1="a" body2="b"/></equality>
    <actuator><motor joint="j"/></actuator></mujoco>)";
  const TemporaryFolder folder;
  const auto file = folder.write("welded.xml", text);
  ReadingChoices choices;
  choices.by_eigenvalues = false;
  const ReadingDifference found = readByMujoco(file, exchange::readModel(file), choices);
  EXPECT_EQ(found.refusal, "");
  EXPECT_EQ(found.closures, 1);
  EXPECT_LT(found.value, found.limit) << found.where;
}

TEST_F(MujocosReader, findsEachWrongNumber) {
  using Change = std::function<void(MechanismParameters&)>;
  const MechanismParameters right = exchange::readModel(fileOf("ankle.xml"));
  const auto body = [](MechanismParameters& m, const std::string& name) -> MechanismBody& {
    for (MechanismBody& each : m.bodies)
      if (each.name == name) return each;
    throw std::logic_error(name);
  };
  const auto joint = [](MechanismParameters& m, const std::string& name) -> MechanismJoint& {
    for (MechanismJoint& each : m.joints)
      if (each.name == name) return each;
    throw std::logic_error(name);
  };
  const std::pair<const char*, Change> changes[] = {
      {"mass of foot", [&](auto& m) { body(m, "foot").mass *= 1 + 1e-9; }},
      {"mass centre of rod0", [&](auto& m) { body(m, "rod0").center_of_mass.x() += 1e-9; }},
      {"inertia of rod0", [&](auto& m) { body(m, "rod0").inertia *= 1 + 1e-3; }},
      {"armature of motor0", [&](auto& m) { joint(m, "motor0").rotor_inertia *= 1 + 1e-9; }},
      {"damping of pitch", [&](auto& m) { joint(m, "pitch").damping *= 1 + 1e-9; }},
      {"frictionloss of roll", [&](auto& m) { joint(m, "roll").friction = 1e-9; }},
      {"axis of motor1", [&](auto& m) { joint(m, "motor1").axis[0] *= -1; }},
      {"ref of roll", [&](auto& m) { joint(m, "roll").position = 1e-9; }},
      {"gravity", [&](auto& m) { m.gravity.z() = -9.80665; }},
  };
  for (const auto& [where, change] : changes) {
    MechanismParameters wrong = right;
    change(wrong);
    const ReadingDifference found = readByMujoco(fileOf("ankle.xml"), wrong, {});
    EXPECT_GT(found.value, found.limit) << where;
    EXPECT_EQ(found.where, where);
  }
}

/// MuJoCo passes over what others say of a rotor in a URDF, and never sees the file that changes a joint's type.
TEST_F(MujocosReader, isNotHeldToWhatItDoesNotRead) {
  MechanismParameters machine = exchange::readModel(fileOf("fourbar.urdf"));
  MechanismJoint& joint = *std::find_if(machine.joints.begin(), machine.joints.end(), [&](const MechanismJoint& each) {
    const bool is_motor = std::count(machine.motors.begin(), machine.motors.end(), each.name) > 0;
    return each.kind == JointKind::revolute && !each.closure && !is_motor;
  });
  joint.rotor_inertia = 0.1;
  ReadingChoices choices;
  const ReadingDifference held = readByMujoco(fileOf("fourbar.urdf"), machine, choices);
  EXPECT_GT(held.value, held.limit);
  EXPECT_EQ(held.where, "armature of " + joint.name);
  choices.is_urdf = true;
  const ReadingDifference left = readByMujoco(fileOf("fourbar.urdf"), machine, choices);
  EXPECT_LT(left.value, left.limit) << left.where;
  EXPECT_EQ(left.left_out, std::vector<std::string>{"armature of " + joint.name});
  joint.kind = JointKind::ball;
  const ReadingDifference wrong = readByMujoco(fileOf("fourbar.urdf"), machine, choices);
  EXPECT_EQ(wrong.where, "type of " + joint.name);
  choices.retyped = {joint.name};
  const ReadingDifference retyped = readByMujoco(fileOf("fourbar.urdf"), machine, choices);
  EXPECT_LT(retyped.value, retyped.limit) << retyped.where;
  EXPECT_EQ(retyped.left_out, std::vector<std::string>{"type of " + joint.name});
}

TEST_F(MujocosReader, saysWhyItRefusesAFile) {
  const MechanismParameters machine = exchange::readModel(fileOf("fourbar.xml"));
  EXPECT_THAT(readByMujoco(fileOf("fourbar.sdf"), machine, {}).refusal, testing::HasSubstr("MuJoCo: "));
}

}  // namespace
}  // namespace ursula

// What a reader makes of small files, by numbers that are seen at once.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "parts/exchange/import.h"

namespace ursula::exchange {
namespace {

ModelGraph read(const std::string& text, const std::string& name) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / ("read_graph_" + name);
  std::ofstream(file) << text;
  return readModel(file);
}

/// A link that is turned a quarter about z, with a hinge about "x" as each version means it.
std::string sdf(const std::string& version, const std::string& axis, const std::string& joint_pose = "") {
  return R"(<sdf version=")" + version + R"("><model name="m"><pose>0 0 1 0 0 0</pose><link name="a"/>
    <link name="b"><pose>1 0 0 0 0 1.5707963267948966</pose></link>
    <joint name="j" type="revolute"><parent>a</parent><child>b</child>)" +
         joint_pose + "<axis>" + axis + "</axis></joint></model></sdf>";
}

Vector3d axisOf(const std::string& text) {
  const ModelGraph graph = read(text, "axis.sdf");
  EXPECT_EQ(graph.joints.size(), 1U);
  EXPECT_LE((graph.joints.at(0).centre - Vector3d(1, 0, 1)).norm(), 1e-15);
  return graph.joints.at(0).axis[0];
}

TEST(ReadSdf, axisIsInTheFrameOfItsVersion) {
  const std::string x = "<xyz>1 0 0</xyz>", in_model = "<use_parent_model_frame>1</use_parent_model_frame>";
  EXPECT_LE((axisOf(sdf("1.4", x)) - Vector3d::UnitX()).norm(), 1e-15);
  EXPECT_LE((axisOf(sdf("1.5", x)) - Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LE((axisOf(sdf("1.6", x + in_model)) - Vector3d::UnitX()).norm(), 1e-15);
  EXPECT_LE((axisOf(sdf("1.7", x)) - Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LE((axisOf(sdf("1.7", x + in_model)) - Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LE((axisOf(sdf("1.9", R"(<xyz expressed_in="__model__">1 0 0</xyz>)")) - Vector3d::UnitX()).norm(), 1e-15);
  EXPECT_LE((axisOf(sdf("1.9", R"(<xyz expressed_in="a">1 0 0</xyz>)")) - Vector3d::UnitX()).norm(), 1e-15);
}

TEST(ReadSdf, whatHasNoMeaningAnyMoreIsSaid) {
  const ModelGraph graph =
      read(sdf("1.8", "<xyz>1 0 0</xyz><use_parent_model_frame>1</use_parent_model_frame>"), "said.sdf");
  const auto said = std::find_if(graph.assumptions.begin(), graph.assumptions.end(), [](const Assumption& a) {
    return a.what.find("use_parent_model_frame") != std::string::npos;
  });
  ASSERT_NE(said, graph.assumptions.end());
  EXPECT_NEAR(said->size, 1.5707963267948966, 1e-15);
}

TEST(ReadSdf, nestedModelsAndPlacement) {
  const ModelGraph graph = read(R"(<sdf version="1.8"><model name="m"><link name="a"/>
    <model name="n" placement_frame="tip"><pose relative_to="a">0 0 5 0 0 0</pose><link name="c"/>
      <frame name="tip" attached_to="c"><pose>0 0 2 0 0 0</pose></frame></model>
    <frame name="f" attached_to="n::c"><pose>1 0 0 0 0 0</pose></frame>
    <joint name="j" type="ball"><parent>a</parent><child>f</child></joint></model></sdf>)",
                                "nested.sdf");
  ASSERT_EQ(graph.bodies.size(), 3U);
  EXPECT_EQ(graph.bodies[2].name, "n::c");
  EXPECT_LE((graph.bodies[2].frame.translation() - Vector3d(0, 0, 3)).norm(), 1e-15);
  EXPECT_EQ(graph.joints.at(0).child, 2U);
  EXPECT_LE((graph.joints.at(0).centre - Vector3d(1, 0, 3)).norm(), 1e-15);
}

/// How many assumptions name `what`, and the size of the last one.
std::pair<int, double> assumed(const ModelGraph& graph, const std::string& what) {
  std::pair<int, double> out = {0, 0.0};
  for (const Assumption& each : graph.assumptions)
    if (each.what.find(what) != std::string::npos) out = {out.first + 1, each.size};
  return out;
}

TEST(ReadMjcf, whatTheCompilerChangesIsListed) {
  const auto graph = [](const std::string& compiler) {
    return read("<mujoco><compiler " + compiler + R"(/><worldbody><body name="a"><joint name="j"/>
      <inertial pos="0 0 0" mass="0.1" diaginertia="0.001 0.4 0.5"/></body></worldbody></mujoco>)",
                "bounds.xml");
  };
  const ModelGraph bounded = graph(R"(boundmass="0.5" boundinertia="0.02")");
  EXPECT_EQ(assumed(bounded, "boundmass").first, 1);
  EXPECT_NEAR(assumed(bounded, "boundmass").second, 0.4, 1e-15);
  EXPECT_NEAR(assumed(bounded, "boundinertia").second, 0.019, 1e-15);
  EXPECT_NEAR(assumed(graph(R"(balanceinertia="true")"), "balanceinertia").second, 0.901 / 3 - 0.001, 1e-12);
  const ModelGraph plain = graph(R"(boundmass="0.05" boundinertia="0.0005")");
  for (const char* what : {"boundmass", "boundinertia", "balanceinertia"}) EXPECT_EQ(assumed(plain, what).first, 0);
}

/// As SDFormat reads it: up to 1.5 the physics has a world's gravity, then only the world itself.
TEST(ReadSdf, gravityOfPhysicsCountsInOldVersionsOnly) {
  const auto graph = [](const std::string& version) {
    return read("<sdf version='" + version +
                    "'><world name='w'><physics type='ode'><gravity>0 0 -5</gravity></physics>" +
                    "<model name='m'><link name='a'/></model></world></sdf>",
                "physics.sdf");
  };
  EXPECT_EQ(graph("1.5").gravity, Vector3d(0, 0, -5));
  EXPECT_EQ(assumed(graph("1.5"), "<physics>").first, 0);
  for (const char* version : {"1.6", "1.9"}) {
    EXPECT_EQ(graph(version).gravity, Vector3d(0, 0, -9.8)) << version;
    EXPECT_EQ(assumed(graph(version), "<physics>"), std::make_pair(1, 5.0)) << version;
  }
}

/// MuJoCo would take no mass, or refuse; and what it refuses, an <inertial> without its place.
TEST(ReadMjcf, noInertiaIsInvented) {
  const auto graph = [](const std::string& place, const std::string& geom) {
    return read("<mujoco><compiler inertiafromgeom='true'/><worldbody><body name='a'><joint name='j'/><inertial " +
                    place + " mass='1' diaginertia='1 1 1'/>" + geom + "</body></worldbody></mujoco>",
                "massless.xml");
  };
  EXPECT_EQ(graph("pos='0 0 1'", "").bodies.at(1).mass, 1);
  EXPECT_THROW(graph("pos='0 0 1'", "<geom size='1' mass='0'/>"), ImportError);
  EXPECT_THROW(graph("", ""), ImportError);
}

TEST(ReadUrdf, gravityIsListedUnlessMujocosSettingsGiveOne) {
  const auto graph = [](const std::string& settings) {
    return read(R"(<robot name="r"><mujoco>)" + settings + R"(</mujoco><link name="a"/></robot>)", "gravity.urdf");
  };
  const ModelGraph taken = graph("<compiler/>"), given = graph(R"(<option gravity="0 0 -3"/>)");
  EXPECT_EQ(assumed(taken, "has no gravity").first, 1);
  EXPECT_EQ(taken.gravity, Vector3d(0, 0, -9.81));
  EXPECT_EQ(assumed(given, "has no gravity").first, 0);
  EXPECT_EQ(given.gravity, Vector3d(0, 0, -3));
  EXPECT_EQ(assumed(graph("<equality/>"), "<equality>").first, 1);
}

TEST(ReadMjcf, sitesAndFramesOfNewerFiles) {
  const ModelGraph graph = read(R"(<mujoco><option integrator="implicitfast"/><worldbody>
    <frame pos="0 0 1"><body name="a" pos="1 0 0"><joint name="j" axis="1 0 0"/><geom size="0.1"/><site name="s" pos="0 0 1"/></body></frame>
    <body name="b" pos="1 0 2.5"><freejoint/><geom size="0.1"/><site name="t" pos="0 0 0"/></body></worldbody>
    <equality><connect name="c" site1="s" site2="t"/></equality></mujoco>)",
                                "newer.xml");
  const GraphJoint& closure = graph.joints.at(2);
  EXPECT_TRUE(closure.closure);
  EXPECT_LE((closure.centre - Vector3d(1, 0, 2)).norm(), 1e-15);
  EXPECT_LE((closure.centre_of_child - Vector3d(1, 0, 2.5)).norm(), 1e-15);
}

TEST(ReadUrdf, gearedRotorAndGravity) {
  const ModelGraph graph = read(R"(<robot name="r"><link name="a"/><link name="b"/>
    <joint name="j" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0 0 1" rpy="0 0 1.5707963267948966"/>
      <axis xyz="0 1 0"/><limit lower="0" upper="0" effort="3" velocity="1"/></joint>
    <transmission name="t"><joint name="j"/><actuator name="m"><drake:rotor_inertia value="0.5"/><drake:gear_ratio value="3"/>
    </actuator></transmission></robot>)",
                                "geared.urdf");
  const GraphJoint& joint = graph.joints.at(0);
  EXPECT_TRUE(joint.driven);
  EXPECT_EQ(joint.rotor_inertia, 4.5);
  EXPECT_LE((joint.axis[0] + Vector3d::UnitX()).norm(), 1e-15);
  EXPECT_FALSE(std::isfinite(joint.lower));
  EXPECT_EQ(graph.gravity.z(), -9.81);
}

/// A folder with a URDF of two arms, and the file of its robot.yaml.
std::filesystem::path folderOfArms() {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "read_graph_yaml";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "r.urdf") << R"(<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
    <joint name="mot1" type="continuous"><parent link="a"/><child link="b"/></joint>
    <joint name="free1" type="continuous"><parent link="a"/><child link="c"/><origin xyz="0 0 0.5"/></joint></robot>)";
  return folder;
}

TEST(ReadUrdf, robotYamlNamesPairsAndMotors) {
  const std::filesystem::path folder = folderOfArms();
  std::ofstream(folder / "robot.yaml") << "name: r\nclosed_loop: [['b', c]]\ntype: [3d]\nname_mot: mot\n";
  const ModelGraph graph = readModel(folder / "r.urdf");
  ASSERT_EQ(graph.joints.size(), 3U);
  EXPECT_TRUE(graph.joints[0].driven);
  EXPECT_FALSE(graph.joints[1].driven);
  EXPECT_TRUE(graph.joints[2].closure);
  EXPECT_EQ(graph.joints[2].kind, JointKind::ball);
  EXPECT_EQ(graph.joints[2].centre_of_child.z() - graph.joints[2].centre.z(), 0.5);
  EXPECT_THAT(graph.motors, testing::IsEmpty()) << "a part of names gives no order";

  // A joint's name stands for the frame of its child.
  std::ofstream(folder / "robot.yaml") << "closed_loop: [[mot1, free1]]\ntype: [6d]\n";
  const GraphJoint closure = readModel(folder / "r.urdf").joints.at(2);
  EXPECT_EQ(closure.kind, JointKind::fixed);
  EXPECT_EQ(closure.child, graph.joints[2].child);
  EXPECT_EQ(closure.closing().translation().z(), -0.5);
  std::ofstream(folder / "robot.yaml") << "closed_loop: [[mot1, none]]\n";
  EXPECT_THROW(readModel(folder / "r.urdf"), ImportError);

  std::ofstream(folder / "robot.yaml") << "name_mot: [free1, mot1]\n";
  EXPECT_THAT(readModel(folder / "r.urdf").motors, testing::ElementsAre("free1", "mot1"));
}

TEST(ReadUrdf, robotYamlChangesJoints) {
  const std::filesystem::path folder = folderOfArms();
  std::ofstream(folder / "robot.yaml")
      << "joint_name: [free1, mot1]\njoint_type: ['SPHERICAL', 'UJOINT_ZY']\nother: 1\n";
  const ModelGraph other = readModel(folder / "r.urdf");
  EXPECT_EQ(other.joints.at(1).kind, JointKind::ball);
  EXPECT_EQ(other.joints.at(0).kind, JointKind::universal);
  EXPECT_EQ(other.joints.at(0).axis[0], Vector3d::UnitZ());
  EXPECT_EQ(other.joints.at(0).axis[1], Vector3d::UnitY());
  EXPECT_EQ(assumed(other, "as robot.yaml says").first, 2);
  EXPECT_EQ(assumed(other, "did you mean").first, 0);
  EXPECT_EQ(assumed(other, "Nothing is known of other").first, 1);
  std::ofstream(folder / "robot.yaml") << "joint_name: [free1]\njoint_type: [FIXED]\n";
  EXPECT_EQ(readModel(folder / "r.urdf").joints.at(1).kind, JointKind::fixed);
  std::ofstream(folder / "robot.yaml") << "joint_name: [fre1]\njoint_type: [FIXED]\n";
  EXPECT_EQ(assumed(readModel(folder / "r.urdf"), "did you mean 'free1'").first, 1);
  for (const char* wrong : {"joint_name: [free1]\njoint_type: [PLANAR]\n", "joint_name: [free1]\njoint_type: []\n",
                            "joint_name: [free1]\njoint_type: [UJOINT_XX]\n"}) {
    std::ofstream(folder / "robot.yaml") << wrong;
    EXPECT_THROW(readModel(folder / "r.urdf"), ImportError) << wrong;
  }
}

TEST(Assumption, saysASizeWithItsUnitIfItHasOne) {
  EXPECT_EQ(inWords({"It has iterations", "option", 50, "1"}), "option: It has iterations (50)");
  EXPECT_EQ(inWords({"It is open", "pin", 0.01, "m", true}), "warning: pin: It is open (0.01 m)");
}

}  // namespace
}  // namespace ursula::exchange

// The reader of MJCF against MuJoCo's own, on files that use what changes numbers: compiler, defaults, orientations,
// shapes. Bodies, inertias and joints at the initial pose must agree.

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "parts/exchange/import.h"
#include "parts/exchange/mechanism_reader.h"

namespace ursula::exchange {
namespace {

using Map3 = Eigen::Map<const Vector3d>;
using MapRows = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

/// MuJoCo turns to principal axes until a turn has a cosine within 1e-12 of 1: an angle of 1.4e-6.
constexpr double inertia_tolerance = 2e-6, tolerance = 1e-12;

class ReadMujoco : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    std::replace(name.begin(), name.end(), '/', '_');
    file_ = std::filesystem::path(testing::TempDir()) / ("read_mujoco_" + name + ".xml");
    std::ofstream(file_) << GetParam();
    std::array<char, 1000> error{};
    model_.reset(mj_loadXML(file_.c_str(), nullptr, error.data(), static_cast<int>(error.size())));
    ASSERT_TRUE(model_) << error.data();
    data_.reset(mj_makeData(model_.get()));
    mj_kinematics(model_.get(), data_.get());
    mj_comPos(model_.get(), data_.get());
  }

  std::filesystem::path file_;
  std::unique_ptr<mjModel, void (*)(mjModel*)> model_{nullptr, mj_deleteModel};
  std::unique_ptr<mjData, void (*)(mjData*)> data_{nullptr, mj_deleteData};
};

TEST_P(ReadMujoco, agreesOnBodies) {
  const ModelGraph graph = readModel(file_);
  int compared = 0;
  for (const GraphBody& body : graph.bodies) {
    const int id = mj_name2id(model_.get(), mjOBJ_BODY, body.name.c_str());
    if (id <= 0) continue;
    SCOPED_TRACE(body.name);
    ++compared;
    EXPECT_LE((body.frame.translation() - Map3(data_->xpos + 3 * id)).norm(), tolerance);
    EXPECT_LE((body.frame.linear() - MapRows(data_->xmat + 9 * id)).norm(), tolerance);
    EXPECT_NEAR(body.mass, model_->body_mass[id], tolerance * model_->body_mass[id]);
    EXPECT_LE((body.center_of_mass - Map3(data_->xipos + 3 * id)).norm(), tolerance);
    const Matrix3d axes = MapRows(data_->ximat + 9 * id);
    const Matrix3d inertia = axes * Map3(model_->body_inertia + 3 * id).asDiagonal() * axes.transpose();
    EXPECT_LE((body.inertia - inertia).norm(), inertia_tolerance * inertia.norm());
  }
  EXPECT_EQ(compared, model_->nbody - 1);
}

TEST_P(ReadMujoco, agreesOnJoints) {
  const ModelGraph graph = readModel(file_);
  EXPECT_LE((graph.gravity - Map3(model_->opt.gravity)).norm(), 0);
  int compared = 0;
  for (const GraphJoint& joint : graph.joints) {
    const int id = mj_name2id(model_.get(), mjOBJ_JOINT, joint.name.c_str());
    if (id < 0 || joint.kind == JointKind::free) continue;
    SCOPED_TRACE(joint.name);
    ++compared;
    EXPECT_LE((joint.centre - Map3(data_->xanchor + 3 * id)).norm(), tolerance);
    if (joint.kind != JointKind::ball) {
      EXPECT_LE((joint.axis[0] - Map3(data_->xaxis + 3 * id)).norm(), tolerance);
      EXPECT_NEAR(joint.position, model_->qpos0[model_->jnt_qposadr[id]], tolerance);
      if (model_->jnt_limited[id] != 0) {
        EXPECT_NEAR(joint.lower, model_->jnt_range[2 * id], tolerance);
        EXPECT_NEAR(joint.upper, model_->jnt_range[2 * id + 1], tolerance);
      }
    }
    const int dof = model_->jnt_dofadr[id];
    EXPECT_EQ(joint.damping, model_->dof_damping[dof]);
    EXPECT_EQ(joint.friction, model_->dof_frictionloss[dof]);
    EXPECT_EQ(joint.rotor_inertia, model_->dof_armature[dof]);
    EXPECT_EQ(joint.stiffness, model_->jnt_stiffness[id]);
    const double at_rest = joint.kind == JointKind::ball ? 0 : model_->qpos_spring[model_->jnt_qposadr[id]];
    EXPECT_NEAR(joint.spring_reference, at_rest, tolerance);
    bool driven = false;
    for (int a = 0; a < model_->nu; ++a) driven = driven || model_->actuator_trnid[2 * a] == id;
    EXPECT_EQ(joint.driven, driven);
  }
  EXPECT_GT(compared, 0);
}

/// Welds by relpose, with an anchor in body 2 and a quaternion of any length, and closures of the initial pose; the
/// residuals that MuJoCo has there must be the graph's gaps.
constexpr const char* closures = R"(<mujoco><compiler angle="radian"/><worldbody>
  <body name="a" pos="1 2 3" euler="0.3 0.2 0.1"><joint name="a1"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body>
  <body name="b" pos="-1 0.5 2" euler="-0.3 0.5 0.7"><joint name="b1"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body></worldbody>
  <equality><weld body1="a" body2="b" relpose="0.4 0.5 0.6 2 0.2 0.4 0"/>
    <weld body1="a" body2="b" anchor="0.1 0.2 0.3" relpose="0.4 0.5 0.6 -2 0.2 0.4 0.7"/><weld body1="a" body2="b" anchor="0.1 0.2 0.3"/>
    <weld body1="a" relpose="0.1 0 0 0 1 1 0"/><connect body1="a" body2="b" anchor="1 2 3"/></equality></mujoco>)";

TEST_P(ReadMujoco, agreesOnGaps) {
  const ModelGraph graph = readModel(file_);
  mj_forward(model_.get(), data_.get());
  int row = 0, closure = 0;
  for (const GraphJoint& joint : graph.joints) {
    if (!joint.closure) continue;
    SCOPED_TRACE(closure++);
    ASSERT_LE(row + (joint.kind == JointKind::fixed ? 6 : 3), data_->ne);
    EXPECT_LE((joint.centre - joint.centre_of_child - Map3(data_->efc_pos + row)).norm(), tolerance);
    row += 3;
    if (joint.kind != JointKind::fixed) continue;
    const Matrix3d child = graph.bodies[joint.child].frame.linear();
    const Eigen::Quaterniond turn(Matrix3d(child.transpose() * joint.turn * child));
    const Vector3d of_mujoco = Map3(data_->efc_pos + row);
    EXPECT_LE(std::min((turn.vec() - of_mujoco).norm(), (turn.vec() + of_mujoco).norm()), tolerance);
    row += 3;
  }
  EXPECT_EQ(closure, model_->neq);
  EXPECT_EQ(row, data_->ne);
}

constexpr const char* orientations =
    R"(<mujoco><compiler angle="degree" eulerseq="XzY"/><option gravity="1 2 -3"/><worldbody>
  <body name="a" pos="1 2 3" euler="10 20 30"><joint name="a1" axis="1 2 3" pos="0.1 0 0" ref="25" limited="true" range="-40 50"/>
    <joint name="a2" axis="0 1 1"/><inertial pos="0.1 0.2 0.3" mass="2" diaginertia="0.3 0.4 0.5" euler="5 6 7"/>
    <body name="b" axisangle="1 1 0 40" pos="0 0 1"><joint name="b1" type="slide" axis="0 0 2" ref="0.25" limited="true" range="-1 1"/>
      <inertial pos="0 0 0.1" mass="1" fullinertia="0.5 0.6 0.7 0.01 0.02 0.03"/>
      <body name="c" xyaxes="1 1 0 0 1 1"><joint name="c1" type="ball" pos="0 0.2 0"/><geom type="capsule" fromto="0 0 0 0.3 0.4 0.5" size="0.1"/></body>
      <body name="d" zaxis="0.3 -0.2 -1"><joint name="d1"/><inertial pos="0 0 0" mass="1" diaginertia="1 2 2.5" zaxis="1 2 3"/></body></body></body>
  <body name="e" zaxis="1e-9 0 -1"><joint name="e1"/><inertial pos="0 0 0" mass="1" diaginertia="1 2 2.5"/></body>
  <body name="g" zaxis="1e-6 0 -1"><joint name="g1"/><inertial pos="0 0 0" mass="1" diaginertia="1 2 2.5"/></body>
  <body name="f" zaxis="0 0 -2"><joint name="f1"/><geom type="box" fromto="0 0 1 1e-9 0 2" size="0.1"/></body>
  </worldbody></mujoco>)";

constexpr const char* shapes =
    R"(<mujoco><compiler angle="radian" inertiafromgeom="true" inertiagrouprange="0 2"/><worldbody>
  <body name="a"><joint name="a1"/><inertial pos="1 1 1" mass="99" diaginertia="1 1 1"/>
    <geom type="box" size="0.1 0.2 0.3" pos="0.1 0 0" euler="0.1 0.2 0.3"/><geom type="sphere" size="0.2" mass="3" pos="0 1 0"/>
    <geom type="ellipsoid" size="0.1 0.2 0.3" density="500" quat="1 2 3 4"/><geom type="cylinder" size="0.1 0.4" pos="0 0 1"/>
    <geom type="capsule" size="0.1 0.4" pos="0 0 1" axisangle="1 0 0 0.5"/><geom type="box" size="1 1 1" group="3"/>
    <geom type="sphere" size="1" mass="0"/>
    <body name="b" pos="0 0 1"><joint name="b1" axis="1 0 0"/><geom type="box" fromto="0 0 0 1 1 0" size="0.1"/></body>
    <body name="c" pos="0 0 2"><joint name="c1" axis="1 0 0"/><geom type="cylinder" fromto="0 0 0 0 0 1" size="0.1"/>
      <geom type="ellipsoid" fromto="0 0 1 0 0 0" size="0.1" density="10"/></body></body></worldbody></mujoco>)";

constexpr const char* classes = R"(<mujoco><compiler angle="radian"/>
  <default><joint damping="0.1" axis="0 1 0"/><geom type="capsule" size="0.1 0.2" density="100"/>
    <default class="leg"><joint damping="0.2" armature="0.01" frictionloss="0.5"/>
      <default class="foot"><joint armature="0.02" type="slide"/><geom density="700"/></default></default>
    <default class="other"><joint axis="0 0 1"/></default></default>
  <worldbody><body name="a" childclass="leg"><joint name="a1"/><geom/>
      <body name="b"><joint name="b1" class="foot"/><joint name="b2" damping="7"/><geom class="foot"/>
        <body name="c" childclass="other"><joint name="c1"/><joint name="c2" class="main"/><geom/></body></body></body></worldbody>
  <actuator><motor joint="b1"/><position joint="c1" kp="10"/></actuator></mujoco>)";

constexpr const char* bounds =
    R"(<mujoco><compiler angle="radian" balanceinertia="true" boundmass="0.5" boundinertia="0.02" settotalmass="12"/><worldbody>
  <body name="a"><joint name="a1"/><inertial pos="0 0 0" mass="2" diaginertia="0.3 0.4 0.9"/>
    <body name="b" pos="0 0 1"><joint name="b1"/><inertial pos="0 0 0" mass="0.1" diaginertia="0.001 0.4 0.41"/></body></body>
  <body name="still" pos="1 0 0"><geom type="box" size="0.1 0.1 0.1"/></body></worldbody></mujoco>)";

/// Bodies without numbers, whose raised mass MuJoCo puts at their position once more, and letters of both cases in
/// eulerseq.
constexpr const char* raised =
    R"(<mujoco><compiler angle="radian" boundmass="0.5" boundinertia="0.02" eulerseq="zXy"/><worldbody>
  <body name="a" pos="3 2 1" euler="0.1 0.2 0.3"><joint name="a1"/><inertial pos="0 1 0" mass="1" diaginertia="1 1 1"/><body name="b"><joint name="b1"/></body>
    <body name="c" pos="0.1 0.2 0.3" euler="0.4 0.5 0.6"><joint name="c1"/></body></body></worldbody></mujoco>)";

/// MuJoCo's settings within a URDF; bounds hold for each link before fixed ones are fused.
constexpr const char* urdf =
    R"(<robot name="r"><mujoco><compiler angle="degree" eulerseq="zyx" fusestatic="false" balanceinertia="true" boundmass="0.5" boundinertia="0.02"/>
  <option gravity="1 2 -3"/></mujoco><link name="world"/>
  <link name="a"><inertial><origin xyz="0 0 0.1" rpy="0.3 0.4 0.5"/><mass value="2"/><inertia ixx="0.1" iyy="0.12" izz="0.5" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="a1" type="continuous"><parent link="world"/><child link="a"/><origin xyz="1 2 3" rpy="0.3 0.4 0.5"/><axis xyz="0 0 1"/><dynamics damping="2" friction="3"/></joint>
  <link name="b"/><joint name="b1" type="continuous"><parent link="a"/><child link="b"/><axis xyz="1 0 0"/></joint>
  <link name="c"><inertial><mass value="0.1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="c1" type="prismatic"><parent link="b"/><child link="c"/><axis xyz="0 1 0"/><limit lower="-1" upper="2" effort="1" velocity="1"/></joint></robot>)";

/// Springs in degrees and metres, from defaults and at a ball.
constexpr const char* springs =
    R"(<mujoco><default><joint stiffness="5" springref="20"/></default><worldbody>
  <body name="a" euler="10 20 30"><joint name="a1" ref="25"/><joint name="a2" type="slide" springref="0.5" ref="0.25"/>
    <geom size="0.1"/><body name="b"><joint name="b1" stiffness="0"/><geom size="0.1"/>
      <body name="c"><joint name="c1" type="ball" stiffness="2"/><geom size="0.1"/></body></body></body></worldbody></mujoco>)";

INSTANTIATE_TEST_SUITE_P(, ReadMujoco,
                         testing::Values(orientations, shapes, classes, bounds, raised, urdf, closures, springs));

void expectBodies(const MechanismParameters& machine, const mjModel& model, const mjData& data) {
  for (const char* name : {"f", "a", "b"}) {
    const int id = mj_name2id(&model, mjOBJ_BODY, name);
    const auto body = std::find_if(machine.bodies.begin(), machine.bodies.end(),
                                   [&](const MechanismBody& each) { return each.name == name; });
    ASSERT_NE(body, machine.bodies.end());
    SCOPED_TRACE(name);
    EXPECT_LE((body->frame.translation() - Map3(data.xpos + 3 * id)).norm(), tolerance);
    EXPECT_LE((body->frame.linear() - MapRows(data.xmat + 9 * id)).norm(), tolerance);
    EXPECT_LE((body->center_of_mass - Map3(data.xipos + 3 * id)).norm(), tolerance);
    const Matrix3d axes = MapRows(data.ximat + 9 * id);
    const Matrix3d inertia = axes * Map3(model.body_inertia + 3 * id).asDiagonal() * axes.transpose();
    EXPECT_LE((body->inertia - inertia).norm(), inertia_tolerance * inertia.norm());
  }
}

void expectJoints(const MechanismParameters& machine, const mjModel& model, const mjData& data) {
  for (const MechanismJoint& joint : machine.joints) {
    SCOPED_TRACE(joint.name);
    const int id = mj_name2id(&model, mjOBJ_JOINT, joint.name.c_str());
    if (joint.closure) {
      EXPECT_LE((joint.centre - joint.centre_of_child - Map3(data.efc_pos)).norm(), tolerance);
    } else if (joint.kind == JointKind::revolute || joint.kind == JointKind::prismatic) {
      EXPECT_EQ(joint.position, data.qpos[model.jnt_qposadr[id]]);
      EXPECT_LE((joint.axis[0] - Map3(data.xaxis + 3 * id)).norm(), tolerance);
      EXPECT_LE((joint.centre - Map3(data.xanchor + 3 * id)).cross(joint.axis[0]).norm(), tolerance);
    } else {
      EXPECT_LE((joint.centre - Map3(data.xanchor + 3 * id)).norm(), tolerance);
    }
  }
}

/// Every kind of joint at a keyframe that a weld needs.
TEST(ReadMujocoKeyframe, agreesOnBodies) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "read_mujoco_keyframe.xml";
  std::ofstream(file) << R"(<mujoco><compiler angle="radian"/><worldbody>
  <body name="f" pos="1 2 3" euler="0.1 0.2 0.3"><freejoint name="f1"/><inertial pos="0.1 0 0" mass="1" diaginertia="1 1.2 1.4"/></body>
  <body name="a" pos="-1 0.5 2" euler="-0.3 0.5 0.7"><joint name="a1" axis="1 2 3" pos="0.1 0 0" ref="0.5"/><joint name="a2" type="slide" axis="0 1 1" ref="-1"/>
    <joint name="a3" axis="0 1 1"/><inertial pos="0.1 0.2 0.3" mass="2" diaginertia="0.3 0.4 0.5" euler="5 6 7"/>
    <body name="b" pos="0 0 1" euler="1 0 0"><joint name="b1" type="ball" pos="0 0.2 0"/><inertial pos="0 0 0.1" mass="1" diaginertia="1 1.2 1.4"/></body></body></worldbody>
  <equality><weld body1="a" body2="f" relpose="0.1 0.2 0.3 1 0.1 0 0"/></equality>
  <keyframe><key qpos="-0.9 0.6 2.5 0.7 0.1 0.2 0.3 0.9 -0.6 0.3 0.5 0.6 0.7 0.8"/></keyframe></mujoco>)";
  const std::unique_ptr<mjModel, void (*)(mjModel*)> model(mj_loadXML(file.c_str(), nullptr, nullptr, 0),
                                                           mj_deleteModel);
  ASSERT_TRUE(model);
  const std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(model.get()), mj_deleteData);
  mj_resetDataKeyframe(model.get(), data.get(), 0);
  mj_forward(model.get(), data.get());
  const MechanismParameters machine = readMechanismModel(file, {}).machine;
  expectBodies(machine, *model, *data);
  expectJoints(machine, *model, *data);
}

}  // namespace
}  // namespace ursula::exchange

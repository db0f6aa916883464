// The reader of SDF against libsdformat's, which turns every version into the newest: poses, inertias and axes in the
// model's frame must agree.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sdf/sdf.hh>
#include <string>
#include <tuple>

#include "parts/exchange/import.h"

namespace ursula::exchange {
namespace {

Vector3d of(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }
Matrix3d of(const ignition::math::Quaterniond& q) {
  return Eigen::Quaterniond(q.W(), q.X(), q.Y(), q.Z()).toRotationMatrix();
}

/// A version, and what use_parent_model_frame says there; nothing if empty.
class ReadSdformat : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(ReadSdformat, agrees) {
  const auto& [version, says] = GetParam();
  const bool new_poses = version >= "1.7";
  const std::string flag = says.empty() ? "" : "<use_parent_model_frame>" + says + "</use_parent_model_frame>";
  const std::string text =
      "<sdf version='" + version + "'><model name='m'><pose>1 2 3 0.1 0.2 0.3</pose>" +
      "<link name='a'><pose>0.1 0 0 0.5 0 0</pose></link><link name='b'><pose" + (new_poses ? " relative_to='a'" : "") +
      ">1 0 0 0.3 0.4 0.5</pose><inertial><pose>0.1 0.2 0.3 0.7 0.8 "
      "0.9</pose><mass>2</mass><inertia><ixx>0.3</ixx><iyy>0.4</iyy><izz>0.5</izz><ixy>0.01</ixy><ixz>0.02</"
      "ixz><iyz>0.03</iyz></inertia></inertial></link><joint name='j' type='revolute'><pose>0.1 0 0 0.2 0.3 "
      "0.4</pose><parent>a</parent><child>b</child><axis><xyz>0 0.6 0.8</xyz>" +
      flag + "<limit><lower>-1</lower><upper>2</upper></limit></axis></joint></model></sdf>";
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / ("read_sdformat_" + version + says + ".sdf");
  std::ofstream(file) << text;
  const ModelGraph graph = readModel(file);
  sdf::Root root;
  root.LoadSdfString(text);
  const sdf::Model* model = root.Model();
  ASSERT_NE(model, nullptr);
  const Eigen::Isometry3d M = [&] {
    Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
    out.translation() = of(model->RawPose().Pos());
    out.linear() = of(model->RawPose().Rot());
    return out;
  }();
  const sdf::Link& link = *model->LinkByName("b");
  ignition::math::Pose3d pose;
  ASSERT_TRUE(link.SemanticPose().Resolve(pose, "__model__").empty());
  const GraphBody& body = graph.bodies.at(2);
  EXPECT_LE((body.frame.translation() - M * of(pose.Pos())).norm(), 1e-14);
  EXPECT_LE((body.frame.linear() - M.linear() * of(pose.Rot())).norm(), 1e-14);
  const auto inertial = link.Inertial();
  EXPECT_LE((body.center_of_mass - body.frame * of(inertial.Pose().Pos())).norm(), 1e-14);
  Matrix3d moi;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) moi(i, j) = inertial.Moi()(i, j);  // about the mass centre, in the link's frame
  EXPECT_LE((body.inertia - body.frame.linear() * moi * body.frame.linear().transpose()).norm(), 1e-14);
  const sdf::Joint& joint = *model->JointByName("j");
  ignition::math::Vector3d axis;
  ASSERT_TRUE(joint.Axis(0)->ResolveXyz(axis, "__model__").empty());
  EXPECT_LE((graph.joints.at(0).axis[0] - M.linear() * of(axis)).norm(), 1e-14);
  ASSERT_TRUE(joint.SemanticPose().Resolve(pose, "__model__").empty());
  EXPECT_LE((graph.joints.at(0).centre - M * of(pose.Pos())).norm(), 1e-14);
  EXPECT_EQ(graph.joints.at(0).upper, joint.Axis(0)->Upper());
}

INSTANTIATE_TEST_SUITE_P(, ReadSdformat,
                         testing::Combine(testing::Values("1.4", "1.5", "1.6", "1.7", "1.8", "1.9"),
                                          testing::Values("", "0", "1")));

/// A nested model that is placed by a frame of its own, and a joint whose child is a frame.
TEST(ReadSdformatFrames, agree) {
  const std::string text =
      "<sdf version='1.9'><world name='w'><frame name='floor'><pose>0 0 1 0.2 0 0</pose></frame><model name='m' "
      "placement_frame='f' canonical_link='n::a'><pose relative_to='floor'>1 2 3 0.1 0.2 0.3</pose><frame name='f' "
      "attached_to='n::g'><pose degrees='true'>0 1 0 10 20 30</pose></frame><model name='n'><pose>1 0 0 0.5 0 "
      "0</pose><link name='a'><pose>0 0 1 0 0.4 0</pose></link><frame name='g' attached_to='a'><pose>0.1 0.2 0 0 0 "
      "1</pose></frame></model><link name='b'><pose relative_to='n::g' rotation_format='quat_xyzw'>0 0 2 0.6 0 0 "
      "0.8</pose></link><frame name='h' attached_to='b'><pose>0 0.3 0 1 0 0</pose></frame><joint name='j' "
      "type='revolute'><pose>0 0 0.1 0 0.7 0</pose><parent>n::g</parent><child>h</child><axis><xyz expressed_in='n'>0 "
      "0.6 0.8</xyz></axis></joint></model></world></sdf>";
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "read_sdformat_frames.sdf";
  std::ofstream(file) << text;
  const ModelGraph graph = readModel(file);
  sdf::Root root;
  const sdf::Errors errors = root.LoadSdfString(text);
  ASSERT_TRUE(errors.empty()) << errors[0].Message();
  const sdf::Model& model = *root.WorldByIndex(0)->ModelByIndex(0);
  const auto inWorld = [&](const sdf::SemanticPose& of_it) {
    ignition::math::Pose3d in_model, whole;
    EXPECT_TRUE(of_it.Resolve(in_model, "__model__").empty());
    EXPECT_TRUE(model.SemanticPose().Resolve(whole, "world").empty());
    return whole * in_model;
  };
  ASSERT_EQ(graph.bodies.size(), 3U);
  const auto b = inWorld(model.LinkByName("b")->SemanticPose());
  EXPECT_EQ(graph.bodies[1].name + graph.bodies[2].name, "bn::a");
  const sdf::Joint& joint = *model.JointByName("j");
  const auto j = inWorld(joint.SemanticPose());
  EXPECT_LE((graph.bodies[1].frame.translation() - of(b.Pos())).norm(), 1e-14);
  EXPECT_LE((graph.bodies[1].frame.linear() - of(b.Rot())).norm(), 1e-14);
  EXPECT_LE((graph.joints.at(0).centre - of(j.Pos())).norm(), 1e-14);
  ignition::math::Vector3d axis;
  ASSERT_TRUE(joint.Axis(0)->ResolveXyz(axis).empty());
  EXPECT_LE((graph.joints[0].axis[0] - of(j.Rot()) * of(axis)).norm(), 1e-14);
  EXPECT_EQ(graph.joints[0].parent, 2U);
  EXPECT_EQ(graph.joints[0].child, 1U);
}

}  // namespace
}  // namespace ursula::exchange

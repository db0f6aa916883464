// The reader of SDF against libsdformat's, which turns every version into the newest: poses, inertias and axes in the
// model's frame must agree.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sdf/sdf.hh>
#include <string>

#include "exchange/import.h"

namespace ursula::exchange {
namespace {

Vector3d of(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }
Matrix3d of(const ignition::math::Quaterniond& q) {
  return Eigen::Quaterniond(q.W(), q.X(), q.Y(), q.Z()).toRotationMatrix();
}

class ReadSdformat : public testing::TestWithParam<const char*> {};

TEST_P(ReadSdformat, agrees) {
  const std::string version = GetParam();
  const bool new_poses = version >= "1.7";
  const std::string flag =
      version == "1.5" || version == "1.6" ? "<use_parent_model_frame>1</use_parent_model_frame>" : "";
  const std::string text =
      "<sdf version='" + version + "'><model name='m'><pose>1 2 3 0.1 0.2 0.3</pose>" +
      "<link name='a'><pose>0.1 0 0 0.5 0 0</pose></link><link name='b'><pose" + (new_poses ? " relative_to='a'" : "") +
      ">1 0 0 0.3 0.4 0.5</pose><inertial><pose>0.1 0.2 0.3 0.7 0.8 0.9</pose><mass>2</mass><inertia><ixx>0.3</ixx>"
      "<iyy>0.4</iyy><izz>0.5</izz><ixy>0.01</ixy><ixz>0.02</ixz><iyz>0.03</iyz></inertia></inertial></link>"
      "<joint name='j' type='revolute'><pose>0.1 0 0 0.2 0.3 0.4</pose><parent>a</parent><child>b</child><axis><xyz>0 "
      "0.6 "
      "0.8</xyz>" +
      flag + "<limit><lower>-1</lower><upper>2</upper></limit></axis></joint></model></sdf>";
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / ("read_sdformat_" + version + ".sdf");
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

INSTANTIATE_TEST_SUITE_P(, ReadSdformat, testing::Values("1.4", "1.5", "1.6", "1.7", "1.8", "1.9"));

}  // namespace
}  // namespace ursula::exchange

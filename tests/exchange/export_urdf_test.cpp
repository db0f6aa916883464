// urdfdom takes what was exported without a word, and has the scenario's bodies; the loops meet at the file's pose.

#include <gtest/gtest.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include "tests/exchange/export_support.h"

namespace ursula::exchange {
namespace {

Eigen::Isometry3d poseOf(const urdf::Pose& pose) {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  const urdf::Rotation& q = pose.rotation;
  out.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
  out.translation() << pose.position.x, pose.position.y, pose.position.z;
  return out;
}

class Read {
 public:
  explicit Read(const std::string& text) {
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    model = urdf::parseURDF(text);
    words = testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
  }

  /// With all coordinates at zero.
  Eigen::Isometry3d frame(const std::string& name) const {
    const urdf::LinkConstSharedPtr link = model->getLink(name);
    if (!link->parent_joint) return Eigen::Isometry3d::Identity();
    return frame(link->parent_joint->parent_link_name) * poseOf(link->parent_joint->parent_to_joint_origin_transform);
  }

  SeenBodies bodies() const {
    SeenBodies out;
    for (const auto& [name, link] : model->links_) {
      if (!link->inertial) continue;
      const urdf::Inertial& own = *link->inertial;
      const Eigen::Isometry3d at = frame(name) * poseOf(own.origin);
      Matrix3d inertia;
      inertia << own.ixx, own.ixy, own.ixz, own.ixy, own.iyy, own.iyz, own.ixz, own.iyz, own.izz;
      out[name] = {own.mass, at.translation(), at.linear() * inertia * at.linear().transpose()};
    }
    return out;
  }

  urdf::ModelInterfaceSharedPtr model;
  std::string words;
};

TEST(ExportUrdf, IsReadWithoutAWordAndHasTheBodies) {
  for (const std::string& name : machines()) {
    const Scenario scenario = machine(name);
    const Read read(textOf(scenario, ModelFormat::urdf));
    ASSERT_TRUE(read.model) << name << read.words;
    EXPECT_EQ(read.words, "") << name;
    EXPECT_EQ(read.model->getRoot()->name, "base");
    EXPECT_LE(deviation(read.bodies(), expectedBodies(scenario)), rounding) << name;
  }
}

TEST(ExportUrdf, ATensorThatIsNotTurnedIsSeen) {
  const Scenario scenario = machine("scenarios/full-tensors.toml");
  std::vector<Assumption> notes;
  const Read read(urdfText(withTensorNotTurned(scenario), notes));
  EXPECT_GT(deviation(read.bodies(), expectedBodies(scenario)), 1e-3);
}

TEST(ExportUrdf, ClosingFramesMeet) {
  for (const std::string& name : machines()) {
    const Scenario scenario = machine(name);
    const Read read(textOf(scenario, ModelFormat::urdf));
    for (int leg = 2; leg <= scenario.manipulator->legCount(); ++leg) {
      const std::string frame = "closing_leg_" + std::to_string(leg) + "_ball_";
      ASSERT_TRUE(read.model->getLink(frame + "1") && read.model->getLink(frame + "2")) << name << ' ' << frame;
      const Vector3d at = read.frame(frame + "1").translation(), b = scenario.manipulator->leg(leg - 1).platform_point;
      EXPECT_LT((at - read.frame(frame + "2").translation()).norm(), 1e-12) << name << ' ' << frame;
      EXPECT_LT((read.frame("platform").inverse() * at - b).norm(), 1e-12) << name << ' ' << frame;
    }
  }
}

}  // namespace
}  // namespace ursula::exchange

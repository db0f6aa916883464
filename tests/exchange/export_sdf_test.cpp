// Gazebo's reader takes what was exported without a word, and has the scenario's bodies, joints and loops.

#include <gtest/gtest.h>

#include <algorithm>
#include <ignition/math/Inertial.hh>
#include <sdf/sdf.hh>
#include <set>

#include "parts/exchange/write/export.h"
#include "tests/exchange/export_support.h"

namespace ursula::exchange {
namespace {

Vector3d vectorOf(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

Matrix3d matrixOf(const ignition::math::Matrix3d& m) {
  Matrix3d out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out(i, j) = m(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  return out;
}

class Read {
 public:
  explicit Read(const std::string& text) {
    testing::internal::CaptureStderr();
    for (const sdf::Error& error : root_.LoadSdfString(text)) words += error.Message() + "\n";
    words += testing::internal::GetCapturedStderr();
  }
  const sdf::World& world() const { return *root_.WorldByIndex(0); }
  const sdf::Model& model() const { return *world().ModelByIndex(0); }

  /// `words` gets what the reader says of them.
  SeenBodies bodies() {
    SeenBodies out;
    for (std::uint64_t i = 0; i < model().LinkCount(); ++i) {
      const sdf::Link& link = *model().LinkByIndex(i);
      ignition::math::Pose3d pose;
      for (const sdf::Error& error : link.SemanticPose().Resolve(pose, "__model__")) words += error.Message() + "\n";
      const ignition::math::Inertiald& own = link.Inertial();
      const Matrix3d turned = matrixOf(ignition::math::Matrix3d(pose.Rot()));
      out[link.Name()] = {own.MassMatrix().Mass(), vectorOf(pose.Pos()) + turned * vectorOf(own.Pose().Pos()),
                          turned * matrixOf(own.Moi()) * turned.transpose()};
    }
    return out;
  }

  std::string words;

 private:
  sdf::Root root_;
};

TEST(ExportSdf, IsReadWithoutAWordAndHasTheBodies) {
  for (const std::string& name : machines()) {
    const Scenario scenario = machine(name);
    Read read(textOf(scenario, ModelFormat::sdf));
    ASSERT_EQ(read.words, "") << name;
    EXPECT_LE(deviation(read.bodies(), expectedBodies(scenario)), rounding) << name;
    EXPECT_EQ(read.words, "") << name;
    EXPECT_EQ(vectorOf(read.world().Gravity()), scenario.manipulator->gravity()) << name;
  }
}

TEST(ExportSdf, ATensorThatIsNotTurnedIsSeen) {
  const Scenario scenario = machine("scenarios/full-tensors.toml");
  std::vector<Assumption> notes;
  Read read(sdfText(withTensorNotTurned(scenario), notes));
  EXPECT_GT(deviation(read.bodies(), expectedBodies(scenario)), 1e-3);
}

TEST(ExportSdf, EveryLegEndsInABallOnThePlatform) {
  for (const std::string& name : machines()) {
    const Scenario scenario = machine(name);
    const Read read(textOf(scenario, ModelFormat::sdf));
    std::set<std::string> legs;
    for (std::uint64_t i = 0; i < read.model().JointCount(); ++i) {
      const sdf::Joint& joint = *read.model().JointByIndex(i);
      if (joint.Type() != sdf::JointType::BALL || joint.Name().find("_inner_ball") != std::string::npos) continue;
      EXPECT_EQ(joint.ChildLinkName(), "platform");
      legs.insert(joint.ParentLinkName());
    }
    EXPECT_EQ(static_cast<int>(legs.size()), scenario.manipulator->legCount()) << name;
  }
}

/// Each joint's centre and axes, resolved by the reader, against the graph's.
TEST(ExportSdf, AxesAndCentresAreTheGraphs) {
  for (const std::string& name : machines()) {
    const Scenario scenario = machine(name);
    const Read read(textOf(scenario, ModelFormat::sdf));
    const ModelGraph graph = modelOf(scenario).graph;
    int axes = 0;
    for (std::uint64_t i = 0; i < read.model().JointCount(); ++i) {
      const sdf::Joint& joint = *read.model().JointByIndex(i);
      ignition::math::Pose3d pose;
      ASSERT_TRUE(joint.SemanticPose().Resolve(pose, "__model__").empty());
      for (unsigned k = 0; k < 2 && joint.Axis(k) != nullptr; ++k) {
        ignition::math::Vector3d axis;
        ASSERT_TRUE(joint.Axis(k)->ResolveXyz(axis, "__model__").empty());
        // "leg_1_phi_psi" is leg_1_phi, then leg_1_psi.
        const std::string &all = joint.Name(), first = all.substr(0, all.find('_', 6));
        const std::string wanted = k == 0 ? first : all.substr(0, 6) + all.substr(all.rfind('_') + 1);
        const auto found = std::find_if(graph.joints.begin(), graph.joints.end(),
                                        [&](const GraphJoint& each) { return each.name == wanted; });
        ASSERT_NE(found, graph.joints.end()) << wanted;
        EXPECT_LE((vectorOf(axis) - found->axis[0]).norm(), rounding) << name << ' ' << wanted;
        EXPECT_LE((vectorOf(pose.Pos()) - found->centre).norm(), rounding * 10) << name << ' ' << wanted;
        EXPECT_EQ(joint.Axis(k)->Damping(), found->damping);
        EXPECT_EQ(joint.Axis(k)->Effort() == 0, !found->driven) << wanted;
        ++axes;
      }
    }
    EXPECT_EQ(axes, axesOf(scenario)) << name;
  }
}

}  // namespace
}  // namespace ursula::exchange

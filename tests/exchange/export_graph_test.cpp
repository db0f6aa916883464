// The graph that the writers are given: closed at every leg, with what the scenario has, and refused where a leg
// cannot.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "nocsolver/noc/noc.h"
#include "parts/exchange/leg_pose.h"
#include "parts/exchange/write/export.h"
#include "parts/exchange/write/xml_text.h"
#include "tests/exchange/export_support.h"
#include "tests/exchange/read_mechanism.h"

namespace ursula::exchange {
namespace {

using testing::AllOf, testing::HasSubstr;

/// A link's far end, from its frame alone, is where the next joint is.
TEST(ExportGraph, LegsReachThePlatform) {
  for (const std::string& name : machines()) {
    const Scenario scenario = machine(name);
    const Motion<double> pose = scenario.trajectory->at(0);
    for (int i = 0; i < scenario.manipulator->legCount(); ++i) {
      const Leg& leg = scenario.manipulator->leg(i);
      const Vector3d tip = pose.p + pose.Q * leg.platform_point;
      const LegPose at = legPose(leg, i, tip);
      EXPECT_LT((at.at.links[1] * Vector3d(0, 0, leg.distal.length) - tip).norm(), 1e-14 * 64)
          << name << " leg " << i + 1;
      for (const Matrix3d& axes : {Matrix3d(at.at.links[0].linear()), Matrix3d(at.at.links[1].linear())}) {
        EXPECT_TRUE((axes.transpose() * axes).isIdentity(1e-14)) << name;
        EXPECT_GT(axes.determinant(), 0) << name;
      }
    }
  }
}

/// The angle of a crank before it is brought within half a turn.
double sumOfAngles(const Leg& leg, const Vector3d& tip) {
  const Vector3d k = chainOf(leg).frame.transpose() * (tip - leg.base_point);
  const double l = leg.proximal.length, c = std::sqrt(leg.distal.length * leg.distal.length - k.y() * k.y());
  const double r = std::hypot(k.x(), k.z()), side = leg.knee == Knee::positive ? 1 : -1;
  return std::atan2(-k.x(), k.z()) - side * std::acos((l * l + r * r - c * c) / (2 * l * r));
}

/// Motions of motors that `inverse` writes continue the file's pose: no coordinate is a whole turn off.
TEST(ExportGraph, CoordinatesAreThoseOfInverseAndReadBackSo) {
  int scenarios = 0, beyond_half_a_turn = 0;
  for (const auto& entry : std::filesystem::directory_iterator(URSULA_SOURCE "/scenarios")) {
    if (entry.path().extension() != ".toml") continue;
    const Scenario scenario = readScenario(entry.path());
    const Motion<double> pose = scenario.trajectory->at(0);
    const Noc<double> noc(*scenario.manipulator);
    NocWorkspace<double> work;
    noc.inverseKinematics(pose, work);
    const JointVariables<double> q = noc.angles(work);
    const ModelRead read = mechanismOf("turns.xml", textOf(scenario, ModelFormat::mjcf));
    for (int i = 0; i < scenario.manipulator->legCount(); ++i) {
      const Leg& leg = scenario.manipulator->leg(i);
      if (leg.kind == LegKind::RUS && std::abs(sumOfAngles(leg, pose.p + pose.Q * leg.platform_point)) > M_PI)
        ++beyond_half_a_turn;
      for (const Coordinate coordinate : rowOf(leg.kind).coordinates) {
        if (isInBall(leg, coordinate)) continue;
        const std::string name = fmt::format("leg_{}_{}", i + 1, nameOf(coordinate));
        EXPECT_NEAR(jointOf(read, name).position, q.of(coordinate)(i), 1e-12) << entry.path() << ' ' << name;
      }
    }
    ++scenarios;
  }
  EXPECT_GT(scenarios, 30);
  EXPECT_GT(beyond_half_a_turn, 0) << "or no scenario shows the turn";
}

TEST(ExportGraph, OutOfReachNamesTheLegAndTheNumber) {
  Leg leg = machine("apps/starting/URS.toml").manipulator->leg(2);
  const Vector3d far = leg.base_point + Vector3d(0.5, 0.5, 9);
  for (const LegKind kind : {LegKind::URS, LegKind::UPS, LegKind::RUS, LegKind::PUS}) {
    leg.kind = kind;
    leg.base_axis = Vector3d::UnitX();
    try {
      static_cast<void>(legPose(leg, 2, far));
      ADD_FAILURE() << "kind " << static_cast<int>(kind) << " reached over 9 m";
    } catch (const UnreachablePose& refusal) {
      EXPECT_THAT(refusal.what(), AllOf(HasSubstr("leg 3 "), HasSubstr("expected"), HasSubstr(" m")));
    }
  }
}

TEST(ExportGraph, SingularLegsAreRefused) {
  Leg leg = machine("apps/starting/URS.toml").manipulator->leg(0);
  leg.base_axis = Vector3d::UnitX();
  const double reach = leg.proximal.length + leg.distal.length;
  EXPECT_THROW(legPose(leg, 0, leg.base_point + Vector3d(0, 0, reach)), UnreachablePose);        // stretched
  EXPECT_THROW(legPose(leg, 0, leg.base_point + Vector3d(0.5 * reach, 0, 0)), UnreachablePose);  // on its axis
  EXPECT_NO_THROW(legPose(leg, 0, leg.base_point + Vector3d(0, 0, 0.7 * reach)));
}

TEST(ExportGraph, NothingIsDroppedInSilence) {
  const auto notesOf = [](const char* name, ModelFormat format) {
    std::string out;
    for (const Assumption& note : exportScenario(machine(name), format).notes)
      out += note.where + ": " + note.what + "\n";
    return out;
  };
  EXPECT_THAT(notesOf("scenarios/load-base.toml", ModelFormat::mjcf), HasSubstr("load.force"));
  EXPECT_THAT(notesOf("scenarios/coulomb-friction.toml", ModelFormat::mjcf), HasSubstr("leg_1_phi: Coulomb"));
  EXPECT_THAT(notesOf("scenarios/gravity-sideways.toml", ModelFormat::urdf),
              HasSubstr("URDF has no gravity: but for MuJoCo and an import, set ["));
  EXPECT_THAT(notesOf("apps/starting/UPS.toml", ModelFormat::sdf), HasSubstr("--actuated leg_1_d,leg_2_d"));
}

TEST(ExportGraph, RotorInertiaIsWrittenWhereTheFormatHasIt) {
  MachineModel model = modelOf(machine("apps/starting/UPS.toml"));
  for (GraphJoint& joint : model.graph.joints)
    if (joint.driven) joint.rotor_inertia = 0.375;
  std::vector<Assumption> notes;
  EXPECT_THAT(mjcfText(model, notes), HasSubstr("armature=\"0.375\""));
  EXPECT_TRUE(notes.empty());
  EXPECT_THAT(urdfText(model, notes), HasSubstr("<drake:rotor_inertia value=\"0.375\"/>"));
  notes.clear();
  static_cast<void>(sdfText(model, notes));
  ASSERT_EQ(notes.size(), 7U);  // of each motor, and that there are motors
  EXPECT_THAT(notes.back().what, HasSubstr("rotor inertia"));
  EXPECT_EQ(notes.back().size, 0.375);
}

/// What a rod between two balls will be: a third hinge along it, through another body of no mass.
TEST(ExportGraph, ThreeHingesThroughAPointAreABallInSdf) {
  MachineModel model = modelOf(machine("apps/starting/PUS.toml"));
  ModelGraph& graph = model.graph;
  const auto theta = std::find_if(graph.joints.begin(), graph.joints.end(),
                                  [](const GraphJoint& joint) { return joint.name == "leg_1_theta"; });
  GraphJoint spin = *theta;
  GraphBody frame = graph.bodies[spin.child];
  frame.name = "leg_1_spin_frame";
  frame.mass = 0;
  spin.name = "leg_1_spin";
  spin.axis[0] = frame.frame.linear().col(2);
  spin.parent = theta->child = graph.bodies.size();
  spin.damping = 2;
  graph.joints.push_back(spin);
  graph.bodies.push_back(frame);
  model.own.emplace_back();
  std::vector<Assumption> notes;
  EXPECT_THAT(sdfText(model, notes), HasSubstr("<joint name=\"leg_1_psi_theta_spin\" type=\"ball\">"));
  EXPECT_EQ(notes.back().where, "leg_1_spin");
  EXPECT_THAT(mjcfText(model, notes), HasSubstr("<joint name=\"leg_1_spin\" type=\"hinge\""));
  EXPECT_THAT(urdfText(model, notes), HasSubstr("<link name=\"leg_1_spin_frame\"/>"));
}

TEST(ExportGraph, AnglesReadBackAtEveryPitch) {
  for (const double pitch : {-M_PI_2, -1.5707963, -0.3, 0.0, 0.7, 1.5707963267, M_PI_2})
    for (const double roll : {-3.0, -0.4, 0.0, 1.1})
      for (const double yaw : {-2.2, 0.0, 0.3, 3.1}) {
        const auto turn = [](const Vector3d& rpy) {
          return Matrix3d(Eigen::AngleAxisd(rpy.z(), Vector3d::UnitZ()) *
                          Eigen::AngleAxisd(rpy.y(), Vector3d::UnitY()) *
                          Eigen::AngleAxisd(rpy.x(), Vector3d::UnitX()));
        };
        const Matrix3d rotation = turn({roll, pitch, yaw});
        EXPECT_LT((turn(rollPitchYawOf(rotation)) - rotation).norm(), 1e-15 * 8) << roll << ' ' << pitch << ' ' << yaw;
      }
}

TEST(ExportGraph, ANameThatXmlWouldReadIsWrittenSafely) {
  Scenario scenario = machine("apps/starting/UPS.toml");
  scenario.name = "a<b & \"c\"::d";
  for (const ModelFormat format : {ModelFormat::sdf, ModelFormat::mjcf, ModelFormat::urdf}) {
    const WrittenModel written = exportScenario(scenario, format);
    tinyxml2::XMLDocument document;
    EXPECT_EQ(document.Parse(written.text.c_str()), tinyxml2::XML_SUCCESS);
    EXPECT_THAT(written.text, HasSubstr("\"a_b____c___d\""));
    EXPECT_EQ(written.notes.front().where, "name");
  }
}

}  // namespace
}  // namespace ursula::exchange

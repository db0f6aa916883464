// Compares the reader with a second one, which shares only toml++ with it. Scenarios that differ from their text in any
// kind of number must be caught.

#include "tests/model/second_reading/second_reading.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "tests/base/temporary_folder.h"
#include "tests/model/scenario_text.h"
#include "tests/validation/scenario_files.h"
#include "validation/subject/parameters.h"

namespace ursula {
namespace {

using testing::HasSubstr;

Scenario withMachine(const std::string& name, const std::function<void(ManipulatorParameters&)>& change) {
  Scenario scenario = scenarioOf(name);
  ManipulatorParameters machine = scenario.manipulator->parameters();
  change(machine);
  scenario.manipulator = std::make_shared<const Manipulator>(machine);
  return scenario;
}

TEST(SecondReading, findsNothingWhereNothingWasChanged) {
  const Mismatches check = mismatchesOf(withMachine("coulomb-friction", [](auto&) {}));
  EXPECT_EQ(check.count(), 0) << check.first();
  EXPECT_GT(check.compared(), 100);
}

/// No parameter is zero on the proving ground.
TEST(SecondReading, seesEveryParameterOffByARounding) {
  const Scenario right = scenarioOf("proving-ground");
  for (const Parameter& parameter : allParameters(*right.manipulator)) {
    Scenario wrong = right;
    ManipulatorParameters machine = right.manipulator->parameters();
    parameter.disturb(machine, 2e-15);
    wrong.manipulator = std::make_shared<const Manipulator>(machine);
    const Mismatches check = mismatchesOf(wrong);
    EXPECT_GT(check.count(), 0) << parameter.path;
    EXPECT_THAT(check.first(), HasSubstr(parameter.path.substr(0, parameter.leg < 0 ? 18 : 15))) << parameter.path;
  }
}

TEST(SecondReading, namesTheFirstMismatch) {
  const Mismatches mass = mismatchesOf(withMachine("paper-helix", [](auto& m) { m.platform.mass *= 1 + 1e-15; }));
  EXPECT_EQ(mass.count(), 1);
  EXPECT_THAT(mass.first(), HasSubstr("manipulator.platform.mass is 500.0000000000"));
  EXPECT_THAT(mass.first(), HasSubstr("the file says 500"));
  const Mismatches swapped = mismatchesOf(withMachine("full-tensors", [](auto& m) {
    Matrix3d& I = m.platform.inertia;
    std::swap(I(0, 1), I(0, 2)), std::swap(I(1, 0), I(2, 0));
  }));
  EXPECT_EQ(swapped.count(), 4);
  EXPECT_THAT(swapped.first(), HasSubstr("platform.inertia[2] is 95, the file says -70"));
}

TEST(SecondReading, seesKneesAndDefaultsThatWereNotOverridden) {
  EXPECT_EQ(mismatchesOf(withMachine("knees-mixed", [](auto& m) { m.legs[1].knee = m.legs[0].knee; })).count() +
                mismatchesOf(withMachine("knees-mixed", [](auto& m) { m.legs[0].knee = m.legs[1].knee; })).count(),
            mismatchesOf(scenarioOf("knees-mixed")).count() + 2);
  const Mismatches inertia = mismatchesOf(
      withMachine("full-tensors", [](auto& m) { m.legs[1].proximal.inertia = m.legs[0].proximal.inertia; }));
  EXPECT_GT(inertia.count(), 0);
  EXPECT_THAT(inertia.first(), HasSubstr("leg[2].proximal.inertia"));
}

std::string trajectoryText(const std::string& keys) {
  return good_scenario.substr(0, good_scenario.find("[trajectory]")) + "[trajectory]\n" + keys;
}

TEST(SecondReading, readsDegreesByItself) {
  for (const char* rpy :
       {"[10.3, -20.7, 33.1]", "[0, 0, 180]", "[180, 0, 0]", "[90, 90, -170]", "[-179.9, 12, 0.001]"}) {
    const std::string pose = "{ time = 0, position = [0, 0, 1], rpy_deg = " + std::string(rpy) + " }";
    const std::string end = "{ time = 2, position = [0, 0.1, 1], rpy_deg = " + std::string(rpy) + " }";
    const Mismatches check = mismatchesOf(
        parseScenario(trajectoryText("kind = \"waypoints\"\npoints = [" + pose + ", " + end + "]\n"), "a.toml"));
    EXPECT_EQ(check.count(), 0) << rpy << check.first();
  }
  const std::string helix = "kind = \"helix\"\nduration = 3\nradius = 0.2\npitch = 1.2\n";
  const Scenario scenario = parseScenario(
      trajectoryText(helix +
                     "start_angle_deg = -91.3\nend_angle_deg = -60.7\nphase_deg = 0.1\nheight_phase_deg = 126.3\n"),
      "a.toml");
  EXPECT_EQ(mismatchesOf(scenario).count(), 0) << mismatchesOf(scenario).first();
  Scenario wrong = scenario;
  wrong.trajectory =
      parseScenario(trajectoryText(helix + "start_angle = -91.3\nend_angle_deg = -60.7\n"), "a.toml").trajectory;
  EXPECT_GT(mismatchesOf(wrong).count(), 0);
}

Scenario withTrajectory(const std::string& name, std::shared_ptr<const Trajectory> trajectory) {
  Scenario scenario = scenarioOf(name);
  scenario.trajectory = std::move(trajectory);
  return scenario;
}

TEST(SecondReading, seesEveryNumberOfAHelixOffByARounding) {
  const Scenario right = scenarioOf("paper-helix");
  const HelixParameters helix = asWritten(right).trajectory.helix;
  ASSERT_EQ(mismatchesOf(withTrajectory("paper-helix", makeHelix(helix))).count(), 0);
  for (double HelixParameters::*number :
       {&HelixParameters::duration, &HelixParameters::radius, &HelixParameters::pitch, &HelixParameters::start_angle,
        &HelixParameters::end_angle, &HelixParameters::phase, &HelixParameters::height_phase,
        &HelixParameters::start_rate, &HelixParameters::end_rate, &HelixParameters::start_acceleration,
        &HelixParameters::end_acceleration}) {
    HelixParameters wrong = helix;
    wrong.*number = wrong.*number * (1 + 1e-15) + (wrong.*number == 0 ? 1e-15 : 0);
    EXPECT_GT(mismatchesOf(withTrajectory("paper-helix", makeHelix(wrong))).count(), 0);
  }
}

TEST(SecondReading, seesPosesThatAreNotTheFiles) {
  const std::vector<TimedPose> points = asWritten(scenarioOf("waypoints")).trajectory.poses;
  ASSERT_EQ(mismatchesOf(withTrajectory("waypoints", makeWaypoints(points))).count(), 0);
  const auto why = [&](const std::function<void(std::vector<TimedPose>&)>& change) {
    std::vector<TimedPose> wrong = points;
    change(wrong);
    const Mismatches check = mismatchesOf(withTrajectory("waypoints", makeWaypoints(wrong)));
    EXPECT_GT(check.count(), 0);
    return check.first();
  };
  EXPECT_THAT(why([](auto& p) { p[2].position.y() *= 1 + 1e-15; }), HasSubstr("pose 3.position"));
  EXPECT_THAT(why([](auto& p) { p[4].orientation.z() *= 1 + 1e-14; }), HasSubstr("pose 5.orientation"));
  EXPECT_THAT(why([](auto& p) { p[1].time *= 1 + 1e-15; }), HasSubstr("pose 2.time"));
  EXPECT_THAT(why([](auto& p) {
                for (TimedPose& pose : p) {
                  const Eigen::Vector4d q = pose.orientation;
                  pose.orientation << q(1), q(2), q(3), q(0);  // read as [x, y, z, w]
                }
              }),
              HasSubstr("pose 1.orientation"));
  EXPECT_THAT(why([](auto& p) { p.pop_back(); }), HasSubstr("the number of poses is 4, the file says 5"));
}

TEST(SecondReading, seesAHoldAndSamplesThatAreNotTheFiles) {
  const TrajectoryAsWritten hold = asWritten(scenarioOf("hold")).trajectory;
  const TimedPose& pose = hold.poses.front();
  const auto held = [&](const Vector3d& p, double duration) {
    return mismatchesOf(withTrajectory("hold", makeHold(p, pose.orientation, duration))).count();
  };
  EXPECT_EQ(held(pose.position, hold.duration), 0);
  EXPECT_GT(held(pose.position * (1 + 1e-15), hold.duration), 0);
  EXPECT_GT(held(pose.position, hold.duration * (1 + 1e-15)), 0);
  std::vector<TimedPose> samples = asWritten(scenarioOf("samples")).trajectory.poses;
  ASSERT_EQ(samples.size(), 41u);
  EXPECT_EQ(mismatchesOf(withTrajectory("samples", makeSamples(samples))).count(), 0);
  samples[17].position.x() *= 1 + 1e-15;
  EXPECT_THAT(mismatchesOf(withTrajectory("samples", makeSamples(samples))).first(), HasSubstr("pose 18.position"));
}

/// Of more than 60 poses most are compared in doubles.
TEST(SecondReading, holdsEveryOneOfManySamples) {
  const TemporaryFolder folder;
  std::string table = "t_s,p_x_m,p_y_m,p_z_m,q_w,q_x,q_y,q_z\n";
  std::vector<TimedPose> poses;
  for (int i = 0; i < 200; ++i) {
    const double t = i / 64.0, z = 1 + t / 8;
    table += std::to_string(t) + ",0.125,0," + fmt::format("{:.17g}", z) + ",1,0,0,0\n";
    poses.push_back({std::stod(std::to_string(t)), {0.125, 0, z}, {1, 0, 0, 0}});
  }
  folder.write("many.csv", table);
  const std::string text = good_scenario.substr(0, good_scenario.find("[trajectory]")) +
                           "[trajectory]\nkind = \"samples\"\nfile = \"many.csv\"\n";
  Scenario scenario = parseScenario(text, folder.path() / "a.toml");
  EXPECT_EQ(mismatchesOf(scenario).count(), 0) << mismatchesOf(scenario).first();
  poses[101].position.z() *= 1 + 1e-15;
  scenario.trajectory = makeSamples(poses);
  EXPECT_THAT(mismatchesOf(scenario).first(), HasSubstr("pose 102.position"));
}

TEST(SecondReading, seesLoadsThatAreNotTheFiles) {
  const auto changed = [](const std::string& name, const std::function<void(Load&)>& change) {
    Scenario scenario = scenarioOf(name);
    auto load = std::make_shared<Load>(*scenario.load);
    change(*load);
    scenario.load = load;
    return mismatchesOf(scenario).first();
  };
  EXPECT_THAT(changed("load-base", [](Load& l) { l.force.x() *= 1 + 1e-15; }), HasSubstr("load.force[1]"));
  EXPECT_THAT(changed("load-base", [](Load& l) { std::swap(l.force, l.moment); }), HasSubstr("load.force[1]"));
  EXPECT_THAT(changed("load-base", [](Load& l) { l.frame = Load::Frame::platform; }), HasSubstr("load.frame"));
  EXPECT_THAT(changed("load-platform", [](Load& l) { l.point.z() += 1e-15; }), HasSubstr("load.point[3]"));
  std::vector<TimedWrench> rows = asWritten(scenarioOf("load-table")).load->rows;
  ASSERT_EQ(rows.size(), 5u);
  rows[2].wrench.moment.y() *= 1 + 1e-15;
  EXPECT_THAT(changed("load-table", [&](Load& l) { l.history = std::make_shared<const LoadHistory>(rows); }),
              HasSubstr("load.table[3].moment[2]"));
  Scenario without = scenarioOf("load-base");
  without.load = nullptr;
  EXPECT_THAT(mismatchesOf(without).first(), HasSubstr("load is 'none', the file says 'given'"));
}

Scenario startingScenario(const std::string& kind) {
  return readScenario(std::string(URSULA_SCENARIOS) + "/../apps/starting/" + kind + ".toml");
}

TEST(SecondReading, readsLegsOfEveryKind) {
  for (const char* kind : {"URS", "UPS", "RUS", "PUS"})
    EXPECT_EQ(mismatchesOf(startingScenario(kind)).count(), 0) << kind << mismatchesOf(startingScenario(kind)).first();
  const auto changed = [](const std::function<void(Leg&)>& change) {
    Scenario scenario = startingScenario("UPS");
    ManipulatorParameters machine = scenario.manipulator->parameters();
    change(machine.legs[3]);
    scenario.manipulator = std::make_shared<const Manipulator>(machine);
    return mismatchesOf(scenario).first();
  };
  EXPECT_THAT(changed([](Leg& leg) {
                leg.actuated = {true, false, false};
              }),
              HasSubstr("manipulator.leg[4].actuated is '100', the file says '001'"));
  EXPECT_THAT(changed([](Leg& leg) { leg.kind = LegKind::URS; }),
              HasSubstr("manipulator.leg[4].kind is 'URS', the file says 'UPS'"));
  EXPECT_THAT(changed([](Leg& leg) { leg.friction.d = 1; }), HasSubstr("manipulator.leg[4].friction.d is 1"));
  EXPECT_THAT(changed([](Leg& leg) { leg.coulomb.sliding_speed = 1; }), HasSubstr("coulomb.smoothing_speed is 1"));
}

TEST(SecondReading, readsFrictionByEitherName) {
  const auto with = [](const std::string& friction, const std::string& of_leg_1) {
    std::string text = replaced(good_scenario, "[[manipulator.leg]]\n", "[[manipulator.leg]]\n" + of_leg_1 + "\n");
    text = replaced(text, "[manipulator.leg_defaults]\n", "[manipulator.leg_defaults]\ncoulomb = " + friction + "\n");
    return parseScenario(text, "a.toml");
  };
  const Scenario mixed = with("{ phi = 1.5, universal = 2.5, d = 0.0 }", "coulomb = { actuated = 3.5, theta = 0.5 }");
  EXPECT_EQ(mixed.manipulator->leg(0).coulomb.phi, 3.5);
  EXPECT_EQ(mixed.manipulator->leg(1).coulomb.psi, 2.5);
  EXPECT_EQ(mismatchesOf(mixed).count(), 0) << mismatchesOf(mixed).first();
}

TEST(SecondReading, readsTheTablesBesideTheFile) {
  const TemporaryFolder folder;
  folder.write(
      "load.csv",
      "t_s,f_x_N,f_y_N,f_z_N,m_x_Nm,m_y_Nm,m_z_Nm\n0,0,0,-0,0,0,0\r\n1.5, 10 ,0,-300.25,0,7,0\n3,0,0,0,0,0,1\n");
  const std::string text = std::string(good_scenario) + "\n[load]\nfile = \"load.csv\"\n";
  const Scenario scenario = parseScenario(text, folder.path() / "a.toml");
  EXPECT_EQ(mismatchesOf(scenario).count(), 0) << mismatchesOf(scenario).first();
  folder.write("load.csv",
               "t_s,f_x_N,f_y_N,f_z_N,m_x_Nm,m_y_Nm,m_z_Nm\n0,0,0,0,0,0,0\n1.5,10,0,-300.5,0,7,0\n3,0,0,0,0,0,1\n");
  EXPECT_THAT(mismatchesOf(scenario).first(), HasSubstr("load.table[2].force[3] is -300.25, the file says -300.5"));
}

}  // namespace
}  // namespace ursula

// [trajectory] and [load] of a scenario: the meaning of each kind, and every refusal. An @ marks the place.

#include "model/scenario.h"
#include "tests/base/temporary_folder.h"
#include "tests/model/refusals.h"
#include "tests/model/scenario_text.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

/// The good scenario with these tables instead of its trajectory.
std::string with(const std::string& tables) {
  return good_scenario.substr(0, good_scenario.find("[trajectory]")) + tables;
}

std::string withLoad(const std::string& keys) { return good_scenario + "[load]\n" + keys; }

const std::string two_points =
    "[trajectory]\nkind = \"waypoints\"\npoints = [\n"
    "  { time = 0, position = [0, 0, 1], orientation = [1, 0, 0, 0] },\n"
    "  { time = 2.5, position = [0, 0.1, 1.1], orientation = [0.8, 0, 0, 0.6] },\n]\n";

TEST(ScenarioTrajectory, readsHelixOptions) {
  const std::string options =
      "phase = 0.5\nstart_rate = 0.25\nend_rate = -0.5\nstart_acceleration = 2\n"
      "end_acceleration = -3\nheight_phase = 2.2";
  const Scenario scenario = parseScenario(replaced(good_scenario, "height_phase = 2.2", options), "a.toml");
  EXPECT_NEAR(scenario.trajectory->at(0.0).p.x(), 0.2 * std::cos(-1.5707963267948966 + 0.5), 1e-15);
  EXPECT_NEAR(scenario.trajectory->at(0.0).omega.z(), 0.25, 1e-15);
  EXPECT_NEAR(scenario.trajectory->at(3.0).omega.z(), -0.5, 1e-13);
  EXPECT_NEAR(scenario.trajectory->at(0.0).omega_dot.z(), 2, 1e-13);
  EXPECT_NEAR(scenario.trajectory->at(3.0).omega_dot.z(), -3, 1e-13);
  EXPECT_NEAR(parseScenario(replaced(good_scenario, "height_phase = 2.2", ""), "a.toml").trajectory->at(0.0).p.z(),
              1.2 * -1.5707963267948966, 1e-15);
}

TEST(ScenarioTrajectory, readsWaypoints) {
  const Scenario scenario = parseScenario(with(two_points), "a.toml");
  EXPECT_EQ(scenario.trajectory->kind(), "waypoints");
  EXPECT_EQ(scenario.trajectory->duration(), 2.5);
  EXPECT_LE((scenario.trajectory->at(2.5).p - Vector3d(0, 0.1, 1.1)).norm(), 1e-15);
  EXPECT_NEAR(scenario.trajectory->at(2.5).Q(1, 0), 0.96, 1e-15);
}

TEST(ScenarioTrajectory, readsHold) {
  const std::string hold =
      "[trajectory]\nkind = \"hold\"\nposition = [0, 0.5, 1]\norientation = [0, 1, 0, 0]\nduration = 2\n";
  const Scenario scenario = parseScenario(with(hold), "a.toml");
  EXPECT_EQ(scenario.trajectory->kind(), "hold");
  EXPECT_EQ(scenario.trajectory->at(1.0).p, Vector3d(0, 0.5, 1));
  EXPECT_EQ(scenario.trajectory->at(1.0).Q, Matrix3d(Vector3d(1, -1, -1).asDiagonal()));
}

std::string poses(int count) {
  std::string text = "t_s,p_x_m,p_y_m,p_z_m,q_w,q_x,q_y,q_z\n";
  for (int i = 0; i < count; ++i) text += std::to_string(i) + ",0.25," + std::to_string(i * i) + ",1,1,0,0,0\n";
  return text;
}

TEST(ScenarioTrajectory, readsSamplesFromTheScenariosOwnFolder) {
  const TemporaryFolder folder;
  folder.write("pose.csv", poses(7));
  const auto file = folder.write("a.toml", with("[trajectory]\nkind = \"samples\"\nfile = \"pose.csv\"\n"));
  const Scenario scenario = readScenario(file);
  EXPECT_EQ(scenario.trajectory->kind(), "samples");
  EXPECT_EQ(scenario.trajectory->duration(), 6);
  EXPECT_NEAR(scenario.trajectory->at(2.5).p.y(), 6.25, 1e-13);
}

TEST(ScenarioTrajectory, refusesBadSamplesAtTheirLine) {
  const TemporaryFolder folder;
  folder.write("pose.csv", replaced(poses(7), "\n3,", "\n2,"));
  const auto file = folder.write("a.toml", with("[trajectory]\nkind = \"samples\"\nfile = \"pose.csv\"\n"));
  EXPECT_THAT(refusal<ScenarioError>([&] { readScenario(file); }),
              EndsWith("pose.csv:5: error: time: 2, expected > 2, the time before"));
}

TEST(ScenarioTrajectory, refusesAKindThatIsNone) {
  EXPECT_EQ(refusalAtMark(replaced(good_scenario, "\"helix\"", "@\"helx\"")),
            "trajectory.kind: 'helx', expected 'helix', 'waypoints', 'samples' or 'hold', did you mean 'helix'?");
  EXPECT_EQ(refusalAtMark(with("@[trajectory]\nduration = 3\n")),
            "missing key 'kind' in trajectory, expected 'helix', 'waypoints', 'samples' or 'hold'");
}

TEST(ScenarioTrajectory, refusesKeysOfAnotherKind) {
  EXPECT_THAT(refusalAtMark(replaced(good_scenario, "pitch = 1.2", "pitch = 1.2\n@points = []")),
              HasSubstr("unknown key 'points' in trajectory, expected 'kind', 'duration', 'radius'"));
  EXPECT_EQ(refusalAtMark(with(replaced(two_points, "points = [", "@duration = 3\npoints = ["))),
            "unknown key 'duration' in trajectory, expected 'kind' or 'points'");
}

TEST(ScenarioTrajectory, refusesImpossibleValuesAtTheirKeys) {
  EXPECT_EQ(refusalAtMark(replaced(good_scenario, "radius = 0.2", "radius = @-0.2")),
            "trajectory.radius: -0.2, expected > 0");
  EXPECT_EQ(refusalAtMark(replaced(good_scenario, "pitch = 1.2", "pitch = @0")), "trajectory.pitch: 0, expected not 0");
  EXPECT_EQ(refusalAtMark(with(replaced(two_points, "time = 2.5", "time = @0"))),
            "trajectory.points[2].time: 0, expected > 0, the time before");
  EXPECT_EQ(refusalAtMark(with(replaced(two_points, "[0.8, 0, 0, 0.6]", "@[0.8, 0, 0, 0.7]"))).substr(0, 44),
            "trajectory.points[2].orientation: a quaterni");
  EXPECT_EQ(refusalAtMark(with("[trajectory]\nkind = \"waypoints\"\npoints = @[]\n")),
            "trajectory.points: 0 poses, expected >= 2");
}

TEST(ScenarioTrajectory, refusesMissingAndMistypedKeys) {
  EXPECT_EQ(refusalAtMark(with("@[trajectory]\nkind = \"waypoints\"\n")),
            "missing key 'points' in trajectory, expected an array of tables { time, position, orientation }");
  EXPECT_EQ(refusalAtMark(with(replaced(two_points, "{ time = 0,", "@{"))),
            "missing key 'time' in trajectory.points[1], expected a number");
  EXPECT_EQ(refusalAtMark(with(replaced(two_points, "orientation", "@orientaton"))),
            "unknown key 'orientaton' in trajectory.points[1], expected 'time', 'position', 'orientation' or "
            "'rpy_deg', did you mean 'orientation'?");
  EXPECT_EQ(refusalAtMark(with("[trajectory]\nkind = \"waypoints\"\npoints = [@3]\n")),
            "trajectory.points[1]: an integer, expected a table");
  EXPECT_EQ(refusalAtMark(with("[trajectory]\nkind = \"waypoints\"\npoints = @3\n")),
            "trajectory.points: an integer, expected an array of tables");
  EXPECT_EQ(refusalAtMark(with("@[trajectory]\nkind = \"samples\"\n")),
            "missing key 'file' in trajectory, expected a string");
  EXPECT_EQ(refusalAtMark(with("[trajectory]\nkind = \"samples\"\nfile = @\"none.csv\"\n"), "nowhere/a.toml"),
            "trajectory.file: 'nowhere/none.csv', expected a CSV file");
  EXPECT_EQ(refusalAtMark(with("@[trajectory]\nkind = \"hold\"\nposition = [0, 0, 1]\norientation = [1, 0, 0, 0]\n")),
            "missing key 'duration' in trajectory, expected a number");
}

TEST(ScenarioLoad, readsAConstantLoad) {
  const Scenario scenario = parseScenario(
      withLoad("force = [1, 2, 3]\nmoment = [4, 5, 6]\npoint = [0, 0, 0.5]\nframe = \"platform\"\n"), "a.toml");
  ASSERT_NE(scenario.load, nullptr);
  EXPECT_EQ(scenario.load->at(1.0).force, Vector3d(1, 2, 3));
  EXPECT_EQ(scenario.load->at(1.0).moment, Vector3d(4, 5, 6));
  EXPECT_EQ(scenario.load->point, Vector3d(0, 0, 0.5));
  EXPECT_EQ(scenario.load->frame, Load::Frame::platform);
  const Scenario bare = parseScenario(withLoad("force = [1, 2, 3]\n"), "a.toml");
  EXPECT_EQ(bare.load->frame, Load::Frame::base);
  EXPECT_EQ(bare.load->at(0.0).moment, Vector3d(0, 0, 0));
  EXPECT_EQ(bare.load->point, Vector3d(0, 0, 0));
}

TEST(ScenarioLoad, readsATable) {
  const Scenario scenario = parseScenario(
      withLoad("table = [{ time = 0, force = [1, 0, 0] }, { time = 2, force = [3, 0, 0], moment = [0, 0, 1] }]\n"),
      "a.toml");
  EXPECT_EQ(scenario.load->at(0.0).force, Vector3d(1, 0, 0));
  EXPECT_NEAR(scenario.load->at(1.0).force.x(), 2, 1e-15);
  EXPECT_EQ(scenario.load->at(9.0).moment, Vector3d(0, 0, 1));
}

TEST(ScenarioLoad, readsAFileBesideTheScenario) {
  const TemporaryFolder folder;
  folder.write("load.csv", "t_s,f_x_N,f_y_N,f_z_N,m_x_Nm,m_y_Nm,m_z_Nm\n0,1,2,3,4,5,6\n1,7,8,9,10,11,12\n");
  const Scenario scenario = readScenario(folder.write("a.toml", withLoad("file = \"load.csv\"\n")));
  EXPECT_EQ(scenario.load->at(0.0).force, Vector3d(1, 2, 3));
  EXPECT_EQ(scenario.load->at(1.0).moment, Vector3d(10, 11, 12));
  folder.write("load.csv", "t_s,f_x_N,f_y_N,f_z_N,m_x_Nm,m_y_Nm,m_z_Nm\n0,1,2,3,4,5,6\n0,7,8,9,10,11,12\n");
  EXPECT_THAT(refusal<ScenarioError>([&] { readScenario(folder.path() / "a.toml"); }),
              EndsWith("load.csv:3: error: time 0, expected > 0, the time before"));
  folder.write("load.csv", "t_s,f_x_N,f_y_N,f_z_N,m_x_Nm,m_y_Nm,m_z_Nm\n0,1,2,3,4,5,6\n");
  EXPECT_THAT(refusal<ScenarioError>([&] { readScenario(folder.path() / "a.toml"); }),
              EndsWith("load.csv:2: error: 1 row, expected >= 2"));
}

TEST(ScenarioLoad, refusesWhatIsNoLoad) {
  const auto load = [](const std::string& keys) { return refusalAtMark(good_scenario + keys); };
  EXPECT_EQ(load("@[load]\npoint = [0, 0, 0]\n"), "load: no load, expected one of: force and moment, a file, a table");
  EXPECT_EQ(load("@[load]\nforce = [0, 0, 0]\nfile = \"a\"\n"),
            "load: more than one description of the load, expected one of: force and moment, a file, a table");
  EXPECT_EQ(load("[load]\n@forse = [0, 0, 0]\n"),
            "unknown key 'forse' in load, expected 'force', 'moment', 'point', 'frame', 'file' or 'table', did you "
            "mean 'force'?");
  EXPECT_EQ(load("[load]\nforce = [0, @inf, 0]\n"), "load.force[2]: inf, expected a finite number");
  EXPECT_EQ(load("[load]\nforce = [0, 0, 0]\nframe = @\"bas\"\n"),
            "load.frame: 'bas', expected 'base' or 'platform', did you mean 'base'?");
  EXPECT_EQ(load("[load]\ntable = [{ time = 0 }, { time = @0 }]\n"),
            "load.table[2].time: 0, expected > 0, the time before");
  EXPECT_EQ(load("[load]\ntable = @[{ time = 0 }]\n"), "load.table: 1 row, expected >= 2");
  EXPECT_EQ(load("[load]\ntable = [{ time = 0, @wrench = 1 }]\n"),
            "unknown key 'wrench' in load.table[1], expected 'time', 'force' or 'moment'");
  EXPECT_EQ(load("[load]\nfile = @\"\"\n"), "load.file: an empty path, expected a file");
  EXPECT_EQ(load("[load]\nfile = @\"a\\u0000.csv\"\n"), "load.file: a path with a zero byte, expected one without");
}

}  // namespace
}  // namespace ursula

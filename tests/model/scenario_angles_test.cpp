// Angles in degrees, for keys that say so.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <Eigen/Geometry>

#include "model/quaternions.h"
#include "model/scenario.h"
#include "tests/model/refusals.h"
#include "tests/model/scenario_text.h"

namespace ursula {
namespace {

std::string hold(const std::string& orientation) {
  return good_scenario.substr(0, good_scenario.find("[trajectory]")) +
         "[trajectory]\nkind = \"hold\"\nposition = [0, 0, 1]\nduration = 1\n" + orientation + "\n";
}

Matrix3d orientationOf(const std::string& line) { return parseScenario(hold(line), "a.toml").trajectory->at(0.0).Q; }

TEST(ScenarioAngles, degreesAreTheNearestDoubles) {
  EXPECT_EQ(radians(90), 1.5707963267948966);
  EXPECT_EQ(radians(-60), -1.04719755119659774615421446);
  EXPECT_EQ(radians(12.5), 0.218166156499291197114115);
  EXPECT_EQ(radians(0), 0);
}

TEST(ScenarioAngles, aHelixInDegreesIsTheSameMotion) {
  std::string text = replaced(good_scenario, "start_angle = -1.5707963267948966", "start_angle_deg = -90");
  text = replaced(text, "end_angle = -1.0471975511965976", "end_angle_deg = -60\nphase_deg = 0");
  const Scenario a = parseScenario(good_scenario, "a.toml"), b = parseScenario(text, "a.toml");
  // The end angle in radians is rounded in its last digit, and β adds terms of up to 31 times the rise.
  constexpr double rounding = 31 * 2.3e-16;
  for (double t : {0.0, 1.1, 3.0}) {
    EXPECT_LE((a.trajectory->at(t).p - b.trajectory->at(t).p).norm(), rounding);
    EXPECT_LE((a.trajectory->at(t).Q - b.trajectory->at(t).Q).norm(), rounding);
  }
}

TEST(ScenarioAngles, rollPitchAndYawTurnAboutFixedAxes) {
  const auto turn = [](double degrees, const Vector3d& axis) { return Eigen::AngleAxisd(radians(degrees), axis); };
  for (const Vector3d& rpy : {Vector3d(10.3, -20.7, 33.1), Vector3d(0, 0, 180), Vector3d(180, 0, 0),
                              Vector3d(90, 90, -170), Vector3d(-179.9, 12, 0.001)}) {
    const auto roll = turn(rpy.x(), Vector3d::UnitX()), pitch = turn(rpy.y(), Vector3d::UnitY()),
               yaw = turn(rpy.z(), Vector3d::UnitZ());
    const Matrix3d read = orientationOf(fmt::format("rpy_deg = [{}, {}, {}]", rpy.x(), rpy.y(), rpy.z()));
    EXPECT_LE((read - (yaw * pitch * roll).toRotationMatrix()).norm(), 1e-15);
    const bool about_one_axis = (rpy.array() == 0).count() == 2;
    EXPECT_TRUE(about_one_axis || (read - (roll * pitch * yaw).toRotationMatrix()).norm() > 1e-3) << "another order";
  }
  EXPECT_EQ(orientationOf("rpy_deg = [0, 0, 180]"), Matrix3d(Vector3d(-1, -1, 1).asDiagonal()));
}

TEST(ScenarioAngles, bothFormsAreRefused) {
  EXPECT_EQ(refusalAtMark(good_scenario + "start_angle_deg = @-90\n"),
            "trajectory.start_angle_deg: given beside 'start_angle', expected one of the two");
  EXPECT_EQ(refusalAtMark(hold("orientation = [1, 0, 0, 0]\nrpy_deg = @[0, 0, 0]")),
            "trajectory.rpy_deg: given beside 'orientation', expected one of the two");
  EXPECT_EQ(refusalAtMark(replaced(hold(""), "[trajectory]", "@[trajectory]")),
            "missing key 'orientation' in trajectory, expected an array of 4 numbers, or 'rpy_deg', an array of 3");
  const std::string no_end = replaced(good_scenario, "end_angle = -1.0471975511965976", "");
  EXPECT_EQ(refusalAtMark(replaced(no_end, "[trajectory]", "@[trajectory]")),
            "missing key 'end_angle' in trajectory, expected a number, rad, or 'end_angle_deg' in degrees");
}

}  // namespace
}  // namespace ursula

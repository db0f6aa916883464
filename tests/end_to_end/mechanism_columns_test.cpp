// How --map names the columns of a mechanism's motion and efforts.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/csv.h"
#include "tests/end_to_end/program.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

/// The delta's motion and efforts under a log's own names, in ms and degrees.
class MechanismColumns : public testing::Test {
 protected:
  MechanismColumns() {
    for (const std::string file : {"delta.toml", "delta.xml"})
      ursula_.write(file, TemporaryFolder::read(std::string(URSULA_VECTORS "/loops/") + file));
    const std::string text = ursula_.read("delta.toml");
    ursula_.write("own.toml",
                  text.substr(0, text.find("[trajectory]")) + "[trajectory]\nkind = \"samples\"\nfile = \"own.csv\"\n");
    ursula_.passing("inverse delta.toml --samples 201 --out motion.csv");
    const CsvTable motion = read("motion.csv");
    const auto scaled = [&](const std::string& name, double factor) {
      std::vector<double> out = motion.at(name);
      for (double& each : out) each *= factor;
      return out;
    };
    const double degrees = 180 / std::acos(-1.0);
    const std::vector<double> clock = scaled("t_s", 1000);
    ursula_.write("own.csv", csvText({"Clock", "enc A", "enc B", "enc C", "q_2_rad"},
                                     {clock, scaled("q_1_rad", degrees), scaled("q_2_rad", degrees),
                                      scaled("q_3_rad", degrees), clock}));
    ursula_.write("efforts.csv", csvText({"Clock", "cur A", "cur B", "cur C"},
                                         {clock, motion.at("tau_1_Nm"), motion.at("tau_2_Nm"), motion.at("tau_3_Nm")}));
  }
  CsvTable read(const std::string& file) const { return readCsv(ursula_.folder() / file); }

  const Program ursula_;
  const std::string time_ = " --map t_ms=Clock",
                    motion_ = time_ + " --map q_1_deg='enc A' --map q_2_deg='enc B' --map arm2_motor_deg='enc C'",
                    efforts_ = " --map tau_1_Nm='cur A' --map tau_2_Nm='cur B' --map tau_3_Nm='cur C'";
};

TEST_F(MechanismColumns, areNamedByTheMap) {
  const UrsulaRun run = ursula_.passing("inverse own.toml --samples 201 --out found.csv" + motion_);
  EXPECT_THAT(run.err, HasSubstr("own.csv: read as: t_s = 'Clock' times 0.001, q_1_rad = 'enc A' times 0.01745329"));
  const auto difference = [&] {
    double out = 0;
    for (const std::string name : {"q_1_rad", "q_2_rad", "q_3_rad", "tau_1_Nm", "tau_2_Nm", "tau_3_Nm"})
      for (std::size_t i = 0; i < 201; ++i)
        out = std::max(out, std::abs(read("found.csv").at(name)[i] - read("motion.csv").at(name)[i]));
    return out;
  };
  EXPECT_LT(difference(), 1e-5) << "a spline through 201 samples";
  ursula_.passing("inverse own.toml --samples 201 --out found.csv" + time_ +
                  " --map q_1_deg='enc B' --map q_2_deg='enc A' --map q_3_deg='enc C'");
  EXPECT_GT(difference(), 0.01);
  ursula_.passing("check own.toml" + motion_);
  ursula_.passing("direct own.toml own.csv --out direct.csv" + motion_);
}

TEST_F(MechanismColumns, ofEffortsAreKnownByTheirWords) {
  const CsvTable motion = read("motion.csv");
  const auto judge = [&](const std::vector<std::string>& names) {
    ursula_.write("words.csv", csvText(names, {motion.at("t_s"), motion.at("tau_1_Nm"), motion.at("tau_2_Nm"),
                                               motion.at("tau_3_Nm")}));
    return ursula_("validate delta.toml --quiet --out results --rtol 1e-6 --torques words.csv");
  };
  EXPECT_EQ(judge({"time (s)", "Motor 1 torque (Nm)", "Motor 2 torque (N.m)", "Motor 3 torque"}).exit_code, 0);
  EXPECT_EQ(judge({"time", "arm0_motor torque (Nm)", "torque arm1_motor", "tau_arm2_motor_Nm"}).exit_code, 0);
  EXPECT_EQ(judge({"time", "Motor 1 torque (kNm)", "Motor 2 torque", "Motor 3 torque"}).exit_code, 1);
  const UrsulaRun force = judge({"time", "Motor 1 force (N)", "Motor 2 torque", "Motor 3 torque"});
  EXPECT_EQ(force.exit_code, 2);
  EXPECT_THAT(force.err, HasSubstr("motor 1 turns and has a torque"));
}

/// Efforts as a program of single precision prints them.
TEST_F(MechanismColumns, ofSinglePrecisionAreNamed) {
  const CsvTable motion = read("motion.csv");
  const auto causeOf = [&](bool is_single) {
    std::string text = "t_s,tau_1_Nm,tau_2_Nm,tau_3_Nm\n";
    for (std::size_t i = 0; i < motion.rows(); ++i) {
      text += std::to_string(motion.at("t_s")[i]);
      for (const char* name : {"tau_1_Nm", "tau_2_Nm", "tau_3_Nm"}) {
        const double effort = motion.at(name)[i] * (is_single ? 1 : 1 + 1e-7 * std::sin(static_cast<double>(i)));
        char printed[40];
        std::snprintf(printed, sizeof printed, ",%.9g", is_single ? static_cast<float>(effort) : effort);
        text += printed;
      }
      text += "\n";
    }
    ursula_.write("single.csv", text);
    ursula_("validate delta.toml --quiet --out results --torques single.csv");
    return TemporaryFolder::read(ursula_.folder() / "results/summary.json");
  };
  EXPECT_THAT(causeOf(true), HasSubstr("\"kind\": \"digits\""));
  EXPECT_THAT(causeOf(false), testing::Not(HasSubstr("\"kind\": \"digits\"")));
}

TEST_F(MechanismColumns, aSimulatorThatDoesNotListenHasNoOtherCause) {
  const auto judge = [&](const std::string& command, const std::string& more = "") {
    return ursula_("validate delta.toml --out results" + more + " --simulator '" + command + "'");
  };
  const UrsulaRun constant = judge("while read l; do echo 1,2,3; done");
  EXPECT_EQ(constant.exit_code, 1) << constant.err;
  EXPECT_THAT(constant.out, HasSubstr("the same answer whatever is asked: 1 for "));
  EXPECT_THAT(TemporaryFolder::read(ursula_.folder() / "results/summary.json"), HasSubstr("\"cause\": null"));
  EXPECT_EQ(judge("while read l; do sleep 0.1; echo 1,2,3; done", " --time-limit 0.3").exit_code, 3);
}

TEST_F(MechanismColumns, ofMotionAndEffortsAreNamedByOneMap) {
  const std::string judged = "validate own.toml --quiet --out results --rtol 1e-2 --torques ";
  const UrsulaRun right = ursula_(judged + "efforts.csv" + motion_ + efforts_);
  EXPECT_EQ(right.exit_code, 0) << right.out << right.err;
  EXPECT_THAT(right.err, AllOf(HasSubstr("own.csv: read as: t_s = 'Clock'"), HasSubstr("efforts.csv: read as: t_s")));
  ursula_.ending(
      1, judged + "efforts.csv" + motion_ + " --map tau_1_Nm='cur B' --map tau_2_Nm='cur A' --map tau_3_Nm='cur C'");
}

TEST_F(MechanismColumns, thatNoFileUsesAreNamed) {
  std::filesystem::create_directory(ursula_.folder() / "results");
  const std::string columns = "its columns are: Clock, enc A, enc B, enc C, q_2_rad";
  expectRefused(ursula_,
                {{"inverse own.toml" + time_, "missing column 'q_1_rad'"},
                 {"inverse own.toml" + time_, columns},
                 {"check own.toml" + motion_ + " --map qdot_1_rad_s=speed", "--map qdot_1_rad_s=speed: no file"},
                 {"validate own.toml" + motion_ + " --map nobody=Clock", "--map nobody=Clock: no file"},
                 {"inverse own.toml" + motion_ + " --map q_1_rad=q_2_rad", "q_1_rad is mapped twice"},
                 {"validate own.toml --torques efforts.csv" + motion_ + efforts_ + " --map tau_1_Nm=none",
                  "tau_1_Nm is mapped twice"},
                 {"simulate delta.toml --map t_ms=Clock", "--map t_ms=Clock: no file"},
                 {"inverse " + helix + " --map t_ms=Clock", "--map t_ms=Clock: no file"}});
}

TEST_F(MechanismColumns, ofTimeAreUnderstoodAsThoseOfEfforts) {
  std::string text = ursula_.read("own.csv");
  ursula_.write("own.csv", text.replace(0, 5, "Time [ms]"));
  ursula_.passing("check own.toml" + motion_.substr(time_.size()));
}

}  // namespace
}  // namespace ursula

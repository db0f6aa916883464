// `ursula validate --solver`: a foreign solver as a process, which is right, wrong, or breaks the protocol.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/end_to_end/program.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

using testing::ContainsRegex;

/// The program in a folder with the helix, at fewer instants for speed.
class SolverRun : public testing::Test {
 protected:
  SolverRun() { ursula_.write("quick.toml", Program::shipped("paper-helix.toml") + "\n[simulation]\nsamples = 11\n"); }

  UrsulaRun judge(const std::string& command, const std::string& more = "") const {
    return ursula_("validate quick.toml --out out --solver '" + command + "' " + more);
  }
  /// Returns the error of a call that may write nothing.
  std::string refused(const std::string& command, const std::string& more = "") const {
    const UrsulaRun run = judge(command, more);
    EXPECT_EQ(run.exit_code, 2) << run.out << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_FALSE(std::filesystem::exists(folder() / "out"));
    return run.err;
  }
  std::filesystem::path folder() const { return ursula_.folder(); }

  Program ursula_;
};

constexpr const char* question = "\n  question: 0,[^,]+(,[^,\n]+){18}\n  answer:   ";

TEST_F(SolverRun, aRightOnePasses) {
  const UrsulaRun run = judge("echo started >&2; exec " URSULA_EXAMPLE_SOLVER);
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_THAT(run.out, AllOf(StartsWith("paper-helix: pass"), HasSubstr("\nverdict: pass — 24 of 24 checks held")));
  EXPECT_THAT(run.err, HasSubstr("started\n")) << "its standard error is ours";
  EXPECT_EQ(run.err.find("started"), run.err.rfind("started")) << "it is started once";
  EXPECT_THAT(run.err, Not(HasSubstr("asks the solver 20,000 times")));
  const auto summary = nlohmann::json::parse(TemporaryFolder::read(folder() / "out/summary.json"));
  EXPECT_EQ(summary.at("verdict"), "pass");
  EXPECT_EQ(summary.at("provenance").at("subject"), "echo started >&2; exec " URSULA_EXAMPLE_SOLVER);
  for (const auto& check : summary.at("checks")) {
    const std::string name = check.at("name");
    if (name.rfind("invariance.", 0) == 0) {  // of the solver, but for that of the engines
      EXPECT_EQ(check.at("verdict"), name == "invariance.engines" ? "pass" : "not_applicable") << name;
    }
    if (name.rfind("torque.between", 0) == 0) {
      EXPECT_EQ(check.at("verdict"), "pass") << name;
    }
  }
}

TEST_F(SolverRun, isAskedFewTimesUnlessThorough) {
  const auto asked = [&](const std::string& more) {
    const UrsulaRun run = judge("tee asked | " URSULA_EXAMPLE_SOLVER, more);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const std::string lines = TemporaryFolder::read(folder() / "asked");
    return std::count(lines.begin(), lines.end(), '\n');
  };
  EXPECT_LE(asked(""), 2000);
  EXPECT_GT(asked("--thorough"), 10000);
}

/// The example's efforts under gravity alone are no accelerations, so this one is wrong; zeros are wrong, too.
TEST_F(SolverRun, aSimulatorIsJudged) {
  const UrsulaRun run = ursula_(
      "validate quick.toml --out out --simulator 'while read line; do echo \"$line\" >> asked; echo 0,0,0,0,0,0; "
      "done'");
  EXPECT_EQ(run.exit_code, 1) << run.out << run.err;
  const std::string asked = TemporaryFolder::read(folder() / "asked");
  EXPECT_LE(std::count(asked.begin(), asked.end(), '\n'), 2000);
  const std::string first = asked.substr(0, asked.find('\n'));
  EXPECT_EQ(std::count(first.begin(), first.end(), ','), 19) << "t, p, q, v, w and six efforts";
  const auto summary = nlohmann::json::parse(TemporaryFolder::read(folder() / "out/summary.json"));
  EXPECT_EQ(summary.at("verdict"), "fail");
  EXPECT_THAT(TemporaryFolder::read(folder() / "out/report.html"), HasSubstr(" --simulator "));
  const UrsulaRun bad = ursula_("validate quick.toml --out none --simulator 'read line; echo 1,2,3'");
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_THAT(bad.err,
              AllOf(HasSubstr("the simulator '"), HasSubstr("3 values, expected six"), HasSubstr("question: 0,")));
  EXPECT_FALSE(std::filesystem::exists(folder() / "none"));
  ursula_.ending(2, "validate quick.toml --simulator cat --solver cat");
}

/// A slow simulator's judgement is unfinished, and is written; a wrong answer within the time is refused.
TEST_F(SolverRun, aSlowSimulatorIsInconclusive) {
  const UrsulaRun run = ursula_(
      "validate quick.toml --out out --time-limit 0.3 --simulator 'while read line; do sleep 0.1; echo 0,0,0,0,0,0; "
      "done'");
  EXPECT_EQ(run.exit_code, 3) << run.out << run.err;
  const auto summary = nlohmann::json::parse(TemporaryFolder::read(folder() / "out/summary.json"));
  EXPECT_EQ(summary.at("verdict"), "inconclusive");
  for (const char* file : {"timeseries.csv", "report.html", "junit.xml"})
    EXPECT_TRUE(std::filesystem::exists(folder() / "out" / file)) << file;
  EXPECT_EQ(ursula_("validate quick.toml --out none --time-limit 60 --simulator 'read line; echo 1,2,3'").exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder() / "none"));
}

TEST_F(SolverRun, aMotionIsJudged) {
  ursula_.passing("inverse quick.toml --samples 301 --out right.csv");
  const UrsulaRun right = ursula_("validate quick.toml --trajectory right.csv --out out --rtol 1e-4");
  EXPECT_EQ(right.exit_code, 0) << right.out << right.err;
  EXPECT_EQ(ursula_("validate quick.toml --trajectory right.csv --torques right.csv --out out --rtol 1e-4").exit_code,
            0);
  std::string text = Program::shipped("paper-helix.toml");
  const std::string radius = "radius = 0.2";
  ASSERT_NE(text.find(radius), std::string::npos);
  ursula_.write("other.toml", text.replace(text.find(radius), radius.size(), "radius = 0.201"));
  ursula_.passing("inverse other.toml --samples 301 --out other.csv");
  ursula_.ending(1, "validate quick.toml --trajectory other.csv --out out --rtol 1e-4");
  ursula_.ending(2, "validate quick.toml --trajectory missing.csv --out out");
}

TEST_F(SolverRun, aWrongOneFails) {
  const UrsulaRun run = judge(URSULA_EXAMPLE_SOLVER " 1e-10");
  EXPECT_EQ(run.exit_code, 1) << run.out << run.err;
  EXPECT_THAT(run.out, ContainsRegex("fail +torque.pointwise"));
  EXPECT_TRUE(std::filesystem::exists(folder() / "out/summary.json"));
  EXPECT_THAT(TemporaryFolder::read(folder() / "out/report.html"),
              HasSubstr("To do it again: <code>ursula validate quick.toml --solver "))
      << "without the solver it passes";
}

TEST_F(SolverRun, whatIsNoAnswerIsRefusedWithQuestionAndAnswer) {
  const auto saying = [](const std::string& answer) { return "while read line; do echo \"" + answer + "\"; done"; };
  EXPECT_THAT(refused(saying("1,2,3,4,5")), AllOf(HasSubstr("5 values, expected six, separated by commas"),
                                                  ContainsRegex(question + std::string("1,2,3,4,5\n"))));
  EXPECT_THAT(refused(saying("1,2,3,4,5,6,7")), HasSubstr("7 values"));
  EXPECT_THAT(refused(saying("")), HasSubstr("1 value, expected six"));
  EXPECT_THAT(refused(saying("1,2,3,4,5 N m,6")),
              AllOf(HasSubstr("effort 5 is '5 N m', expected a finite number"), ContainsRegex(question)));
  EXPECT_THAT(refused(saying("1,nan,3,4,5,6")), HasSubstr("effort 2 is 'nan', expected a finite number"));
  EXPECT_THAT(refused(saying("1,2,3,4,5,inf")), HasSubstr("effort 6 is 'inf'"));
  EXPECT_THAT(refused("while read line; do echo 1,2,3,4,5,6; echo 1,2,3,4,5,6; done"),
              HasSubstr("wrote something that it was not asked for"));
}

TEST_F(SolverRun, anEarlyEndIsRefused) {
  EXPECT_THAT(refused("exit 3"), AllOf(HasSubstr("the solver 'exit 3' ended with exit code 3 before it had answered"),
                                       ContainsRegex(question + std::string("none\n"))));
  EXPECT_THAT(refused("read line; echo 1,2,3,4,5,6; read line; printf 1,2"),
              AllOf(HasSubstr("ended with exit code 0 before it had answered"), HasSubstr("answer:   1,2\n")));
  EXPECT_THAT(refused("read line; kill -9 $$"), HasSubstr("was ended by signal 9 (Killed) before it had answered"));
  EXPECT_THAT(
      refused("no-such-program-anywhere"),
      AllOf(HasSubstr("not found"), HasSubstr("ended with exit code 127 (command not found) before it had answered")));
}

/// Whether a process runs; a dead one that nobody has waited for does not.
bool runs(const std::string& pid) {
  std::ifstream stat("/proc/" + pid + "/stat");
  std::string number, name, state;
  return stat >> number >> name >> state && state != "Z" && state != "X";
}

/// Whether the process whose number is in `file` has ended or ends soon.
bool ends(const std::filesystem::path& file) {
  std::string pid = TemporaryFolder::read(file);
  pid.erase(pid.find_last_not_of('\n') + 1);
  EXPECT_FALSE(pid.empty());
  for (int k = 0; runs(pid) && k < 1000; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return !runs(pid);
}

TEST_F(SolverRun, oneThatHangsIsEndedWithItsChildren) {
  EXPECT_THAT(refused("sleep 1000 & echo $! > child; echo $$ > self; wait", "--solver-timeout 0.3"),
              AllOf(HasSubstr("gave no answer within 0.3 s"), ContainsRegex(question + std::string("none\n"))));
  EXPECT_TRUE(ends(folder() / "child"));
  EXPECT_TRUE(ends(folder() / "self"));
}

TEST_F(SolverRun, oneIsEndedWithAProgramThatIsInterrupted) {
  const UrsulaRun run = judge("echo $$ > self; kill -INT $PPID; exec sleep 1000");
  EXPECT_NE(run.exit_code, 0);
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(ends(folder() / "self"));
  EXPECT_FALSE(std::filesystem::exists(folder() / "out"));
}

/// The solver's process does not notice by itself that the program ends.
TEST_F(SolverRun, oneIsEndedByWhateverSignalEndsTheProgram) {
  for (const char* signal : {"TERM", "HUP", "QUIT", "ALRM", "USR1", "USR2", "XCPU", "VTALRM", "PROF"}) {
    EXPECT_NE(judge("echo $$ > self; kill -" + std::string(signal) + " $PPID; exec sleep 1000").exit_code, 0) << signal;
    EXPECT_TRUE(ends(folder() / "self")) << signal;
  }
}

TEST_F(SolverRun, whatCannotBeMeantIsRefused) {
  EXPECT_THAT(refused("cat", "--torques tau.csv"), HasSubstr("--torques excludes --solver"));
  EXPECT_THAT(refused(""), HasSubstr("expected a command"));
  EXPECT_THAT(refused("cat", "--solver-timeout 0"), HasSubstr("--solver-timeout"));
  ursula_.ending(2, "validate quick.toml --solver-timeout 3");
}

TEST_F(SolverRun, aSuiteStartsItForEachScenario) {
  std::string text = Program::shipped("paper-helix.toml") + "\n[simulation]\nsamples = 11\n";
  const std::string name = "name = \"paper-helix\"";
  ASSERT_NE(text.find(name), std::string::npos);
  ursula_.write("second.toml", text.replace(text.find(name), name.size(), "name = \"second\""));
  const UrsulaRun right = ursula_(
      "validate quick.toml second.toml --out out --solver 'echo $URSULA_SCENARIO >> asked; "
      "exec " URSULA_EXAMPLE_SOLVER "'");
  EXPECT_EQ(right.exit_code, 0) << right.out << right.err;
  for (const char* each : {"out/paper-helix", "out/second"})
    EXPECT_THAT(TemporaryFolder::read(folder() / each / "summary.json"), HasSubstr("exec " URSULA_EXAMPLE_SOLVER))
        << each;
  EXPECT_THAT(TemporaryFolder::read(folder() / "asked"), AllOf(HasSubstr("quick.toml\n"), HasSubstr("second.toml\n")));
}

TEST_F(SolverRun, theScenariosPathIsInTheEnvironment) {
  EXPECT_THAT(refused("read line; echo \"$URSULA_SCENARIO\""),
              HasSubstr("answer:   " + std::filesystem::canonical(folder()).string() + "/quick.toml"));
}

}  // namespace
}  // namespace ursula

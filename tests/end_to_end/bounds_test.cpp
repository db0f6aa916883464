// Endless, absurd or empty input ends the program at once, and the message names the cause.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/end_to_end/program.h"
#include "tests/model/scenario_text.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

using testing::ContainsRegex;

constexpr int bad_input = 2, inconclusive = 3;

TEST(BoundsRun, readsNoEndlessSource) {
  const Program ursula;
  ursula.write("small.toml", good_scenario);
  for (const char* call : {"check /dev/zero", "check - < /dev/zero", "sweep /dev/zero --db a.db",
                           "validate small.toml --torques /dev/zero", "compare /dev/zero /dev/zero"}) {
    const UrsulaRun run = ursula.ending(bad_input, call);
    EXPECT_THAT(run.err, AllOf(HasSubstr(":1"), HasSubstr("error: a zero byte, expected text"))) << call;
  }
  const auto pipe = ursula("check - < small.toml");
  EXPECT_EQ(pipe.exit_code, 0) << "the control: " << pipe.err;
}

TEST(BoundsRun, refusesEmptyValues) {
  const Program ursula;
  ursula.write("small.toml", good_scenario);
  for (const char* call : {"validate small.toml --torques ''", "validate small.toml --out ''", "validate ''",
                           "inverse small.toml --out ''"})
    expectRefused(ursula, {{call, " is empty, expected a value"}});
}

TEST(BoundsRun, refusesNumbersThatWouldWrapAround) {
  const Program ursula;
  const std::string prove = "prove --only-random --random 0 --seed ";
  for (const char* seed : {"-1", "''", "18446744073709551616", "1.5", "1e3", "' 1'"})
    expectRefused(ursula, {{prove + seed, "is not an integer from 0 to 18446744073709551615"}});
  ursula.passing(prove + "18446744073709551615");
}

TEST(BoundsRun, tellsTheTerminalNothing) {
  const Program ursula;
  ursula.write("bad.toml", "name = \"a\\u001b]0;b\\u0007\"\n");
  ursula.write("p\x1b[31m.toml", "x = 1\n");
  for (const char* call : {"check bad.toml", "check 'p\x1b[31m.toml'", "validate 'no\x1b[31m' p*", "'\x1b[31m'"}) {
    const UrsulaRun run = ursula.ending(bad_input, call);
    EXPECT_THAT(run.err, AllOf(HasSubstr("\\x1b"), Not(HasSubstr("\x1b")))) << call;
  }
}

/// An error is one line, whatever the path contains.
TEST(BoundsRun, makesNoLineOfAPath) {
  const Program ursula;
  const std::string text = good_scenario;
  ursula.write("a.toml", text.substr(0, text.find("[trajectory]")) +
                             "[trajectory]\nkind = \"samples\"\nfile = \"x\\na.toml:9:9: error: forged\"\n");
  ursula.write("b\nb.toml:1:1: error: forged", "x = 1\n");
  for (const char* call : {"check a.toml", "check b*", "validate b*", "sweep b*"}) {
    const UrsulaRun run = ursula.ending(bad_input, call);
    EXPECT_THAT(run.err, AllOf(HasSubstr("\\x0a"), Not(HasSubstr("\na.toml:9")), Not(HasSubstr("\nb.toml:1")))) << call;
  }
}

TEST(BoundsRun, inverseNamesInstantAndQuantityOfWhatIsNotFinite) {
  const Program ursula;
  std::string fast = good_scenario;
  for (const auto& [from, to] : {std::pair{"mass = 500.0", "mass = 1e100"},
                                 {"duration = 3.0", "duration = 1e-100"},
                                 {"center_of_mass = [0.0, 0.0, 1.88]", "center_of_mass = [0.0, 0.0, 1e30]"}})
    fast = replaced(fast, from, to);
  ursula.write("small.toml", fast);
  const UrsulaRun run = ursula.ending(bad_input, "inverse small.toml --samples 3 --out out.csv");
  EXPECT_THAT(run.err, ContainsRegex("tau_[1-6]_Nm = -?(inf|nan) at t = [0-9.e-]+ s, expected a finite number"));
  EXPECT_EQ(ursula.files(), 1U) << "nothing was written";
}

TEST(BoundsRun, refusesNumbersWhoseProductsNoDoubleHolds) {
  const Program ursula;
  for (const auto& [from, to, place] : {std::tuple{"mass = 500.0", "mass = 1e101", "a.toml:5:8"},
                                        {"mass = 500.0", "mass = 1e-320", "a.toml:5:8"},
                                        {"duration = 3.0", "duration = 5e-324", "a.toml:46:12"},
                                        {"pitch = 1.2", "pitch = -1e300", "a.toml:48:9"}}) {
    ursula.write("a.toml", replaced(good_scenario, from, to));
    expectRefused(ursula, {{"check a.toml", std::string(place) + ": error: "},
                           {"check a.toml", "expected 0 or a size from 1e-100 to 1e+100"}});
  }
  ursula.write("heavy.toml", replaced(good_scenario, "mass = 500.0", "mass = 1e60"));
  expectRefused(ursula, {{"validate heavy.toml --out out",
                          "error: Simbody cannot hold a body of 1e+60 kg whose center of mass is 1.88 m from its "
                          "origin: its moments of inertia of "}});
}

TEST(BoundsRun, saysThatTheWorkingFolderIsGone) {
  const Program ursula;
  const std::string scenario = ursula.write("small.toml", good_scenario).string();
  for (const auto& [call, says] :
       {std::pair{"validate " + scenario,
                  "error: results/small: No such file or directory, as the working folder has been removed\n"},
        {"inverse " + scenario + " --out x.csv", "error: cannot write x.csv: No such file or directory\n"}}) {
    std::filesystem::create_directory(ursula.folder() / "gone");
    const std::string line = "cd '" + (ursula.folder() / "gone").string() +
                             "' && rmdir ../gone && '" URSULA_PROGRAM "' " + call + " >../out 2>../err";
    EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), bad_input) << call;
    EXPECT_EQ(ursula.read("err"), says) << call;
  }
}

/// A slow solver is not asked after the limit.
TEST(TimeLimitRun, endsWithTheAnswerOfASlowSolver) {
  const Program ursula;
  ursula.write("small.toml", good_scenario);
  ursula.write("slow.sh", "while read -r line; do echo >> asked; sleep 5; echo 1,2,3,4,5,6; done\n");
  ursula.ending(inconclusive, "validate small.toml --solver 'sh slow.sh' --solver-timeout 60 --time-limit 5 --out out");
  const auto asked = ursula.read("asked").size();
  EXPECT_GT(asked, 0U);
  EXPECT_LE(asked, 2U) << "of 301";
}

TEST(TimeLimitRun, leavesAnInconclusiveReport) {
  const Program ursula;
  ursula.write("small.toml", good_scenario);
  const UrsulaRun run = ursula.ending(inconclusive, "validate small.toml --time-limit 0.001 --out out");
  EXPECT_THAT(run.out, HasSubstr("the time limit of 0.001 s was reached"));
  const auto summary = nlohmann::json::parse(ursula.read("out/summary.json"));
  EXPECT_EQ(summary["verdict"], "inconclusive");
  for (const char* file : {"report.html", "junit.xml", "timeseries.csv"})
    EXPECT_TRUE(std::filesystem::exists(ursula.folder() / "out" / file)) << file;
  EXPECT_THAT(ursula("validate small.toml --time-limit 0").err, HasSubstr("is not a finite number above 0"));
}

TEST(TimeLimitRun, holdsForEachOfASuite) {
  const Program ursula;
  ursula.write("a.toml", replaced(good_scenario, "\"small\"", "\"a\""));
  ursula.write("b.toml", replaced(good_scenario, "\"small\"", "\"b\""));
  const UrsulaRun run = ursula.ending(inconclusive, "validate a.toml b.toml --time-limit 0.001 --out out");
  EXPECT_THAT(run.out, HasSubstr("0 passed, 0 failed, 2 inconclusive"));
}

TEST(TimeLimitRun, endsASimulation) {
  const Program ursula;
  ursula.write("small.toml", good_scenario);
  ursula.passing("inverse small.toml --samples 20 --out tau.csv");
  const UrsulaRun run = ursula.ending(1, "simulate small.toml --torques tau.csv --time-limit 1e-9");
  EXPECT_THAT(run.err, HasSubstr("the time limit of 1e-09 s was reached"));
  EXPECT_EQ(ursula("simulate small.toml --torques tau.csv --time-limit 1e6").exit_code, 0) << "the control";
}

}  // namespace
}  // namespace ursula

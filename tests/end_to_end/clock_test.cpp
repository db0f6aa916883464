// A wall clock that goes back or leaps upsets nothing: newer files are replaced, sweeps go on, time limits hold.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>

#include "base/sha1.h"
#include "tests/end_to_end/quick_runs.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

namespace fs = std::filesystem;

constexpr const char* shim = "LD_PRELOAD='" URSULA_WORLD_SHIM "' SHIM_CLOCK_STEP=";
/// Each reading of the wall clock is a day earlier, or later, than the previous one.
const std::string backwards = std::string("env ") + shim + "-86400 \"$URSULA\" ";
const std::string leaping = std::string("env ") + shim + "86400 \"$URSULA\" ";

/// As if written while the clock was a day ahead.
void makeOfTomorrow(const fs::path& path) {
  const auto tomorrow = fs::file_time_type::clock::now() + std::chrono::hours(24);
  if (fs::is_directory(path))
    for (const auto& entry : fs::recursive_directory_iterator(path)) fs::last_write_time(entry.path(), tomorrow);
  fs::last_write_time(path, tomorrow);
}

/// Makes what a killed run leaves beside the folder `name`.
fs::path leftoverOf(const Program& ursula, const std::string& name) {
  const std::string folder = ".ursula-new-" + sha1(name).substr(0, 12) + "-4711-0";
  fs::create_directory(ursula.folder() / folder);
  ursula.write(folder + "/summary.json", "{");
  makeOfTomorrow(ursula.folder() / folder);
  return ursula.folder() / folder;
}

TEST(ClockSetBack, resultsOfTomorrowAreReplacedAsAWhole) {
  const Program ursula;
  ursula.write("a.toml", quickScenario("one"));
  ursula.write("b.toml", quickScenario("one", "499.0"));
  ursula.passing("validate b.toml --quiet --out fresh");
  ursula.passing("validate a.toml --quiet --out old");
  fs::copy(ursula.folder() / "old", ursula.folder() / "out", fs::copy_options::recursive);
  makeOfTomorrow(ursula.folder() / "out");
  const fs::path left = leftoverOf(ursula, "out"), of_another = leftoverOf(ursula, "another");
  const std::string start = utcNow();
  ASSERT_EQ(shell(ursula, backwards + "validate b.toml --quiet --out out >said"), 0);
  ASSERT_EQ(shell(ursula, leaping + "validate b.toml --time-limit 1e-9 --quiet --out later >said"), 3);
  EXPECT_LT(startSaidBy(ursula.folder() / "out/junit.xml"), start) << "or no clock was set back";
  EXPECT_LT(start, startSaidBy(ursula.folder() / "later/junit.xml")) << "the control: a clock that leaps";
  EXPECT_NE(startSaidBy(ursula.folder() / "out/junit.xml"), "");
  EXPECT_THAT(ursula.read("out/junit.xml"), testing::Not(HasSubstr("time=\"-")));
  EXPECT_TRUE(contents(ursula.folder() / "out") == contents(ursula.folder() / "fresh"));
  EXPECT_FALSE(contents(ursula.folder() / "out") == contents(ursula.folder() / "old")) << "or nothing would be seen";
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(of_another)) << "the control: it belongs to another folder";
  EXPECT_EQ(shell(ursula, backwards + "compare out fresh >said"), 0);
  EXPECT_EQ(shell(ursula, backwards + "compare out old >said"), 1);
  EXPECT_EQ(shell(ursula, "export BROWSER=true; " + backwards + "open out >said"), 0);
}

TEST(ClockSetBack, aFileOfTomorrowIsReplaced) {
  const Program ursula;
  ursula.write("a.toml", quickScenario("one"));
  ursula.passing("inverse a.toml --samples 20 --out fresh.csv");
  makeOfTomorrow(ursula.write("out.csv", "old\n"));
  ASSERT_EQ(shell(ursula, backwards + "inverse a.toml --samples 20 --out out.csv"), 0);
  EXPECT_GT(ursula.read("out.csv").size(), 1000U);
  EXPECT_TRUE(ursula.read("out.csv") == ursula.read("fresh.csv"));
}

const std::string small_sweep = massSweep("a.toml", "what = \"inverse\"\ncount = 40\nsamples = 5\n");

TEST(ClockSetBack, aSweepGoesOnWhereItStopped) {
  const Program ursula;
  ursula.write("a.toml", quickScenario("one"));
  ursula.write("s.toml", small_sweep);
  const auto rows = [&ursula](const std::string& database) {
    return ursula("sweep report " + database + " --csv -").out;
  };
  ursula.passing("sweep s.toml --db fresh.db");
  ursula.passing("sweep s.toml --shard 1/2 --db half.db");
  ASSERT_EQ(ursula("sweep merge half.db --db s.db").exit_code, 3) << "half of it is missing";
  EXPECT_NE(rows("s.db"), rows("fresh.db")) << "the control";
  makeOfTomorrow(ursula.folder() / "s.db");
  EXPECT_EQ(shell(ursula, backwards + "sweep s.toml --db s.db >said 2>err"), 0);
  const std::string all = rows("fresh.db");
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 41);
  EXPECT_EQ(rows("s.db"), all);
  EXPECT_EQ(shell(ursula, backwards + "sweep s.toml --db s.db >said 2>err"), 0);
  EXPECT_THAT(ursula.read("err"), HasSubstr("nothing to do"));
}

/// A limit by the wall clock would end at once if the clock leaps, and never if it goes back.
TEST(ClockSetBack, limitsOfTimeAreUpsetByNoClock) {
  const Program ursula;
  ursula.write("a.toml", quickScenario("one"));
  ursula.passing("validate a.toml --quiet --out fresh");
  const std::string summary = ursula.read("fresh/summary.json");
  ASSERT_EQ(nlohmann::json::parse(summary).at("verdict"), "pass");
  for (const std::string& clock : {backwards, leaping}) {
    EXPECT_EQ(shell(ursula, clock + "validate a.toml --time-limit 36000 --quiet --out out"), 0) << clock;
    EXPECT_TRUE(ursula.read("out/summary.json") == summary) << clock;
    EXPECT_EQ(shell(ursula, clock + "validate a.toml --time-limit 1e-9 --quiet --out out >said"), 3) << clock;
    EXPECT_THAT(ursula.read("out/summary.json"), HasSubstr("the time limit of 1e-09 s"));
  }
}

TEST(ClockSetBack, aSolverIsWaitedForByNoWallClock) {
  const Program ursula;
  ursula.write("a.toml", quickScenario("one"));
  const std::string call = "validate a.toml --quiet --out out --solver '" URSULA_EXAMPLE_SOLVER "' --solver-timeout ";
  EXPECT_EQ(shell(ursula, leaping + call + "36000 2>err"), 0) << ursula.read("err");
  ursula.write("silent.sh", "read -r line; sleep 60\n");
  EXPECT_EQ(shell(ursula, backwards + "validate a.toml --out out --solver 'sh silent.sh' --solver-timeout 0.1 2>err"),
            2);
  EXPECT_THAT(ursula.read("err"), HasSubstr("gave no answer within 0.1 s"));
}

}  // namespace
}  // namespace ursula

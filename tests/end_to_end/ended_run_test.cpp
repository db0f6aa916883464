// Runs that end before they are done, lack descriptors or memory of them, or lose their streams.

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "base/sha1.h"
#include "tests/end_to_end/quick_runs.h"
#include "tests/end_to_end/running.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// Nearly all time passes before anything is written.
TEST(EndedRun, ofASignalLeavesNothing) {
  const Program ursula;
  ursula.write("a.toml", good_scenario);
  const fs::path lock = ursula.folder() / "fresh" / "parent" / (".ursula-lock-" + sha1("out").substr(0, 12));
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    Running run(ursula, {"validate", "a.toml", "--out", "fresh/parent/out"});
    while (!fs::exists(lock) && !run.hasEnded()) std::this_thread::sleep_for(1ms);
    EXPECT_TRUE(run.isEndedBy(signal)) << signal;
    EXPECT_FALSE(fs::exists(ursula.folder() / "fresh")) << signal;
  }
  Running killed(ursula, {"validate", "a.toml", "--out", "fresh/parent/out"});
  while (!fs::exists(lock) && !killed.hasEnded()) std::this_thread::sleep_for(1ms);
  EXPECT_TRUE(killed.isEndedBy(SIGKILL));
  EXPECT_TRUE(fs::exists(lock)) << "or nothing would be seen above";
}

/// Each change is judged once more; a scenario that cannot be read ends nothing, and SIGINT does.
TEST(Watch, judgesAgainWhenAFileChanges) {
  const Program ursula;
  const fs::path summary = ursula.folder() / "out" / "summary.json";
  ursula.write("a.toml", quickScenario("one"));
  Running run(ursula, {"validate", "a.toml", "--out", "out", "--watch", "--quiet", "--time-limit", "1e-9"});
  const auto holds = [&](const char* what) {
    for (int k = 0; k < 3000 && !run.hasEnded(); ++k, std::this_thread::sleep_for(10ms))
      if (fs::exists(summary) && TemporaryFolder::read(summary).find(what) != std::string::npos) return true;
    return false;
  };
  ASSERT_TRUE(holds("\"one\""));
  ursula.write("a.toml", "this is no scenario");
  std::this_thread::sleep_for(1s);
  EXPECT_FALSE(run.hasEnded());
  ursula.write("a.toml", quickScenario("another"));
  EXPECT_TRUE(holds("\"another\""));
  std::this_thread::sleep_for(500ms);  // until it waits
  run.send(SIGINT);
  EXPECT_EQ(run.exitCode(), 3);
}

TEST(EndedRun, ofTooFewDescriptorsNamesAPath) {
  const Program ursula;
  for (const char* name : {"one", "two"}) ursula.write(std::string(name) + ".toml", quickScenario(name));
  bool is_seen = false;
  for (const char* most : {"4", "5", "6"}) {  // the message has a path, whichever part meets the limit first
    shell(ursula, std::string("prlimit --nofile=") + most +
                      " $URSULA validate one.toml two.toml --time-limit 1e-9 --out out >said 2>err");
    const std::string said = ursula.read("err");
    is_seen = is_seen || said.find("Too many open files") != std::string::npos;
    EXPECT_THAT(said, Not(HasSubstr("error: :"))) << most;
    fs::remove_all(ursula.folder() / "out");
    EXPECT_EQ(ursula.files(), 4u) << most << ": something is left beside two scenarios, said and err";
  }
  EXPECT_TRUE(is_seen);
}

using testing::IsEmpty;

TEST(LostTerminal, isNoReasonToStop) {
  const Program ursula;
  ursula.write("a.toml", quickScenario("one"));
  ursula.write("b.toml", quickScenario("two"));
  const std::string call = "\"$URSULA\" validate a.toml b.toml --time-limit 1e-9 --out out >said";
  ASSERT_EQ(shell(ursula, call + " 2>/dev/null"), 3);
  const auto expected = contents(ursula.folder() / "out");
  for (const std::string& lost : {call + " 2>&-", call + " 2>/dev/full", call + " <&- 2>&-",
                                  "{ " + call + " 2>&3; echo $? >code; } 3>&1 | true; exit $(cat code)"}) {
    fs::remove_all(ursula.folder() / "out");
    EXPECT_EQ(shell(ursula, lost), 3) << lost;
    EXPECT_TRUE(contents(ursula.folder() / "out") == expected) << lost;
    EXPECT_THAT(ursula.read("said"), HasSubstr("0 passed, 0 failed, 2 inconclusive")) << lost;
  }
}

TEST(LostData, isExit2AndSaidOnWhatIsLeft) {
  const Program ursula;
  ursula.write("a.toml", quickScenario("one"));
  ursula.write("b.toml", quickScenario("two"));
  for (const char* call :
       {"validate a.toml --time-limit 1e-9", "validate a.toml --time-limit 1e-9 --json",
        "validate a.toml b.toml --time-limit 1e-9 --json", "inverse a.toml", "check a.toml", "explain", "--help"})
    for (const char* lost : {">/dev/full", ">&-"}) {
      const std::string line = std::string("\"$URSULA\" ") + call + " " + lost;
      EXPECT_EQ(shell(ursula, line + " 2>err"), 2) << line;
      EXPECT_THAT(ursula.read("err"), HasSubstr("error: standard output could not be written")) << line;
    }
  for (const char* both : {">/dev/full 2>&-", ">&- 2>&-"})
    EXPECT_EQ(shell(ursula, std::string("\"$URSULA\" inverse a.toml ") + both), 2) << both;
  EXPECT_EQ(shell(ursula, "\"$URSULA\" inverse a.toml >/dev/null 2>err"), 0) << "what is thrown away is not lost";
  EXPECT_THAT(ursula.read("err"), IsEmpty());
}

}  // namespace
}  // namespace ursula

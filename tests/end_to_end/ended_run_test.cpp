// Runs that end before they are done, by a signal or for lack of descriptors.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "base/sha1.h"
#include "tests/end_to_end/quick_runs.h"
#include "tests/end_to_end/running.h"

namespace ursula {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Not;

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

TEST(EndedRun, ofTooFewDescriptorsNamesAPath) {
  const Program ursula;
  for (const char* name : {"one", "two"}) ursula.write(std::string(name) + ".toml", quickScenario(name));
  bool is_seen = false;
  for (const char* most : {"4", "5", "6"}) {  // the message has a path, whichever part meets the limit first
    shell(ursula,
          std::string("prlimit --nofile=") + most + " $URSULA validate one.toml two.toml --out out >said 2>err");
    const std::string said = TemporaryFolder::read(ursula.folder() / "err");
    is_seen = is_seen || said.find("Too many open files") != std::string::npos;
    EXPECT_THAT(said, Not(HasSubstr("error: :"))) << most;
    fs::remove_all(ursula.folder() / "out");
    EXPECT_EQ(ursula.files(), 4u) << most << ": something is left beside two scenarios, said and err";
  }
  EXPECT_TRUE(is_seen);
}

}  // namespace
}  // namespace ursula

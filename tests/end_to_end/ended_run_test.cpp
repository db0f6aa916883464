// Runs that end before they are done: by a signal.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "model/sha1.h"
#include "tests/end_to_end/quick_runs.h"
#include "tests/end_to_end/running.h"

namespace ursula {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
/// The longest by far is spent before anything is written.
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

}  // namespace
}  // namespace ursula

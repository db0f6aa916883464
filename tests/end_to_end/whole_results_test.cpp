// Results of one run belong together, even if it is killed at any moment, the disk is full, or another run writes
// there.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <random>
#include <thread>

#include "base/sha1.h"
#include "tests/end_to_end/quick_runs.h"
#include "tests/end_to_end/running.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr int inconclusive = 3;

/// Notices the first write in a folder or below it.
class Watch {
 public:
  explicit Watch(const fs::path& folder) : descriptor_(::inotify_init1(IN_CLOEXEC | IN_NONBLOCK)) {
    constexpr unsigned writing = IN_CREATE | IN_MODIFY | IN_MOVED_TO | IN_DELETE;
    ::inotify_add_watch(descriptor_, folder.c_str(), writing);
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_directory()) ::inotify_add_watch(descriptor_, entry.path().c_str(), writing);
  }
  ~Watch() { ::close(descriptor_); }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  /// Whether results appeared, beside the lock, which is taken before anything is computed.
  bool sawResults() const {
    alignas(inotify_event) char events[4096];
    const ssize_t size = ::read(descriptor_, events, sizeof events);
    for (ssize_t at = 0; at < size;) {
      const auto* event = reinterpret_cast<const inotify_event*>(events + at);
      if (event->len > 0 && std::string(event->name).find(".ursula-lock") != 0) return true;
      at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
    }
    return false;
  }

 private:
  int descriptor_;
};

/// Kills a run within this time after its start, or after its first write.
void killSomewhere(const Program& ursula, const std::vector<std::string>& call, std::chrono::microseconds at_most,
                   bool while_writing, std::mt19937& random) {
  const Watch watch(ursula.folder());
  Running run(ursula, call);
  while (while_writing && !watch.sawResults() && !run.hasEnded()) std::this_thread::sleep_for(100us);
  std::this_thread::sleep_for(std::chrono::microseconds(random() % static_cast<unsigned>(at_most.count())));
  run.kill();
}

/// Adapts the time after the first write so that about every second kill comes before the swap, however loaded the
/// machine is.
class AroundTheSwap {
 public:
  std::chrono::microseconds atMost() const { return at_most_; }
  void learn(bool was_after) { at_most_ = was_after ? std::max(at_most_ / 2, shortest) : 2 * at_most_; }

 private:
  static constexpr std::chrono::microseconds shortest{1ms};
  std::chrono::microseconds at_most_{30ms};
};

/// Returns the number of kills; ./dev faults sets URSULA_KILLS to do more.
int killsWanted() {
  const char* wanted = std::getenv("URSULA_KILLS");
  return wanted == nullptr ? 12 : std::atoi(wanted);
}

struct Outcomes {
  int old = 0, fresh = 0;
};

/// Kills runs of `calls`, which write different results into one folder, until some kills came before the swap and some
/// after it. The folder must always contain the results of one run. They are at once inconclusive, because only writing
/// matters here.
void killRuns(const Program& ursula, const std::vector<std::vector<std::string>>& calls) {
  std::vector<std::map<std::string, std::string>> whole;
  std::chrono::microseconds longest{0};
  for (const std::vector<std::string>& call : calls) {
    fs::remove_all(ursula.folder() / "out");
    const auto start = std::chrono::steady_clock::now();
    Running(ursula, call).wait();
    longest = std::max(longest,
                       std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - start));
    ursula.write("out/note", "mine");
    whole.push_back(contents(ursula.folder() / "out"));
  }
  EXPECT_FALSE(whole[0] == whole[1]) << "or nothing would be seen";
  std::mt19937 random(20261122);
  std::size_t current = 1;
  Outcomes outcomes;
  const auto seenBoth = [&outcomes] { return outcomes.old > 0 && outcomes.fresh > 0; };
  AroundTheSwap around;
  for (int k = 0; k < killsWanted() || (!seenBoth() && k < 10 * killsWanted()); ++k) {
    const bool while_writing = k % 2 == 0;
    killSomewhere(ursula, calls[1 - current], while_writing ? around.atMost() : longest, while_writing, random);
    const auto found = contents(ursula.folder() / "out");
    EXPECT_TRUE(found == whole[0] || found == whole[1]) << "kill " << k << " left a mixture";
    const bool is_new = found == whole[1 - current];
    ++(is_new ? outcomes.fresh : outcomes.old);
    if (while_writing) around.learn(is_new);
    if (is_new) current = 1 - current;
  }
  Running(ursula, calls[0]).wait();
  EXPECT_TRUE(contents(ursula.folder() / "out") == whole[0]);
  for (const auto& entry : fs::directory_iterator(ursula.folder()))
    EXPECT_NE(entry.path().filename().string().find(".ursula"), 0u) << entry << " of a run that was killed";
  EXPECT_GT(outcomes.old, 0);
  EXPECT_GT(outcomes.fresh, 0);
  testing::Test::RecordProperty("killed_before_the_swap", outcomes.old);
  testing::Test::RecordProperty("killed_after_the_swap", outcomes.fresh);
}

TEST(WholeResults, ofARunThatIsKilledAreTheOldOrTheNew) {
  const Program ursula;
  ursula.write("a.toml", quickScenario("one"));
  ursula.write("b.toml", quickScenario("one", "499.0"));
  killRuns(ursula, {{"validate", "a.toml", "--out", "out", "--time-limit", "1e-9"},
                    {"validate", "b.toml", "--out", "out", "--time-limit", "1e-9"}});
}

TEST(WholeResults, ofASuiteThatIsKilledAreTheOldOrTheNew) {
  const Program ursula;
  for (const char* mass : {"500.0", "499.0"})
    for (const char* name : {"one", "two"}) ursula.write(std::string(name) + mass + ".toml", quickScenario(name, mass));
  const auto call = [](const std::string& mass) -> std::vector<std::string> {
    return {"validate", "one" + mass + ".toml", "two" + mass + ".toml", "--out", "out", "--jobs", "2", "--time-limit",
            "1e-9"};
  };
  killRuns(ursula, {call("500.0"), call("499.0")});
}

TEST(WholeResults, ofASecondRunIntoOneFolderAreRefused) {
  const Program ursula;
  ursula.write("a.toml", quickScenario("one"));
  const fs::path lock = ursula.write(".ursula-lock-" + sha1("out").substr(0, 12), "4711\n");
  const int held = ::open(lock.c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(::flock(held, LOCK_EX), 0);
  const UrsulaRun second = ursula.ending(2, "validate a.toml --out out");
  EXPECT_EQ(second.err,
            "error: out: another run (process 4711) is writing there, expected a folder that no other run has\n");
  EXPECT_FALSE(fs::exists(ursula.folder() / "out"));
  ursula.ending(inconclusive, "validate a.toml --out other --quiet --time-limit 1e-9");
  ::close(held);
  ursula.ending(inconclusive, "validate a.toml --out out --quiet --time-limit 1e-9");
  EXPECT_FALSE(fs::exists(lock));
}

TEST(WholeResults, whereNoMoreCanBeWrittenAreTheOldOnes) {
  const Program ursula;
  ursula.write("a.toml", quickScenario("one"));
  ursula.write("b.toml", quickScenario("two"));
  for (const char* what : {"a.toml", "a.toml b.toml"}) {
    const std::string call = std::string("validate ") + what + " --quiet --time-limit 1e-9 --out out";
    ursula.ending(inconclusive, call);
    const auto before = contents(ursula.folder());
    EXPECT_EQ(shell(ursula, "ulimit -f 64; \"$URSULA\" " + call + " 2>/dev/full"), 2);
    EXPECT_TRUE(contents(ursula.folder()) == before) << what;
    EXPECT_EQ(shell(ursula, "ulimit -f 64; \"$URSULA\" " + call + " 2>err"), 2);
    EXPECT_THAT(ursula.read("err"), AllOf(HasSubstr("error: cannot write out/"), HasSubstr(": File too large\n")));
    fs::remove_all(ursula.folder() / "out");
    fs::remove(ursula.folder() / "err");
  }
}

TEST(WholeResults, thatCannotBeWrittenAreRefusedBeforeAnythingIsComputed) {
  const Program ursula;
  const std::string long_name(300, 'n');
  ursula.write("a.toml", quickScenario("one"));
  ursula.write("b.toml", quickScenario("two"));
  fs::create_directories(ursula.folder() / "out");
  fs::create_directories(ursula.folder() / "closed");
  ursula.write("out/two", "a file where a folder should be");
  fs::permissions(ursula.folder() / "closed", fs::perms(0555));
  const auto before = contents(ursula.folder());
  const std::vector<std::pair<std::string, std::string>> calls = {
      {"a.toml --out new/" + long_name, "File name too long"},
      {"a.toml b.toml --out new/" + long_name, "File name too long"},
      {"a.toml b.toml --out out", "two is a file, expected a folder"},
      {"a.toml b.toml --out out/two/deeper", "two is a file, expected a folder"},
      {"a.toml b.toml --out closed/new", "closed is read-only"},
      {"a.toml --out closed", "closed is read-only"},
      {"a.toml --out .", ".: is the working folder, expected another folder, such as ./results"},
  };
  for (const auto& [call, why] : calls) {
    const UrsulaRun run = ursula.ending(2, "validate " + call);
    EXPECT_THAT(run.err, AllOf(HasSubstr("error: cannot write "), HasSubstr(why), testing::Not(HasSubstr("[1/2]"))))
        << call;
    EXPECT_EQ(contents(ursula.folder()), before) << call;
    for (const char* made : {"results", "new", "closed/new"}) EXPECT_FALSE(fs::exists(ursula.folder() / made)) << call;
  }
  fs::permissions(ursula.folder() / "closed", fs::perms(0755));
}

TEST(WholeResults, replaceNothingThatIsRead) {
  const Program ursula;
  ursula.write("a.toml", quickScenario("one"));
  ursula.passing("inverse a.toml --samples 41 --out out/timeseries.csv");
  ursula.write("out/summary.json", quickScenario("two"));
  const std::string samples = quickScenario("one");
  ursula.write("sampled.toml", samples.substr(0, samples.find("[trajectory]")) +
                                   "[trajectory]\nkind = \"samples\"\nfile = \"out/timeseries.csv\"\n");
  fs::create_directory(ursula.folder() / "side");
  for (const char* copy : {"out/efforts.csv", "side/engines.csv"})
    ursula.write(copy, ursula.read("out/timeseries.csv"));
  ursula.write("motion.toml", replaced(ursula.read("sampled.toml"), "out/timeseries", "side/engines"));
  ASSERT_EQ(ursula("check sampled.toml").exit_code, 0) << ursula("check sampled.toml").err;
  const auto before = contents(ursula.folder());
  for (const char* call :
       {"validate a.toml --torques out/timeseries.csv", "validate out/summary.json", "validate a.toml out/summary.json",
        "validate sampled.toml", "identify a.toml --measured ./out/efforts.csv"}) {
    const UrsulaRun run = ursula.ending(2, std::string(call) + " --out out");
    EXPECT_THAT(run.err,
                AllOf(HasSubstr("results would replace "), HasSubstr(", which is read, expected another folder")))
        << call;
    EXPECT_TRUE(contents(ursula.folder()) == before) << call;
  }
  EXPECT_THAT(ursula("engines motion.toml --out side").err, HasSubstr("results would replace "));
  for (const char* call :
       {"inverse sampled.toml --out out/timeseries.csv", "inverse a.toml --samples 3 --out ./b/../a.toml",
        "map sampled.toml --x -0.1,0.1,2 --out out/../out/timeseries.csv",
        "map sampled.toml --x -0.1,0.1,2 --y 0,1,2 --picture out/timeseries.csv",
        "poses sampled.toml --out out/timeseries.csv",
        "simulate sampled.toml --torques a.toml --out out/timeseries.csv",
        "check sampled.toml --picture out/timeseries.csv", "check a.toml --picture a.toml"}) {
    const UrsulaRun run = ursula.ending(2, call);
    EXPECT_THAT(run.err, testing::ContainsRegex("reads this file, expected another file")) << call;
    EXPECT_TRUE(contents(ursula.folder()) == before) << call;
  }
  expectRefused(ursula, {{"map a.toml --picture same --out same", " also writes this file, expected another file"}});
  ursula.passing("map a.toml --picture /dev/null --out /dev/null --x=0,1,2 --y=0,1,2");
  ursula.passing("validate a.toml --torques out/timeseries.csv --out elsewhere");
  const UrsulaRun into = ursula.ending(2, "compare elsewhere/timeseries.csv elsewhere/timeseries.csv --out elsewhere");
  EXPECT_THAT(into.err, HasSubstr("--out elsewhere: has the results of a validation, expected another folder"));
  ursula.passing("compare elsewhere elsewhere --out compared");
  ursula.ending(2, "inverse a.toml --out new/");
  EXPECT_FALSE(fs::exists(ursula.folder() / "new"));
}

TEST(WholeResults, ofTwoRunsAreNotCompared) {
  const Program ursula;
  ursula.write("a.toml", quickScenario("one"));
  ursula.write("b.toml", quickScenario("one", "499.0"));
  ursula.passing("validate a.toml --quiet --out a");
  ursula.passing("validate b.toml --quiet --out b");
  ursula.passing("compare a a");
  fs::copy_file(ursula.folder() / "b/timeseries.csv", ursula.folder() / "a/timeseries.csv",
                fs::copy_options::overwrite_existing);
  for (const char* call : {"compare a b", "compare b a", "open a"}) {
    const UrsulaRun mixed = ursula.ending(2, call);
    EXPECT_THAT(mixed.err, HasSubstr("a/timeseries.csv: error: is not of the run ")) << call;
  }
}

}  // namespace
}  // namespace ursula

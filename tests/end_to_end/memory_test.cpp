// A run with less and less memory gives its usual results, or is refused and leaves the old ones.
//
// The limits are of the address space, because a shell can limit nothing else. Program and libraries alone take some 45
// MB of it; below that the loader fails before the program starts.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/end_to_end/quick_runs.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;

constexpr int passed = 0, in_error_of_suite = 1, refused = 2, in_error_of_sweep = 3;
constexpr int limits[] = {250, 150, 80, 60};  // MB

/// Runs under a limit. If a signal ends the program, the shell's exit code is 128 or more.
int limited(const Program& ursula, int megabytes, const std::string& arguments) {
  return shell(ursula,
               "ulimit -v " + std::to_string(1000 * megabytes) + " && \"$URSULA\" " + arguments + " >said 2>err");
}

std::string complaint(const Program& ursula) { return ursula.read("err"); }

const auto saysMemory = AnyOf(HasSubstr("out of memory"), HasSubstr("llocate memory"), HasSubstr("no memory"));

/// A call that writes below "at", with the content of that folder.
class Call {
 public:
  Call(const Program& program, std::string arguments) : ursula(program), arguments_(std::move(arguments)) {
    fs::remove_all(at());
    fs::remove_all(ursula.folder() / "old");
    fs::create_directory(ursula.folder() / "old");
    ursula.write("old/note", "mine");
  }

  const fs::path at() const { return ursula.folder() / "at"; }

  /// Runs with so much memory, or without a limit.
  int run(int megabytes = 0) const {
    fs::remove_all(at());
    fs::copy(ursula.folder() / "old", at(), fs::copy_options::recursive);
    return megabytes > 0 ? limited(ursula, megabytes, arguments_)
                         : shell(ursula, "\"$URSULA\" " + arguments_ + " >said 2>err");
  }

  std::map<std::string, std::string> results() const { return contents(at()); }
  std::map<std::string, std::string> old() const { return contents(ursula.folder() / "old"); }

  const Program& ursula;

 private:
  std::string arguments_;
};

/// Returns the number of refused runs.
int holdsUnderEveryLimit(const Call& call) {
  EXPECT_EQ(call.run(), passed) << complaint(call.ursula);
  const auto fresh = call.results(), old = call.old();
  EXPECT_NE(fresh, old) << "or nothing would be seen";
  int times_refused = 0;
  for (const int limit : limits) {
    const int exit_code = call.run(limit);
    const std::string where = std::to_string(limit) + " MB: exit " + std::to_string(exit_code);
    EXPECT_TRUE(exit_code == passed || exit_code == refused) << where << ", " << complaint(call.ursula);
    EXPECT_TRUE(call.results() == (exit_code == passed ? fresh : old)) << where;
    if (exit_code == passed) continue;
    EXPECT_THAT(complaint(call.ursula), saysMemory) << where;
    ++times_refused;
  }
  testing::Test::RecordProperty("refused", times_refused);
  return times_refused;
}

TEST(LittleMemory, aRunPassesOrLeavesTheOldResults) {
  const Program ursula;
  ursula.write("a.toml", quickScenario("one"));
  ursula.write("b.toml", quickScenario("one", "499.0"));
  const Call call(ursula, "validate a.toml --jobs 2 --out at/out");
  ursula.passing("validate b.toml --quiet --out old/out");
  holdsUnderEveryLimit(call);
}

TEST(LittleMemory, aFileIsWholeOrTheOldOne) {
  const Program ursula;
  ursula.write("a.toml", quickScenario("one"));
  for (const char* arguments :
       {"inverse a.toml --samples 20001 --jobs 7 --out at/out.csv",
        "map a.toml --x=-0.1,0.1,60 --y=-0.1,0.1,60 --jobs 7 --out at/out.csv", "check a.toml --picture at/out.csv"}) {
    const Call call(ursula, arguments);
    ursula.write("old/out.csv", "old\n");
    holdsUnderEveryLimit(call);
  }
}

/// Each of two tables takes more than the smallest limit.
TEST(LittleMemory, whatNeedsMoreThanThereIsIsRefused) {
  const Program ursula;
  ursula.write("a.toml", quickScenario("one"));
  ursula.passing("inverse a.toml --samples 40001 --out big.csv");
  const Call call(ursula, "compare big.csv big.csv --out at/out.csv");
  ursula.write("old/out.csv", "old\n");
  const int times_refused = holdsUnderEveryLimit(call);
  EXPECT_GT(times_refused, 0) << "or no limit was felt";
  EXPECT_LT(times_refused, static_cast<int>(std::size(limits))) << "or nothing but the limit was";
}

std::string withSamples(int count) {
  return replaced(quickScenario("one"), "samples = 3", "samples = " + std::to_string(count));
}

/// A sample takes some 5 kB. Twice as much would not fit, nor would an arena for each thread.
TEST(LittleMemory, manySamplesFit) {
  const Program ursula;
  ursula.write("a.toml", withSamples(4000));
  ASSERT_EQ(shell(ursula, "ulimit -v 150000 && \"$URSULA\" validate a.toml --jobs 1 --out out 2>err"), passed)
      << complaint(ursula);
  const std::string series = ursula.read("out/timeseries.csv");
  EXPECT_EQ(std::count(series.begin(), series.end(), '\n'), 4001);
}

/// The message names what would need less memory, in the terms of the verb.
TEST(LittleMemory, isExplainedByWhatTheVerbHas) {
  const Program ursula;
  ursula.write("a.toml", withSamples(1000000));
  ASSERT_EQ(limited(ursula, 250, "validate a.toml --quiet --jobs 1 --out out"), refused);
  EXPECT_THAT(complaint(ursula), HasSubstr("samples in the scenario's [simulation]"));
  EXPECT_THAT(complaint(ursula), Not(HasSubstr("--samples")));
  ASSERT_EQ(limited(ursula, 80, "poses a.toml --samples 1000000 --out out.csv"), refused);
  EXPECT_THAT(complaint(ursula), HasSubstr("fewer --samples need less"));
}

/// One scenario of a suite may end with an error that says why; the other is judged as usual.
TEST(LittleMemory, oneOfASuiteIsInErrorOrWhatItIsAnywhere) {
  const Program ursula;
  for (const char* name : {"one", "two"}) ursula.write(std::string(name) + ".toml", quickScenario(name));
  const Call call(ursula, "validate one.toml two.toml --jobs 2 --out at/out");
  ASSERT_EQ(call.run(), passed) << complaint(ursula);
  const auto fresh = call.results();
  for (const int limit : {250, 150}) {
    const int exit_code = call.run(limit);
    ASSERT_TRUE(exit_code == passed || exit_code == in_error_of_suite || exit_code == refused)
        << limit << " MB: exit " << exit_code << ", " << complaint(ursula);
    const auto found = call.results();
    for (const auto& [file, content] : found) EXPECT_TRUE(fresh.count(file) == 1 && fresh.at(file) == content) << file;
    if (exit_code == in_error_of_suite) {
      EXPECT_THAT(complaint(ursula) + ursula.read("said"), saysMemory) << limit;
    } else {
      EXPECT_TRUE(found == (exit_code == passed ? fresh : call.old())) << limit;
    }
  }
}

const std::string small_sweep = massSweep("a.toml", "pointwise = true\ncount = 12\n");

/// A sweep computes the points that failed for lack of memory once there is enough.
TEST(LittleMemory, losesNoRowOfASweep) {
  const Program ursula;
  ursula.write("a.toml", quickScenario("one"));
  ursula.write("s.toml", small_sweep);
  const auto rows = [&ursula](const std::string& database) {
    return ursula("sweep report " + database + " --csv -").out;
  };
  ursula.passing("sweep s.toml --db fresh.db");
  const std::string fresh = rows("fresh.db");
  ASSERT_EQ(std::count(fresh.begin(), fresh.end(), '\n'), 13);
  for (const int limit : limits) {
    fs::remove(ursula.folder() / "s.db");
    const int exit_code = limited(ursula, limit, "sweep s.toml --db s.db --jobs 2");
    ASSERT_TRUE(exit_code == passed || exit_code == refused || exit_code == in_error_of_sweep)
        << limit << " MB: exit " << exit_code << ", " << complaint(ursula);
    if (exit_code == passed) {
      EXPECT_EQ(rows("s.db"), fresh) << limit;
      continue;
    }
    EXPECT_THAT(complaint(ursula) + rows("s.db"), saysMemory) << limit;
    ursula.passing("sweep s.toml --db s.db --retry-errors");
    EXPECT_EQ(rows("s.db"), fresh) << limit;
  }
}

}  // namespace
}  // namespace ursula

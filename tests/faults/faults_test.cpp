// The built program, while one writing system call after another fails. Afterwards there are the whole old or the whole
// new results, and the exit code says which.

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/end_to_end/quick_runs.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

namespace fs = std::filesystem;

struct Call {
  std::string name, path;
};

/// A call of the program whose writes below "at" are counted or disturbed.
class Disturbed {
 public:
  explicit Disturbed(std::string arguments) : arguments_(std::move(arguments)) {
    fs::create_directory(ursula.folder() / "at");
  }

  /// Returns the exit code while call number `at` fails; none fails for 0.
  int run(long at, int error = EIO) const {
    fs::remove(ursula.folder() / "log");
    return shell(ursula, "LD_PRELOAD='" URSULA_FAULT_SHIM "' FAULTS_LOG=log FAULTS_FOLDER=\"$PWD/at\" FAULTS_AT=" +
                             std::to_string(at) + " FAULTS_ERROR=" + std::to_string(error) + " \"$URSULA\" " +
                             arguments_ + " >said 2>err");
  }

  std::vector<Call> calls() const {
    std::istringstream log(ursula.read("log"));
    std::vector<Call> all;
    long number = 0;
    Call call;
    while (log >> number >> call.name && std::getline(log, call.path)) all.push_back(call);
    return all;
  }

  std::string complaint() const { return ursula.read("err"); }

  const Program ursula;

 private:
  std::string arguments_;
};

std::set<std::string> namesOf(const std::vector<Call>& calls) {
  std::set<std::string> names;
  for (const Call& call : calls) names.insert(call.name);
  return names;
}

/// Returns the indices of the calls that shall fail: all if URSULA_EVERY_CALL is set (./dev faults), else a sample with
/// the first and last of each name.
std::set<std::size_t> failing(const std::vector<Call>& calls) {
  constexpr std::size_t wanted = 16;
  const std::size_t step =
      std::getenv("URSULA_EVERY_CALL") != nullptr ? 1 : std::max<std::size_t>(1, calls.size() / wanted);
  std::set<std::size_t> chosen;
  std::map<std::string, std::pair<std::size_t, std::size_t>> ends;
  for (std::size_t k = 0; k < calls.size(); ++k) {
    if (k % step == 0) chosen.insert(k);
    ends.try_emplace(calls[k].name, k, k).first->second.second = k;
  }
  for (const auto& [name, end] : ends) chosen.insert({end.first, end.second});
  return chosen;
}

/// Returns the results under their final names.
std::map<std::string, std::string> results(const fs::path& folder) {
  auto all = contents(folder);
  for (auto each = all.begin(); each != all.end();)
    each = each->first.find(".ursula") == 0 ? all.erase(each) : std::next(each);
  return all;
}

std::string leftovers(const fs::path& folder) {
  std::string found;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().filename().string().find(".ursula") == 0) found += entry.path().string() + ' ';
  return found;
}

/// After every failure the results must be those of an undisturbed run, old or new. `prepare` runs before each.
void holdsThroughEveryFailure(const Disturbed& disturbed, const std::function<void()>& prepare,
                              const std::set<std::string>& expected_calls) {
  const fs::path at = disturbed.ursula.folder() / "at";
  prepare();
  const auto old = results(at);
  const int undisturbed = disturbed.run(0);
  ASSERT_TRUE(undisturbed == 0 || undisturbed == 3) << disturbed.complaint();
  const auto fresh = results(at);
  const std::vector<Call> calls = disturbed.calls();
  ASSERT_NE(old, fresh) << "or nothing would be seen";
  for (const std::string& name : expected_calls) EXPECT_EQ(namesOf(calls).count(name), 1u) << name << " is not counted";
  int refused = 0;
  for (const std::size_t k : failing(calls)) {
    const std::string where = std::to_string(k + 1) + ": " + calls[k].name + calls[k].path;
    prepare();
    const int exit_code = disturbed.run(static_cast<long>(k + 1), k % 2 == 0 ? EIO : ENOSPC);
    ASSERT_GT(disturbed.calls().size(), k) << where << " was not reached";
    ASSERT_TRUE(exit_code == undisturbed || exit_code == 2)
        << where << ": exit " << exit_code << ", " << disturbed.complaint();
    EXPECT_TRUE(results(at) == (exit_code == 2 ? old : fresh)) << where << ": exit " << exit_code;
    if (exit_code == 2) {
      EXPECT_THAT(disturbed.complaint(), HasSubstr("error: ")) << where;
    }
    refused += exit_code == 2;
    if (leftovers(at).empty()) continue;  // nothing was left, so the next run is like any other
    ASSERT_EQ(disturbed.run(0), undisturbed) << disturbed.complaint();
    EXPECT_TRUE(results(at) == fresh) << "after " << where;
    EXPECT_EQ(leftovers(at), "") << "after " << where;
  }
  EXPECT_GT(refused, 0);
  testing::Test::RecordProperty("calls", static_cast<int>(calls.size()));
  testing::Test::RecordProperty("refused", refused);
  std::cout << calls.size() << " calls, " << failing(calls).size() << " of them failed, " << refused << " refused\n";
}

void putOld(const Disturbed& disturbed, const fs::path& old) {
  fs::remove_all(disturbed.ursula.folder() / "at");
  fs::copy(old, disturbed.ursula.folder() / "at", fs::copy_options::recursive);
}

/// The validations end at once as inconclusive, because only writing matters here.
TEST(Faults, leaveARunsResultsWhole) {
  const Disturbed disturbed("validate a.toml --time-limit 1e-9 --out at/out");
  disturbed.ursula.write("a.toml", quickScenario("one"));
  disturbed.ursula.write("b.toml", quickScenario("one", "499.0"));
  disturbed.ursula.ending(3, "validate b.toml --time-limit 1e-9 --out old/out");
  disturbed.ursula.write("old/out/note", "mine");
  holdsThroughEveryFailure(
      disturbed, [&] { putOld(disturbed, disturbed.ursula.folder() / "old"); },
      {"mkdir", "open", "write", "fsync", "rename", "renameat2", "close", "flock", "linkat", "unlink"});
}

TEST(Faults, leaveASuitesResultsWhole) {
  const Disturbed disturbed("validate a.toml b.toml --jobs 1 --time-limit 1e-9 --out at/out");
  disturbed.ursula.write("a.toml", quickScenario("one"));
  disturbed.ursula.write("b.toml", quickScenario("two"));
  holdsThroughEveryFailure(disturbed,
                           [&] {
                             fs::remove_all(disturbed.ursula.folder() / "at");
                             fs::create_directory(disturbed.ursula.folder() / "at");
                             disturbed.ursula.write("at/note", "mine");
                           },
                           {"mkdir", "open", "write", "fsync", "rename", "close"});
}

TEST(Faults, leaveAFileWhole) {
  for (const char* call :
       {"inverse a.toml --samples 300 --out at/out.csv", "map a.toml --x -0.1,0.1,3 --y -0.1,0.1,3 --out at/out.csv",
        "compare a.csv a.csv --out at/out.csv", "simulate a.toml --torques a.csv --out at/out.csv"}) {
    const Disturbed disturbed(call);
    disturbed.ursula.write("a.toml", quickScenario("one"));
    disturbed.ursula.passing("inverse a.toml --samples 9 --out a.csv");
    holdsThroughEveryFailure(disturbed, [&] { disturbed.ursula.write("at/out.csv", "old\n"); },
                             {"open", "write", "fsync", "rename", "close"});
  }
}

/// Returns the content of a sweep's database, without computing times.
std::string rowsOf(const fs::path& file) {
  sqlite3* database = nullptr;
  std::string all;
  const auto add = [](void* text, int columns, char** values, char** names) {
    for (int c = 0; c < columns; ++c)
      if (std::string(names[c]) != "seconds")
        *static_cast<std::string*>(text) += std::string(values[c] ? values[c] : "-") + ' ';
    *static_cast<std::string*>(text) += '\n';
    return 0;
  };
  if (sqlite3_open_v2(file.c_str(), &database, SQLITE_OPEN_READWRITE, nullptr) == SQLITE_OK)
    for (const char* query :
         {"SELECT * FROM point ORDER BY id", "SELECT * FROM result ORDER BY 1, 2", "PRAGMA integrity_check"})
      if (sqlite3_exec(database, query, add, &all, nullptr) != SQLITE_OK) all += sqlite3_errmsg(database);
  sqlite3_close(database);
  return all;
}

const std::string small_sweep = massSweep("a.toml", "what = \"inverse\"\ncount = 40\nsamples = 5\n");

/// The failing call may end the sweep, which continues at the next call. The rows must be those of an undisturbed
/// sweep.
void holdsRowsThroughEveryFailure(const Disturbed& disturbed, const std::set<std::string>& expected_calls) {
  const fs::path at = disturbed.ursula.folder() / "at", database = at / "s.db";
  ASSERT_EQ(disturbed.run(0), 0) << disturbed.complaint();
  const std::string rows = rowsOf(database);
  ASSERT_THAT(rows, testing::EndsWith("ok \n"));
  ASSERT_GT(std::count(rows.begin(), rows.end(), '\n'), 80);
  const std::vector<Call> calls = disturbed.calls();
  for (const std::string& name : expected_calls) EXPECT_EQ(namesOf(calls).count(name), 1u) << name << " is not counted";
  int refused = 0;
  for (const std::size_t k : failing(calls)) {
    const std::string where = std::to_string(k + 1) + ": " + calls[k].name + calls[k].path;
    fs::remove_all(at);
    fs::create_directory(at);
    const int exit_code = disturbed.run(static_cast<long>(k + 1), k % 2 == 0 ? EIO : ENOSPC);
    ASSERT_TRUE(exit_code == 0 || exit_code == 2) << where << ": exit " << exit_code << ", " << disturbed.complaint();
    if (exit_code == 0) {
      EXPECT_TRUE(rowsOf(database) == rows) << where;
    }
    if (exit_code == 2) {
      EXPECT_THAT(disturbed.complaint(), HasSubstr("error: ")) << where;
    }
    refused += exit_code == 2;
    if (exit_code == 0) continue;
    ASSERT_EQ(disturbed.run(0), 0) << "after " << where << ": " << disturbed.complaint();
    EXPECT_TRUE(rowsOf(database) == rows) << "after " << where;
  }
  EXPECT_GT(refused, 0);
  testing::Test::RecordProperty("calls", static_cast<int>(calls.size()));
  testing::Test::RecordProperty("refused", refused);
  std::cout << calls.size() << " calls, " << failing(calls).size() << " of them failed, " << refused << " refused\n";
}

TEST(Faults, loseNoRowOfASweep) {
  const Disturbed disturbed("sweep s.toml --db at/s.db --jobs 1");
  disturbed.ursula.write("a.toml", quickScenario("one"));
  disturbed.ursula.write("s.toml", small_sweep);
  holdsRowsThroughEveryFailure(disturbed, {"open64", "pwrite64", "fcntl64", "mmap64", "close"});
}

TEST(Faults, loseNoRowOfAMerge) {
  const Disturbed disturbed("sweep merge 1.db 2.db --db at/s.db");
  disturbed.ursula.write("a.toml", quickScenario("one"));
  disturbed.ursula.write("s.toml", small_sweep);
  for (const char* shard : {"1", "2"})
    disturbed.ursula.passing(std::string("sweep s.toml --shard ") + shard + "/2 --db " + shard + ".db");
  holdsRowsThroughEveryFailure(disturbed, {"open64", "pwrite64", "fcntl64", "mmap64", "close"});
}

}  // namespace
}  // namespace ursula

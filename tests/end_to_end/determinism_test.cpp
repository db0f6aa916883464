// The same input gives the same bytes: again, for any number of --jobs, in another folder, time zone and locale.

#include <gtest/gtest.h>

#include <memory>
#include <regex>

#include "tests/end_to_end/quick_runs.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;

const std::string random_sweep = massSweep("one.toml", "what = \"inverse\"\ncount = 30\nseed = 1\nsamples = 5\n");

/// Calls every verb that writes results, into the folder `out`; $1 is the number of --jobs.
constexpr const char* all_verbs = R"(set -e
rm -rf out && mkdir out
"$URSULA" validate one.toml --jobs $1 --out out/one >out/said.one
"$URSULA" validate one.toml two.toml --jobs $1 --out out/suite >out/said.suite
"$URSULA" inverse one.toml --samples 501 --jobs $1 --out out/inverse.csv
"$URSULA" inverse one.toml --samples 501 --jobs $1 --format binary --out out/inverse.bin
"$URSULA" map one.toml --x=-0.1,0.1,20 --y=-0.1,0.1,20 --jobs $1 --out out/map.csv --picture out/map.svg
"$URSULA" poses one.toml --samples 200 --out out/poses.csv
"$URSULA" simulate one.toml --torques torques.csv --out out/simulate.csv
for sweep in random pointwise; do
  rm -f $sweep.db && "$URSULA" sweep $sweep.toml --jobs $1 --db $sweep.db >out/said.$sweep
  "$URSULA" sweep report $sweep.db --csv out/$sweep.csv --out out/$sweep
done
)";

/// The number of fields that may differ: durations and start times.
constexpr int times_in_all =
    11;  // junit.xml of one, of two, and of each of these; suite.json and index.html: all, each

std::string withoutTimes(const std::string& text, int& times) {
  static const std::regex time(
      " time=\"[0-9]+\\.[0-9]{3}\" timestamp=\"[-0-9]{10}T[:0-9]{8}\"|\"seconds\": [0-9.e-]+|[0-9.]+ s of computing in "
      "all|data-value=\"[0-9]+\\.[0-9]{3}\">[0-9]+\\.[0-9]<");
  times +=
      static_cast<int>(std::distance(std::sregex_iterator(text.begin(), text.end(), time), std::sregex_iterator()));
  return std::regex_replace(text, time, "(time)");
}

/// Returns the files of `out` without their times, which only some formats have.
Files filesOf(const fs::path& out) {
  Files all;
  int times = 0;
  for (const auto& entry : fs::recursive_directory_iterator(out)) {
    if (entry.is_directory()) continue;
    const std::string file = entry.path().filename(), content = TemporaryFolder::read(entry.path());
    const bool has_times = file == "junit.xml" || file == "suite.json" || file == "index.html";
    all[entry.path().lexically_relative(out)] = has_times ? withoutTimes(content, times) : content;
  }
  EXPECT_EQ(times, times_in_all);
  return all;
}

void write(const fs::path& folder, const std::string& scenario, const std::string& second) {
  const auto put = [&folder](const char* name, const std::string& text) { std::ofstream(folder / name) << text; };
  fs::create_directories(folder);
  put("one.toml", scenario);
  put("two.toml", second);
  put("random.toml", random_sweep);
  const std::string pointwise = replaced(replaced(random_sweep, "inverse", "validate"), "random", "sobol");
  put("pointwise.toml", "pointwise = true\n" + replaced(pointwise, "count = 30", "count = 8"));
  put("all.sh", all_verbs);
}

/// A folder with the inputs of all verbs, in which they are called.
class Inputs {
 public:
  explicit Inputs(const Program& program, const std::string& folder = "here",
                  const std::string& of_legs = "length = 1.3")
      : ursula(program), folder_(folder) {
    write(path(), replaced(quickScenario("one"), "length = 1.3", of_legs),
          replaced(quickScenario("two", "499.0"), "length = 1.3", of_legs));
    EXPECT_EQ(in("\"$URSULA\" inverse one.toml --samples 20 --out torques.csv"), 0);
  }

  fs::path path() const { return ursula.folder() / folder_; }
  int in(const std::string& line) const { return shell(ursula, "export URSULA && cd '" + folder_ + "' && " + line); }

  Files results(int jobs, const std::string& environment = "TZ=UTC LC_ALL=C") const {
    EXPECT_EQ(in("env " + environment + " sh all.sh " + std::to_string(jobs) + " >log 2>&1"), 0)
        << TemporaryFolder::read(path() / "log");
    return filesOf(path() / "out");
  }

  const Program& ursula;

 private:
  std::string folder_;
};

std::vector<std::string> differing(const Files& a, const Files& b) {
  std::vector<std::string> names;
  for (const auto& [name, content] : a)
    if (b.count(name) == 0 || b.at(name) != content) names.push_back(name);
  for (const auto& [name, content] : b)
    if (a.count(name) == 0) names.push_back(name);
  return names;
}

/// The results that others are compared with are made once.
class Determinism : public testing::Test {
 protected:
  void SetUp() override {
    if (ursula_) return;
    ursula_ = std::make_unique<Program>();
    inputs_ = std::make_unique<Inputs>(*ursula_);
    first_ = inputs_->results(2);
  }
  static void TearDownTestSuite() { inputs_.reset(), ursula_.reset(); }

  static inline std::unique_ptr<Program> ursula_;
  static inline std::unique_ptr<Inputs> inputs_;
  static inline Files first_;
};

TEST_F(Determinism, ofAnyNumberOfJobs) {
  for (const char* file :
       {"one/summary.json", "one/timeseries.csv", "one/report.html", "one/junit.xml", "suite/suite.json",
        "suite/index.html", "suite/junit.xml", "suite/two/report.html", "random/report.html"})
    EXPECT_EQ(first_.count(file), 1U) << file;
  EXPECT_EQ(differing(first_, inputs_->results(1)), std::vector<std::string>{});
}

/// Control: legs that are a hundredth longer, and another seed, must make a difference.
TEST_F(Determinism, isNotThatNothingIsSeen) {
  const Inputs longer(*ursula_, "longer", "length = 1.313");
  const std::vector<std::string> changed = differing(first_, longer.results(2));
  for (const auto& [name, content] : first_) {
    if (name.find("said.") == 0) continue;
    EXPECT_THAT(changed, testing::Contains(name));
  }
  std::ofstream(inputs_->path() / "2.toml") << replaced(random_sweep, "seed = 1", "seed = 2");
  ASSERT_EQ(inputs_->in("\"$URSULA\" sweep 2.toml --db 2.db >log 2>&1 && \"$URSULA\" sweep report 2.db --csv 2.csv"),
            0);
  EXPECT_NE(TemporaryFolder::read(inputs_->path() / "2.csv"), first_.at("random.csv"));
}

/// The time zone of Kiritimati, UTC+14, as a rule that needs no installed time zones.
constexpr const char* kiritimati = "TZ='<+14>-14'";

TEST_F(Determinism, ofAnyFolderAndTimeZoneAndMoreJobs) {
  for (const auto& [name, content] : first_)
    EXPECT_EQ(content.find(ursula_->folder().string()), std::string::npos) << name << " tells where it was made";
  const Inputs others(*ursula_, "some where/else, with a longer name");
  const std::string before = utcNow();
  EXPECT_EQ(differing(first_, others.results(7, kiritimati)), std::vector<std::string>{});
  const std::string after = utcNow();
  const std::string started = startSaidBy(others.path() / "out/one/junit.xml");
  EXPECT_LE(before, started);
  EXPECT_LE(started, after) << "of UTC, too";
  ASSERT_EQ(inputs_->in(std::string("env ") + kiritimati + " date +%z >zone"), 0);
  EXPECT_EQ(TemporaryFolder::read(inputs_->path() / "zone"), "+1400\n") << "or nothing was tried";
}

constexpr const char* commas = "LC_NUMERIC\ndecimal_point \",\"\nthousands_sep \".\"\ngrouping 3;3\nEND LC_NUMERIC\n";

TEST_F(Determinism, ofALocaleWithDecimalCommas) {
  ursula_->write("commas", commas);
  const std::string shim = "LD_PRELOAD='" URSULA_WORLD_SHIM "' SHIM_DECIMAL_POINT=, ";
  const std::string there = shim + "LOCPATH=\"$PWD/..\" LC_ALL=xx_XX";
  inputs_->in("cd .. && localedef -c -i commas -f ANSI_X3.4-1968 --no-archive ./xx_XX >localedef.log 2>&1");
  if (inputs_->in("env " + there + " true") != 0)
    GTEST_SKIP() << "localedef makes no locale: " << TemporaryFolder::read(ursula_->folder() / "localedef.log");
  EXPECT_EQ(inputs_->in("env " + there + " printf %.1f 1.5 >number"), 0);
  EXPECT_EQ(TemporaryFolder::read(inputs_->path() / "number"), "1,5") << "or nothing is tried";
  EXPECT_EQ(inputs_->in("env " + shim + " LC_ALL=C true"), 99) << "or the shim takes no locale";
  EXPECT_EQ(differing(first_, inputs_->results(2, there)), std::vector<std::string>{});
  EXPECT_THAT(first_.at("inverse.csv"), HasSubstr("."));
}

}  // namespace
}  // namespace ursula

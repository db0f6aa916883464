// Simbody calls the reference LAPACK whatever the machine has. Each LAPACK that is installed is tried, as the machine's
// choice and by force.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/end_to_end/quick_runs.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Folders with a LAPACK and its BLAS. Debian has each implementation in a folder of its own.
std::vector<std::string> installed() {
  const fs::path libraries = URSULA_SYSTEMS_LIBRARIES;
  std::vector<std::string> folders = {(libraries / "lapack").string() + ":" + (libraries / "blas").string()};
  for (const auto& entry : fs::directory_iterator(libraries))
    if (fs::exists(entry.path() / "liblapack.so.3") && fs::exists(entry.path() / "libblas.so.3"))
      folders.push_back(entry.path());
  return folders;
}

/// Judges a quick scenario with these settings of the environment into `out`, and returns the exit code.
int judged(const Program& ursula, const std::string& environment, const std::string& out) {
  ursula.write("a.toml", quickScenario("one"));
  return shell(ursula, environment + " \"$URSULA\" validate a.toml --quiet --jobs 2 --out " + out + " >said 2>err");
}

Json summaryIn(const Program& ursula, const std::string& out) {
  return Json::parse(TemporaryFolder::read(ursula.folder() / out / "summary.json"));
}

std::string lapackIn(const Json& summary) { return summary.at("provenance").at("LAPACK"); }

TEST(MachinesLapack, isNotTheOneThatSimbodyCalls) {
  const Program ursula;
  ASSERT_EQ(judged(ursula, "", "fresh"), 0) << ursula.read("err");
  const auto fresh = contents(ursula.folder() / "fresh");
  const std::string called = lapackIn(summaryIn(ursula, "fresh"));
  EXPECT_EQ(called.rfind("lapack/liblapack.so.3", 0), 0U) << called;
  EXPECT_THAT(called, HasSubstr(", blas/libblas.so.3"));
  for (const std::string& folder : installed()) {
    ASSERT_EQ(judged(ursula, "LD_LIBRARY_PATH=" + folder, "out"), 0) << folder;
    EXPECT_TRUE(contents(ursula.folder() / "out") == fresh) << folder;
  }
  const char* in_ci = std::getenv("CI");
  EXPECT_GT(installed().size(), in_ci != nullptr && in_ci == std::string("true") ? 1U : 0U)
      << "a second LAPACK is to be tried in CI";
}

/// OpenBLAS waits for ever for a buffer of some 100 MB, in threads that it starts when it is loaded.
TEST(MachinesLapack, keepsNoRunFromItsEnd) {
  const Program ursula;
  for (const std::string& folder : installed())
    for (const char* kilobytes : {"250000", "150000", "100000"}) {
      const int exit_code =
          judged(ursula, std::string("ulimit -v ") + kilobytes + "; LD_LIBRARY_PATH=" + folder, "out");
      EXPECT_TRUE(exit_code == 0 || exit_code == 2) << folder << ", " << kilobytes << " kB: exit " << exit_code;
    }
}

/// The control: what is called is said, and then no check differs by more than roundings may.
TEST(MachinesLapack, isSaidAndGivesTheSameVerdictByForce) {
  const Program ursula;
  ASSERT_EQ(judged(ursula, "", "fresh"), 0);
  const Json fresh = summaryIn(ursula, "fresh");
  for (const std::string& folder : installed()) {
    if (folder.find(':') != std::string::npos) continue;  // the reference's own
    ASSERT_EQ(judged(ursula, "LD_PRELOAD=" + folder + "/liblapack.so.3:" + folder + "/libblas.so.3", "out"), 0)
        << folder;
    const Json forced = summaryIn(ursula, "out");
    EXPECT_THAT(lapackIn(forced), HasSubstr(fs::path(folder).filename().string() + "/lib"));
    EXPECT_EQ(forced.at("verdict"), fresh.at("verdict"));
    ASSERT_EQ(forced.at("checks").size(), fresh.at("checks").size());
    for (std::size_t i = 0; i < fresh.at("checks").size(); ++i) {
      const Json &a = fresh.at("checks")[i], &b = forced.at("checks")[i];
      ASSERT_EQ(a.at("name"), b.at("name"));
      if (!a.at("value").is_number()) continue;
      EXPECT_LE(std::abs(a.at("value").get<double>() - b.at("value").get<double>()), a.at("limit").get<double>())
          << folder << ": " << a.at("name");
    }
  }
}

}  // namespace
}  // namespace ursula

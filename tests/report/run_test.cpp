// Files of one run are told from those of another.

#include "report/files/run.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/output_folder.h"
#include "tests/base/temporary_folder.h"
#include "tests/report/report_samples.h"

namespace ursula {
namespace {

/// The results in `a` are of one run; with any of `files` from `b` they are refused.
void expectRefusedOf(const std::filesystem::path& dir, const std::vector<std::string>& files) {
  report::refuseMixture(dir / "a");
  for (const std::string& file : files) {
    std::filesystem::copy(dir / "a", dir / "mixed", std::filesystem::copy_options::recursive);
    std::filesystem::copy(dir / "b" / file, dir / "mixed" / file, std::filesystem::copy_options::overwrite_existing);
    EXPECT_THROW(report::refuseMixture(dir / "mixed"), report::MixedResults) << file;
    std::filesystem::remove_all(dir / "mixed");
  }
}

TEST(Run, isNamedByTheFiles) {
  const TemporaryFolder folder;
  const std::filesystem::path& dir = folder.path();
  writeResults(test::passedSample(), dir / "a");
  writeResults(test::failedSample(), dir / "b");
  const auto run = [&dir](const char* below) {
    const auto summary = nlohmann::json::parse(TemporaryFolder::read(dir / below / "summary.json"));
    return summary.at("provenance").at("run").get<std::string>();
  };
  EXPECT_NE(run("a"), run("b"));
  EXPECT_EQ(run("a").size(), 16u);
  for (const char* file : {"report.html", "junit.xml"})
    EXPECT_NE(TemporaryFolder::read(dir / "a" / file).find(run("a")), std::string::npos) << file;
}

TEST(Run, ofTwoTheFilesAreRefused) {
  const TemporaryFolder folder;
  const std::filesystem::path& dir = folder.path();
  writeResults(test::passedSample(), dir / "a");
  writeResults(test::failedSample(), dir / "b");
  expectRefusedOf(dir, {report::result_files.begin(), report::result_files.end()});
}

/// The folder is swapped, as OutputFolder does, at any moment while its files are read.
TEST(Run, isWholeInAFolderThatIsSwappedMeanwhile) {
  const TemporaryFolder folder;
  const std::filesystem::path &dir = folder.path(), shown = dir / "shown";
  writeResults(test::passedSample(), shown);
  writeResults(test::failedSample(), dir / "next");
  const auto start = std::chrono::steady_clock::now();
  report::refuseMixture(shown);
  const auto look = std::chrono::steady_clock::now() - start;
  constexpr int swaps = 200;
  for (int k = 0; k < swaps; ++k) {
    std::thread swapper([&] {
      std::this_thread::sleep_for(look * k / swaps);
      ASSERT_EQ(::renameat2(AT_FDCWD, shown.c_str(), AT_FDCWD, (dir / "next").c_str(), RENAME_EXCHANGE), 0);
    });
    EXPECT_NO_THROW(report::refuseMixture(shown)) << k;
    swapper.join();
  }
}

TEST(Run, ofASuiteRefusesAnothersScenario) {
  const TemporaryFolder folder;
  const std::filesystem::path& dir = folder.path();
  const auto write = [](ValidationResult result, const std::filesystem::path& to) {
    OutputFolder out(to, report::resultsIn);
    addSuiteIndex({addResults(result, out, "s", {}, Place::in_suite)}, out);
    out.commit();
  };
  write(test::passedSample(), dir / "a");
  write(test::failedSample(), dir / "b");
  expectRefusedOf(dir, {"suite.json", "index.html", "junit.xml", "s/summary.json"});
}

/// A device or a pipe may never end.
TEST(Run, isReadOfFilesAlone) {
  const TemporaryFolder folder;
  const std::filesystem::path& dir = folder.path();
  for (const char* file : {"summary.json", "timeseries.csv", "report.html", "junit.xml"}) {
    writeResults(test::passedSample(), dir / "a");
    std::filesystem::remove(dir / "a" / file);
    std::filesystem::create_symlink("/dev/zero", dir / "a" / file);
    EXPECT_THROW(report::refuseMixture(dir / "a"), report::MixedResults) << file;
    std::filesystem::remove(dir / "a" / file);
    ASSERT_EQ(::mkfifo((dir / "a" / file).c_str(), 0600), 0);
    EXPECT_THROW(report::refuseMixture(dir / "a"), report::MixedResults) << file;
    std::filesystem::remove_all(dir / "a");
  }
}

TEST(Run, ofOldListsItsFilesAndNoOthers) {
  const TemporaryFolder folder;
  const std::filesystem::path& dir = folder.path();
  const std::filesystem::path a = dir / "a";
  EXPECT_TRUE(report::resultsIn(a).empty());
  writeResults(test::passedSample(), a);
  EXPECT_EQ(report::resultsIn(a), Paths(report::result_files.begin(), report::result_files.end()));
  test::writeSuiteIndex({suiteEntry(test::passedSample(), "s")}, a);
  EXPECT_EQ(report::resultsIn(a),
            (Paths{"timeseries.csv", "junit.xml", "report.html", "summary.json", "suite.json", "index.html", "s",
                   "s/timeseries.csv", "s/junit.xml", "s/report.html", "s/summary.json"}));
  for (const char* outside : {"..", "../b", "/tmp"}) {
    std::ofstream(a / "suite.json") << nlohmann::json{{"scenarios", {{{"folder", outside}}}}};
    EXPECT_EQ(report::resultsIn(a).size(), 6u) << outside;
  }
}

}  // namespace
}  // namespace ursula

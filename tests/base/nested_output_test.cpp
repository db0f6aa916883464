// Runs that write in a folder while another run replaces the folder.

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "tests/base/output_runs.h"

namespace ursula {
namespace {

namespace fs = std::filesystem;

/// Runs write in `inner` until `outer` was replaced eight times. Returns the number of runs.
int writeInside(const fs::path& inner, const fs::path& outer) {
  writeRun(outer, "first");
  std::atomic<bool> ends{false};
  std::thread replaces([&] {
    for (int k = 0; k < 8; ++k) writeRun(outer, std::to_string(k));
    ends = true;
  });
  int runs = 0;
  for (; !ends; ++runs) {
    const std::string text = std::to_string(runs);
    EXPECT_NO_THROW(writeRun(inner, text));
    EXPECT_EQ(TemporaryFolder::read(inner / "a"), text);
    EXPECT_EQ(TemporaryFolder::read(inner / "sub/a"), text);
  }
  replaces.join();
  return runs;
}

void expectNothingElse(const fs::path& top) {
  for (const auto& entry : fs::recursive_directory_iterator(top))
    EXPECT_EQ(entry.path().filename().string().rfind(".ursula-", 0), std::string::npos) << entry.path();
}

TEST(NestedOutput, isWholeWhenTheFolderAboveIsReplaced) {
  const TemporaryFolder folder;
  EXPECT_GT(writeInside(folder.path() / "results" / "one", folder.path() / "results"), 0);
  expectNothingElse(folder.path());
}

TEST(NestedOutput, isWholeWhenAFolderFurtherUpIsReplaced) {
  const TemporaryFolder folder;
  EXPECT_GT(writeInside(folder.path() / "results" / "suite" / "one", folder.path() / "results"), 0);
  expectNothingElse(folder.path());
}

}  // namespace
}  // namespace ursula

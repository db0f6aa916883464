#include "model/atomic_file.h"

#include <gmock/gmock.h>

#include <thread>
#include <vector>

#include "temporary_folder.h"

namespace ursula {
namespace {

int filesIn(const std::filesystem::path& folder) {
  return static_cast<int>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(AtomicFile, writesEveryByteAndMakesFolders) {
  const TemporaryFolder folder;
  const std::string content("a\r\nb\0c", 6);
  writeFileAtomically(folder.path() / "deep" / "er" / "file.bin", content);
  EXPECT_EQ(TemporaryFolder::read(folder.path() / "deep" / "er" / "file.bin"), content);
  EXPECT_EQ(filesIn(folder.path() / "deep" / "er"), 1);
}

TEST(AtomicFile, replacesWhatIsThere) {
  const TemporaryFolder folder;
  writeFileAtomically(folder.path() / "file", "a long first text");
  writeFileAtomically(folder.path() / "file", "second");
  EXPECT_EQ(TemporaryFolder::read(folder.path() / "file"), "second");
  EXPECT_EQ(filesIn(folder.path()), 1);
}

TEST(AtomicFile, leavesNothingBehindWhenItFails) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "taken" / "child");
  EXPECT_ANY_THROW(writeFileAtomically(folder.path() / "taken", "a file cannot replace a folder"));
  EXPECT_EQ(filesIn(folder.path()), 1);
  folder.write("plain", "");
  EXPECT_ANY_THROW(writeFileAtomically(folder.path() / "plain" / "below a file", "text"));
}

TEST(AtomicFile, fromManyThreadsIsWholeAtAnyTime) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "file";
  std::vector<std::thread> writers;
  for (char c = 'a'; c < 'e'; ++c)
    writers.emplace_back([&file, c] {
      for (int i = 0; i < 50; ++i) writeFileAtomically(file, std::string(100000, c));
    });
  for (std::thread& writer : writers) writer.join();
  const std::string content = TemporaryFolder::read(file);
  ASSERT_EQ(content.size(), 100000U);
  EXPECT_EQ(content, std::string(100000, content[0]));
  EXPECT_EQ(filesIn(folder.path()), 1);
}

}  // namespace
}  // namespace ursula

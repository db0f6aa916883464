#include "base/output_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <thread>
#include <vector>

#include "tests/base/temporary_folder.h"
#include "tests/model/refusals.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

int filesIn(const std::filesystem::path& folder) {
  return static_cast<int>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(OutputFile, writesEveryByteAndMakesFolders) {
  const TemporaryFolder folder;
  const std::string content("a\r\nb\0c", 6);
  writeFileAtomically(folder.path() / "deep" / "er" / "file.bin", content);
  EXPECT_EQ(TemporaryFolder::read(folder.path() / "deep" / "er" / "file.bin"), content);
  EXPECT_EQ(filesIn(folder.path() / "deep" / "er"), 1);
}

TEST(OutputFile, replacesWhatIsThere) {
  const TemporaryFolder folder;
  writeFileAtomically(folder.path() / "file", "a long first text");
  writeFileAtomically(folder.path() / "file", "second");
  EXPECT_EQ(TemporaryFolder::read(folder.path() / "file"), "second");
  EXPECT_EQ(filesIn(folder.path()), 1);
}

TEST(OutputFile, leavesNothingBehindWhenItFails) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "taken" / "child");
  EXPECT_ANY_THROW(writeFileAtomically(folder.path() / "taken", "a file cannot replace a folder"));
  EXPECT_EQ(filesIn(folder.path()), 1);
  folder.write("plain", "");
  EXPECT_ANY_THROW(writeFileAtomically(folder.path() / "plain" / "below a file", "text"));
}

TEST(OutputFile, takesFreshFoldersAwayWhereItIsNotCommitted) {
  const TemporaryFolder folder;
  {
    OutputFile file(folder.path() / "deep" / "er" / "file");
    file.write("half");
    ASSERT_EQ(filesIn(folder.path()), 1);
  }
  EXPECT_EQ(filesIn(folder.path()), 0);
  std::filesystem::create_directories(folder.path() / "old");
  { const OutputFile file(folder.path() / "old" / "new" / "file"); }
  EXPECT_TRUE(std::filesystem::is_directory(folder.path() / "old")) << "it was there before";
  EXPECT_EQ(filesIn(folder.path() / "old"), 0);
}

TEST(OutputFile, thatASignalEndsLeavesNothing) {
  const TemporaryFolder folder;
  const auto ended = [&] {
    OutputFile file(folder.path() / "new" / "file");
    file.write("half");
    if (filesIn(folder.path() / "new") == 1) std::raise(SIGTERM);  // otherwise the test would see nothing
  };
  EXPECT_EXIT(ended(), testing::KilledBySignal(SIGTERM), "");
  EXPECT_EQ(filesIn(folder.path()), 0);
}

/// No reader takes the temporary file for the file, and the next written file removes it.
TEST(OutputFile, thatIsKilledLeavesTheOldOne) {
  const TemporaryFolder folder;
  folder.write("file", "old");
  const auto ended = [&] {
    OutputFile file(folder.path() / "file");
    file.write("half");
    std::raise(SIGKILL);
  };
  EXPECT_EXIT(ended(), testing::KilledBySignal(SIGKILL), "");
  EXPECT_EQ(TemporaryFolder::read(folder.path() / "file"), "old");
  EXPECT_EQ(filesIn(folder.path()), 2);
  writeFileAtomically(folder.path() / "other", "new");
  EXPECT_EQ(filesIn(folder.path()), 2) << "file and other";
}

TEST(OutputFile, fromManyThreadsIsWholeAtAnyTime) {
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

namespace fs = std::filesystem;

mode_t modeOf(const fs::path& file) {
  struct stat found {};
  return ::lstat(file.c_str(), &found) == 0 ? found.st_mode & 07777 : 0;
}

std::string refusalOf(const fs::path& file) {
  return refusal<std::runtime_error>([&] { writeFileAtomically(file, "new"); });
}

TEST(OutputFile, goesThroughAPipe) {
  const TemporaryFolder folder;
  const fs::path pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string got;
  std::thread reader([&] { got = TemporaryFolder::read(pipe); });
  writeFileAtomically(pipe, "through");
  reader.join();
  EXPECT_EQ(got, "through");
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST(OutputFile, goesToADeviceAndLeavesItOne) {
  const TemporaryFolder folder;
  fs::create_symlink("/dev/null", folder.path() / "link");
  for (const fs::path& device : {fs::path("/dev/null"), folder.path() / "link"}) {
    writeFileAtomically(device, "lost");
    EXPECT_TRUE(fs::is_character_file(device));
  }
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
  EXPECT_THAT(refusalOf("/dev/full"), HasSubstr("cannot write /dev/full: No space left on device"));
}

TEST(OutputFile, toWhatAProcessHasOpenIsAddedThere) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("open", "before, ");
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  writeFileAtomically("/dev/fd/" + std::to_string(descriptor), "after");
  ::close(descriptor);
  EXPECT_EQ(TemporaryFolder::read(file), "before, after");
}

TEST(OutputFile, behindALinkIsTheLinksTarget) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "there");
  folder.write("there/target", "old");
  fs::create_symlink("there/target", folder.path() / "near");
  fs::create_symlink(folder.path() / "near", folder.path() / "far");
  fs::create_symlink("there/none", folder.path() / "dangling");
  for (const char* link : {"far", "dangling"}) {
    writeFileAtomically(folder.path() / link, "new");
    EXPECT_TRUE(fs::is_symlink(folder.path() / link)) << link;
  }
  EXPECT_EQ(TemporaryFolder::read(folder.path() / "there/target"), "new");
  EXPECT_EQ(TemporaryFolder::read(folder.path() / "there/none"), "new");
  EXPECT_EQ(filesIn(folder.path() / "there"), 2);
  fs::create_symlink("circle", folder.path() / "circle");
  EXPECT_THAT(refusalOf(folder.path() / "circle"), HasSubstr("circle: too many symbolic links"));
}

TEST(OutputFile, keepsTheModeAndLeavesOtherNamesOfTheOldFile) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("file", "old"), other = folder.path() / "other";
  fs::create_hard_link(file, other);
  ASSERT_EQ(::chmod(file.c_str(), 0600), 0);
  writeFileAtomically(file, "new");
  EXPECT_EQ(modeOf(file), 0600u);
  EXPECT_EQ(TemporaryFolder::read(file), "new");
  EXPECT_EQ(TemporaryFolder::read(other), "old");
}

/// Root could write it, but is refused, too.
TEST(OutputFile, thatIsReadOnlyOrInAReadOnlyFolderIsRefused) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("file", "old");
  fs::create_symlink(file, folder.path() / "link");
  ASSERT_EQ(::chmod(file.c_str(), 0444), 0);
  EXPECT_EQ(refusalOf(file), "cannot write " + file.string() + ": is read-only");
  EXPECT_THAT(refusalOf(folder.path() / "link"), HasSubstr("link: is read-only"));
  ASSERT_EQ(::chmod(file.c_str(), 0644), 0);
  const fs::path closed = folder.path() / "closed";
  fs::create_directory(closed);
  ASSERT_EQ(::chmod(closed.c_str(), 0555), 0);
  for (const fs::path& below : {closed / "file", closed / "deeper" / "file"})
    EXPECT_THAT(refusalOf(below), HasSubstr("the folder " + closed.string() + " is read-only"));
  EXPECT_EQ(filesIn(closed), 0);
  ASSERT_EQ(::chmod(closed.c_str(), 0755), 0);
  EXPECT_EQ(TemporaryFolder::read(file), "old");
}

TEST(OutputFile, saysWhatIsInTheWay) {
  const TemporaryFolder folder;
  const fs::path plain = folder.write("plain", "");
  EXPECT_THAT(refusalOf(folder.path()), HasSubstr("is a folder, expected a file"));
  EXPECT_THAT(refusalOf(plain / "below" / "file"), HasSubstr(plain.string() + " is a file, expected a folder"));
  EXPECT_THAT(refusalOf(folder.path() / std::string(300, 'n')), HasSubstr("File name too long"));
  EXPECT_THAT(refusalOf(folder.path() / "none" / std::string(300, 'n') / "file"), HasSubstr("File name too long"));
  EXPECT_EQ(filesIn(folder.path()), 1);
}

TEST(OutputFile, removesWhatADeadProcessLeftAndNothingOfALivingOne) {
  const TemporaryFolder folder;
  const fs::path dead = folder.write(".ursula-file-1-0", "half"), living = folder.write(".ursula-file-2-0", "half");
  const fs::path users = folder.write(".ursula-notes", "mine");
  const int held = ::open(living.c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(::flock(held, LOCK_EX), 0);
  writeFileAtomically(folder.path() / "file", "whole");
  EXPECT_FALSE(fs::exists(dead));
  EXPECT_TRUE(fs::exists(living));
  EXPECT_TRUE(fs::exists(users));
  ::close(held);
}

}  // namespace
}  // namespace ursula

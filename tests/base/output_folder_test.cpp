// Output folders: as a whole or not at all, whatever happens meanwhile to them or to the folders above.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <stdexcept>
#include <thread>

#include "base/output_folder.h"
#include "base/sha1.h"
#include "tests/base/output_runs.h"
#include "tests/model/refusals.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

namespace fs = std::filesystem;
using testing::Pair;

TEST(OutputFolder, isThereAsAWholeOnceItIsCommitted) {
  const TemporaryFolder folder;
  const fs::path dir = folder.path() / "deep" / "dir";
  {
    OutputFolder out(dir, older);
    out.write("a", "text");
    EXPECT_FALSE(fs::exists(dir));
    out.commit();
  }
  EXPECT_THAT(contents(folder.path()),
              ElementsAre(Pair("deep/", ""), Pair("deep/dir/", ""), Pair("deep/dir/a", "text")));
}

TEST(OutputFolder, takesAFilePieceByPiece) {
  const TemporaryFolder folder;
  const fs::path dir = folder.path() / "dir";
  {
    OutputFolder out(dir, older);
    out.write("a", [](const OutputFolder::Take& take) {
      for (const char* piece : {"one,", "", "two"}) take(piece);
    });
    EXPECT_THROW(out.write("b", [](const OutputFolder::Take&) { throw std::domain_error("no more"); }),
                 std::domain_error);
    out.commit();
  }
  EXPECT_EQ(TemporaryFolder::read(dir / "a"), "one,two");
}

TEST(OutputFolder, thatIsNotCommittedLeavesEverythingAsItWas) {
  const TemporaryFolder folder;
  writeRun(folder.path() / "dir", "old");
  const auto before = contents(folder.path());
  for (const char* dir : {"dir", "new", "new/deep"}) {
    OutputFolder out(folder.path() / dir, older);
    out.write("a", "new");
  }
  EXPECT_EQ(contents(folder.path()), before);
}

TEST(OutputFolder, thatASignalEndsLeavesEverythingAsItWas) {
  const TemporaryFolder folder;
  writeRun(folder.path() / "dir", "old");
  const auto before = contents(folder.path());
  for (const char* dir : {"dir", "new/deep"}) {
    const auto ended = [&] {
      OutputFolder out(folder.path() / dir, older);
      for (const char* name : {"a", "sub/a", "sub/deep/a"}) out.write(name, "new");
      std::raise(SIGTERM);
    };
    EXPECT_EXIT(ended(), testing::KilledBySignal(SIGTERM), "");
    EXPECT_EQ(contents(folder.path()), before);
  }
}

/// The signal may arrive in any thread.
TEST(OutputFolder, isThereAsAWholeWhereASignalComesWhileItIsCommitted) {
  const TemporaryFolder folder;
  writeRun(folder.path() / "dir", "old");
  const auto ended = [&] {
    OutputFolder out(folder.path() / "dir", [](const fs::path& path) {
      std::thread([] { std::raise(SIGTERM); }).join();
      return older(path);
    });
    out.write("a", "new");
    out.commit();
  };
  EXPECT_EXIT(ended(), testing::KilledBySignal(SIGTERM), "");
  EXPECT_THAT(contents(folder.path()),
              ElementsAre(Pair("dir/", ""), Pair("dir/a", "new"), Pair("dir/sub/", ""), Pair("dir/sub/a", "old")));
}

TEST(OutputFolder, carriesOverWhatNoRunWroteAndDropsTheOlderRun) {
  const TemporaryFolder folder;
  const fs::path dir = folder.path() / "dir";
  writeRun(dir, "old");
  folder.write("dir/b", "of the older run, which the new one has not");
  fs::create_directories(dir / "gone");
  folder.write("dir/gone/a", "likewise");
  fs::create_directories(dir / "empty");
  const fs::path note = folder.write("dir/sub/note", "a user's");
  ASSERT_EQ(::chmod(note.c_str(), 0640), 0);
  ASSERT_EQ(::chmod(dir.c_str(), 0750), 0);
  fs::create_symlink("nowhere", dir / "link");
  writeRun(dir, "new");
  EXPECT_TRUE(fs::is_symlink(dir / "link"));
  fs::remove(dir / "link");
  EXPECT_THAT(contents(folder.path()),
              ElementsAre(Pair("dir/", ""), Pair("dir/a", "new"), Pair("dir/empty/", ""), Pair("dir/sub/", ""),
                          Pair("dir/sub/a", "new"), Pair("dir/sub/note", "a user's")));
  struct stat found {};
  ASSERT_EQ(::stat(note.c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 07777, 0640u);
  ASSERT_EQ(::stat(dir.c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 07777, 0750u);
}

TEST(OutputFolder, keepsAUsersNoteInAFolderThatTheNewRunHasNot) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "dir" / "gone");
  folder.write("dir/gone/a", "of the older run");
  folder.write("dir/gone/note", "a user's");
  writeRun(folder.path() / "dir", "new");
  EXPECT_EQ(TemporaryFolder::read(folder.path() / "dir/gone/note"), "a user's");
  EXPECT_FALSE(fs::exists(folder.path() / "dir/gone/a"));
}

TEST(OutputFolder, refusesWhereAUsersFolderHasAFilesName) {
  const TemporaryFolder folder;
  const fs::path dir = folder.path() / "dir";
  fs::create_directories(dir / "a" / "mine");
  const auto before = contents(folder.path());
  EXPECT_THAT(refusal<std::runtime_error>([&] { OutputFolder(dir, older).require("a"); }), HasSubstr("is a folder"));
  EXPECT_THAT(refusal<std::runtime_error>([&] { writeRun(dir, "new"); }), HasSubstr("expected a file"));
  EXPECT_EQ(contents(folder.path()), before);
}

TEST(OutputFolder, behindALinkIsTheLinksTarget) {
  const TemporaryFolder folder;
  writeRun(folder.path() / "there", "old");
  fs::create_directory_symlink("there", folder.path() / "link");
  writeRun(folder.path() / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
  EXPECT_EQ(TemporaryFolder::read(folder.path() / "there/a"), "new");
}

TEST(OutputFolder, isWrittenByOneAtATime) {
  const TemporaryFolder folder;
  const fs::path dir = folder.path() / "dir";
  OutputFolder first(dir, older);
  EXPECT_EQ(refusal<std::runtime_error>([&] { OutputFolder(dir, older); }),
            dir.string() + ": another run (process " + std::to_string(::getpid()) +
                ") is writing there, expected a folder that no other run has");
  OutputFolder(folder.path() / "other", older);  // another folder is in nobody's way
  first.write("a", "first");
  first.commit();
  OutputFolder second(dir, older);
  EXPECT_EQ(TemporaryFolder::read(dir / "a"), "first");
}

/// The name that a dead process left.
fs::path left(const TemporaryFolder& folder, const std::string& kind) {
  return folder.path() / (".ursula-" + kind + "-" + sha1("dir").substr(0, 12) + "-1-0");
}

TEST(OutputFolder, removesWhatADeadProcessLeft) {
  const TemporaryFolder folder;
  fs::create_directories(left(folder, "new") / "sub");
  folder.write(left(folder, "new").filename().string() + "/sub/a", "half");
  folder.write(".ursula-lock-" + sha1("dir").substr(0, 12), "1\n");
  fs::create_directory(folder.path() / ".ursula-new-others-1-0");
  writeRun(folder.path() / "dir", "new");
  EXPECT_THAT(contents(folder.path()),
              ElementsAre(Pair(".ursula-new-others-1-0/", ""), Pair("dir/", ""), Pair("dir/a", "new"),
                          Pair("dir/sub/", ""), Pair("dir/sub/a", "new")));
}

TEST(OutputFolder, bringsANoteAfterThatASwapWasKilledWith) {
  const TemporaryFolder folder;
  writeRun(folder.path() / "dir", "new");
  fs::create_directory(left(folder, "old"));
  folder.write(left(folder, "old").filename().string() + "/a", "old");
  folder.write(left(folder, "old").filename().string() + "/note", "a user's");
  writeRun(folder.path() / "dir", "newer");
  EXPECT_THAT(contents(folder.path()),
              ElementsAre(Pair("dir/", ""), Pair("dir/a", "newer"), Pair("dir/note", "a user's"), Pair("dir/sub/", ""),
                          Pair("dir/sub/a", "newer")));
}

TEST(OutputFolder, putsBackWhatWasRenamedAwayAndNeverReplaced) {
  const TemporaryFolder folder;
  writeRun(folder.path() / "dir", "old");
  fs::rename(folder.path() / "dir", left(folder, "old"));
  OutputFolder(folder.path() / "dir", older);
  EXPECT_EQ(TemporaryFolder::read(folder.path() / "dir/a"), "old");
}

/// Returns to the tests' working folder at its end.
class WorkingIn {
 public:
  explicit WorkingIn(const fs::path& folder) : before_(fs::current_path()) { fs::current_path(folder); }
  ~WorkingIn() { fs::current_path(before_); }
  WorkingIn(const WorkingIn&) = delete;
  WorkingIn& operator=(const WorkingIn&) = delete;

 private:
  fs::path before_;
};

/// A shell in it would be left in a removed folder.
TEST(OutputFolder, thatIsWorkedInIsRefused) {
  const TemporaryFolder folder;
  writeRun(folder.path() / "dir", "old");
  const auto before = contents(folder.path());
  for (const char* here : {"dir", "dir/sub"}) {
    const WorkingIn there(folder.path() / here);
    EXPECT_EQ(refusal<std::runtime_error>([&] { writeRun(folder.path() / "dir", "new"); }),
              "cannot write " + (folder.path() / "dir").string() + ": " +
                  (here == std::string("dir") ? "is the working folder" : "has the working folder in it") +
                  ", expected another folder, such as " + (folder.path() / "dir/results").string());
    writeRun("results", "new");
    EXPECT_EQ(TemporaryFolder::read("results/a"), "new") << "one below is not";
    fs::remove_all("results");
  }
  EXPECT_EQ(contents(folder.path()), before);
}

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

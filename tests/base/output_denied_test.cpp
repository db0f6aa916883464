// A folder of results on a full disk, at a mount point, and where the user may not write.

#include <sys/mount.h>
#include <sys/stat.h>
#include <unistd.h>

#include <stdexcept>

#include "base/sha1.h"
#include "tests/base/output_runs.h"
#include "tests/model/refusals.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

namespace fs = std::filesystem;
using testing::Pair;

/// A small file system, if the machine permits one.
class SmallDisk {
 public:
  explicit SmallDisk(fs::path folder) : folder_(std::move(folder)) {
    fs::create_directory(folder_);
    is_there_ = ::mount("none", folder_.c_str(), "tmpfs", 0, "size=256k") == 0;
  }
  ~SmallDisk() {
    if (is_there_) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  bool isThere() const { return is_there_; }

 private:
  fs::path folder_;
  bool is_there_ = false;
};

TEST(DeniedOutput, ofAFullDiskIsTheOldOne) {
  const TemporaryFolder folder;
  const SmallDisk disk(folder.path() / "disk");
  if (!disk.isThere()) GTEST_SKIP() << "no file system can be mounted here";
  const std::string large(400'000, 'x');
  const fs::path dir = folder.path() / "disk" / "dir";
  writeRun(dir, "old");
  const auto before = contents(folder.path());
  EXPECT_EQ(refusal<std::runtime_error>([&] { writeRun(dir, large); }),
            "cannot write " + (dir / "a").string() + ": No space left on device");
  EXPECT_EQ(contents(folder.path()), before);
  writeRun(dir, "new");
  EXPECT_EQ(TemporaryFolder::read(dir / "a"), "new");
}

TEST(DeniedOutput, thatIsOrHoldsAMountPointIsRefused) {
  const TemporaryFolder folder;
  const fs::path dir = folder.path() / "dir", data = dir / "notes" / "data";
  writeRun(dir, "old");
  fs::create_directories(data.parent_path());
  const SmallDisk disk(data);
  if (!disk.isThere()) GTEST_SKIP() << "no file system can be mounted here";
  folder.write("dir/notes/data/precious", "a user's");
  const auto before = contents(folder.path());
  EXPECT_EQ(refusal<std::runtime_error>([&] { writeRun(data, "new"); }),
            "cannot write " + data.string() + ": is a mount point, expected another folder, such as " +
                (data / "results").string());
  EXPECT_EQ(refusal<std::runtime_error>([&] { writeRun(dir, "new"); }),
            "cannot write " + dir.string() + ": " + data.string() + " cannot be carried over: Device or resource busy");
  EXPECT_EQ(contents(folder.path()), before);
  writeRun(data / "results", "new");
  EXPECT_EQ(TemporaryFolder::read(data / "results/a"), "new");
}

/// A bind mount is of the same file system, so the device number does not reveal it.
TEST(DeniedOutput, thatIsOrHoldsAFolderOfElsewhereIsRefused) {
  const TemporaryFolder folder;
  const fs::path dir = folder.path() / "dir", elsewhere = folder.path() / "elsewhere";
  writeRun(dir, "old");
  for (const fs::path& place : {dir / "sub", dir}) {
    fs::create_directory(elsewhere);
    folder.write("elsewhere/a", "a user's");
    ASSERT_TRUE(fs::is_directory(place));
    if (::mount(elsewhere.c_str(), place.c_str(), nullptr, MS_BIND, nullptr) != 0)
      GTEST_SKIP() << "nothing can be mounted here";
    EXPECT_THROW(writeRun(dir, "new"), std::runtime_error) << place;
    EXPECT_EQ(::umount2(place.c_str(), MNT_DETACH), 0);
    EXPECT_EQ(TemporaryFolder::read(elsewhere / "a"), "a user's");
    EXPECT_EQ(TemporaryFolder::read(dir / "a"), "old");
  }
}

/// The process as another user than root.
class OtherUser {
 public:
  OtherUser() : is_another_(::geteuid() == 0 && ::seteuid(65534) == 0) {}
  ~OtherUser() {
    if (is_another_) static_cast<void>(::seteuid(0) == 0);
  }
  OtherUser(const OtherUser&) = delete;
  OtherUser& operator=(const OtherUser&) = delete;

 private:
  bool is_another_;
};

TEST(DeniedOutput, ofWhichAPartCannotBeReadIsRefused) {
  const TemporaryFolder folder;
  const fs::path dir = folder.path() / "dir", secret = dir / "secret";
  writeRun(dir, "old");
  fs::create_directory(secret);
  folder.write("dir/secret/key", "somebody's");
  fs::permissions(secret, fs::perms::none);
  for (const fs::path& open : {folder.path(), dir, dir / "sub"}) fs::permissions(open, fs::perms::all);
  {
    const OtherUser other;
    EXPECT_THROW(contents(dir), fs::filesystem_error) << "the control";
    EXPECT_EQ(refusal<std::runtime_error>([&] { OutputFolder(dir, older); }),
              "cannot write " + dir.string() + ": " + secret.string() + " cannot be carried over: Permission denied");
  }
  fs::permissions(secret, fs::perms::owner_all);
  EXPECT_THAT(contents(folder.path()),
              ElementsAre(Pair("dir/", ""), Pair("dir/a", "old"), Pair("dir/secret/", ""),
                          Pair("dir/secret/key", "somebody's"), Pair("dir/sub/", ""), Pair("dir/sub/a", "old")));
}

TEST(DeniedOutput, inAFolderThatIsReadOnlyIsRefused) {
  const TemporaryFolder folder;
  writeRun(folder.path() / "dir", "old");
  fs::permissions(folder.path(), fs::perms(0555));
  EXPECT_EQ(
      refusal<std::runtime_error>([&] { OutputFolder(folder.path() / "dir", older); }),
      "cannot write " + (folder.path() / "dir").string() + ": the folder " + folder.path().string() + " is read-only");
  fs::permissions(folder.path(), fs::perms(0755));
}

TEST(DeniedOutput, isNotKeptByTheLockThatAnotherUsersRunLeft) {
  const TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms::all);
  const fs::path lock = folder.write(".ursula-lock-" + sha1("dir").substr(0, 12), "1\n");
  fs::permissions(lock, fs::perms(0444));
  const OtherUser other;
  writeRun(folder.path() / "dir", "new");
  EXPECT_THAT(contents(folder.path()),
              ElementsAre(Pair("dir/", ""), Pair("dir/a", "new"), Pair("dir/sub/", ""), Pair("dir/sub/a", "new")));
}

TEST(DeniedOutput, leavesNothingWhereTheUmaskForbidsAll) {
  const TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms::all);
  const mode_t before = ::umask(0777);
  {
    const OtherUser other;
    EXPECT_THROW(writeRun(folder.path() / "dir", "new"), std::exception);
  }
  ::umask(before);
  EXPECT_TRUE(fs::is_empty(folder.path())) << *fs::directory_iterator(folder.path());
}

}  // namespace
}  // namespace ursula

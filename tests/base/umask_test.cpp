// Under a umask that takes all rights from the user, a results folder cannot be filled and is removed.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/output_folder.h"
#include "tests/base/temporary_folder.h"

namespace ursula {
namespace {

namespace fs = std::filesystem;

/// Makes the process another user while it exists, because modes do not bind root.
class Bound {
 public:
  explicit Bound(const fs::path& home) : user_(::geteuid()), mask_(::umask(0777)) {
    constexpr uid_t nobody = 65534;
    if (user_ != 0) return;
    EXPECT_EQ(::chown(home.c_str(), nobody, gid_t(-1)), 0);
    EXPECT_EQ(::seteuid(nobody), 0);
  }
  ~Bound() {
    static_cast<void>(::seteuid(user_) == 0);
    ::umask(mask_);
  }
  Bound(const Bound&) = delete;
  Bound& operator=(const Bound&) = delete;

 private:
  uid_t user_;
  mode_t mask_;
};

TEST(OutputFolder, leavesNothingWhereTheUmaskForbidsAll) {
  const TemporaryFolder folder;
  const fs::path home = folder.path() / "home";
  fs::create_directory(home);
  bool refused = false;
  {
    const Bound somebody(home);
    try {
      OutputFolder out(home / "dir");
      out.write("a", "new");
      out.commit();
    } catch (const std::exception&) {
      refused = true;
    }
  }
  EXPECT_TRUE(refused);
  EXPECT_TRUE(fs::is_empty(home)) << *fs::directory_iterator(home);
}

}  // namespace
}  // namespace ursula

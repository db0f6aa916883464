#pragma once

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/base/temporary_folder.h"

namespace ursula {

/// The paper's helix, quoted for command lines.
inline const std::string helix = "'" URSULA_SCENARIOS "/paper-helix.toml'";

/// The results of one call of the built program.
struct UrsulaRun {
  int exit_code = -1;  ///< −1 if it did not end by itself
  std::string out, err;
};

/// The program, called in a folder for the test.
class Program {
 public:
  const std::filesystem::path& folder() const { return folder_.path(); }

  /// Calls the program with `arguments` as a shell reads them. Standard input is empty unless they contain <file.
  UrsulaRun operator()(const std::string& arguments) const {
    const std::string command =
        "cd '" + folder().string() + "' && '" URSULA_PROGRAM "' </dev/null " + arguments + " >.out 2>.err";
    const int status = std::system(command.c_str());
    UrsulaRun run;
    if (WIFEXITED(status)) run.exit_code = WEXITSTATUS(status);
    run.out = TemporaryFolder::read(folder() / ".out");
    run.err = TemporaryFolder::read(folder() / ".err");
    std::filesystem::remove(folder() / ".out");
    std::filesystem::remove(folder() / ".err");
    return run;
  }

  /// The same of a call from which this exit code is expected.
  UrsulaRun ending(int exit_code, const std::string& arguments) const {
    UrsulaRun run = (*this)(arguments);
    EXPECT_EQ(run.exit_code, exit_code) << arguments << "\n" << run.out << run.err;
    return run;
  }
  UrsulaRun passing(const std::string& arguments) const { return ending(0, arguments); }

  std::string read(const std::string& name) const { return TemporaryFolder::read(folder() / name); }
  std::filesystem::path write(const std::string& name, const std::string& content) const {
    return folder_.write(name, content);
  }

  /// Returns a shipped file, or one of tests/vectors.
  static std::string shipped(const std::string& name) {
    return TemporaryFolder::read(std::filesystem::path(URSULA_SCENARIOS) / name);
  }

  /// Returns the number of entries at the top of the folder.
  std::size_t files() const {
    const std::filesystem::directory_iterator begin(folder());
    return static_cast<std::size_t>(std::distance(begin, std::filesystem::directory_iterator{}));
  }

 private:
  TemporaryFolder folder_;
};

using Refusals = std::vector<std::pair<std::string, std::string>>;

/// Expects of each call that it ends with 2, says this on standard error, prints nothing and leaves no further file.
inline void expectRefused(const Program& ursula, const Refusals& calls) {
  const std::size_t before = ursula.files();
  for (const auto& [call, says] : calls) {
    const UrsulaRun run = ursula(call);
    EXPECT_EQ(run.exit_code, 2) << call;
    EXPECT_THAT(run.err, testing::HasSubstr(says)) << call;
    EXPECT_NE(run.err, "") << call;
    EXPECT_EQ(run.out, "") << call;
    EXPECT_EQ(ursula.files(), before) << call << " has written";
  }
}

}  // namespace ursula

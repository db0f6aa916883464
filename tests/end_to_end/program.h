#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/base/temporary_folder.h"

namespace ursula {

/// The paper's helix, quoted: it goes into command lines.
inline const std::string helix = "'" URSULA_SCENARIOS "/paper-helix.toml'";

/// What one call of the built program did.
struct UrsulaRun {
  int exit_code = -1;  ///< −1 where it did not end by itself
  std::string out, err;
};

/// `arguments` as a shell reads them, called in `folder`; standard input is empty unless they say <file.
inline UrsulaRun callProgram(const TemporaryFolder& folder, const std::string& arguments) {
  const std::filesystem::path& path = folder.path();
  const std::string command =
      "cd '" + path.string() + "' && '" URSULA_PROGRAM "' </dev/null " + arguments + " >.out 2>.err";
  const int status = std::system(command.c_str());
  UrsulaRun run;
  if (WIFEXITED(status)) run.exit_code = WEXITSTATUS(status);
  run.out = TemporaryFolder::read(path / ".out");
  run.err = TemporaryFolder::read(path / ".err");
  std::filesystem::remove(path / ".out");
  std::filesystem::remove(path / ".err");
  return run;
}

using ProgramRun = UrsulaRun;

/// The same with one argument each, as they are: no shell reads them. None holds a single quote.
inline ProgramRun runProgram(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
  std::string line;
  for (const std::string& argument : arguments) line += " '" + argument + "'";
  return callProgram(folder, line);
}

/// The program, called in a folder of the test's own.
class Program {
 public:
  const std::filesystem::path& folder() const { return folder_.path(); }

  UrsulaRun operator()(const std::string& arguments) const { return callProgram(folder_, arguments); }

  std::filesystem::path write(const std::string& name, const std::string& content) const {
    return folder_.write(name, content);
  }

  /// A file that ships, or one of tests/vectors.
  static std::string shipped(const std::string& name) {
    return TemporaryFolder::read(std::filesystem::path(URSULA_SCENARIOS) / name);
  }

  /// Names of what lies in the folder, at the top.
  std::size_t files() const {
    const std::filesystem::directory_iterator begin(folder());
    return static_cast<std::size_t>(std::distance(begin, std::filesystem::directory_iterator{}));
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace ursula

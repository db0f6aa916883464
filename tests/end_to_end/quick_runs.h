#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <map>
#include <string>

#include "tests/end_to_end/program.h"
#include "tests/model/quick_scenario.h"

namespace ursula {

/// Every file under `folder` by its path, but for what has wall times.
inline std::map<std::string, std::string> contents(const std::filesystem::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (!entry.is_directory()) all[entry.path().lexically_relative(folder)] = TemporaryFolder::read(entry.path());
  for (auto& [name, content] : all) {
    const std::string file = std::filesystem::path(name).filename();
    if (file == "junit.xml" || file == "suite.json" || file == "index.html") content = "";
  }
  return all;
}

/// As a shell runs it in the folder, where $URSULA is the program.
inline int shell(const Program& ursula, const std::string& line) {
  const std::string command =
      "cd '" + ursula.folder().string() + "' && URSULA='" URSULA_PROGRAM "' && { " + line + "; } </dev/null";
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Returns a sweep over random masses of a scenario's platform; `settings` are the work and the number of points.
inline std::string massSweep(const std::string& scenario, const std::string& settings) {
  return "scenario = \"" + scenario + "\"\ndesign = \"random\"\n" + settings +
         "[[vary]]\nkey = \"manipulator.platform.mass\"\nuniform = [400.0, 600.0]\n";
}

/// Returns date and time of UTC in the form of results, which sorts as text.
inline std::string utcNow() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  char text[32] = "";
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &utc);
  return text;
}

/// Returns the start of the run in a junit.xml, in the same form; "" if there is none.
inline std::string startSaidBy(const std::filesystem::path& junit) {
  const std::string text = TemporaryFolder::read(junit), before = "timestamp=\"";
  const std::size_t at = text.find(before);
  return at == std::string::npos ? "" : text.substr(at + before.size(), std::string("2026-11-23T12:00:00").size());
}

}  // namespace ursula

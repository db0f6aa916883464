#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace ursula {

/// The command line as typed facts, from the definitions that --help shows.
struct OptionWords {
  std::vector<std::string> names;  ///< "--out", "-h"
  std::string value;               ///< what it takes: "TEXT", "FLOAT"; empty for a flag
  std::string description;         ///< in one line
};

struct ArgumentWords {
  std::string name, description;
};

struct VerbWords {
  std::string name, description, footer;
  std::vector<ArgumentWords> arguments;
  std::vector<OptionWords> options;
};

struct ProgramWords {
  std::string name, version;
  VerbWords program;             ///< options of its own
  std::vector<VerbWords> verbs;  ///< those that --help lists
};

ProgramWords wordsOf(const CLI::App& app);

/// What each shell loads: the verbs, their options, the names of checks after `explain`, and files.
std::string bashCompletion(const ProgramWords& words);
std::string zshCompletion(const ProgramWords& words);
std::string fishCompletion(const ProgramWords& words);

/// ursula(1), in roff.
std::string manPage(const ProgramWords& words);

}  // namespace ursula

#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace ursula {

/// An option of the command line, from the definition behind --help.
struct OptionWords {
  std::vector<std::string> names;  ///< "--out", "-h"
  std::string value;               ///< type of its value: "TEXT", "FLOAT"; empty for a flag
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
  VerbWords program;             ///< its own options
  std::vector<VerbWords> verbs;  ///< those that --help lists
};

ProgramWords wordsOf(const CLI::App& app);

/// Scripts for each shell that complete verbs, their options, names of checks after `explain`, and files.
std::string bashCompletion(const ProgramWords& words);
std::string zshCompletion(const ProgramWords& words);
std::string fishCompletion(const ProgramWords& words);

/// The man page ursula(1), in roff.
std::string manPage(const ProgramWords& words);

}  // namespace ursula

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

/// Returns an error line if the first argument should be a verb but is unknown; "" otherwise.
std::string unknownVerb(const CLI::App& app, int argc, char** argv);

/// Refuses values for flags, such as --quiet=7.
void refuseFlagValues(CLI::App& app);

/// Describes a wrong call in one line, with the nearest option for a misspelt one, and where to find help.
std::string misuse(const CLI::App& app, const CLI::ParseError& error);

/// Returns an error line for a number that CLI11 reads in an unexpected way: 010 as 8, and 1e-400 as 0. Returns "" if
/// there is none.
std::string oddNumber(const CLI::App& app);

/// Returns an error line for an empty option or argument, usually an unset variable of a script; "" if there is none.
std::string emptyValue(const CLI::App& app);

/// Says that memory ran out, and which numbers of the verb may be reduced.
std::string outOfMemory(const CLI::App& app);

}  // namespace ursula

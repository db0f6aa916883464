#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <initializer_list>
#include <stdexcept>
#include <string>

#include "validation/subject/motion_check.h"

namespace ursula {

/// The program's exit codes, as in docs/command_line.md.
constexpr int exit_passed = 0, exit_failed = 1, exit_bad_input = 2, exit_inconclusive = 3;

/// An error of the caller; the program prints it and exits with 2.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Accept a finite number above 0, or of 0 or more. CLI11's own validators accept nan.
CLI::Validator finitePositive();
CLI::Validator finiteNotNegative();
/// For transform(): "1%" becomes "0.01"; other text stays.
std::string withoutPercent(std::string text);
/// Accepts a 64-bit unsigned integer in range. CLI11's own parser wraps around.
CLI::Validator wholeNumber();

/// The groups of verbs in `ursula --help`.
constexpr const char *judging = "Judge", *preparing = "Prepare", *computing = "Compute", *studying = "Study",
                     *reading = "Read";

/// Registers a verb and stores in `run` its action, which returns the exit code.
using AddVerb = void(CLI::App& app, std::function<int()>& run);

// The core's verbs; parts have further ones (apps/part_verbs.h).
AddVerb addValidate, addInverse, addInit, addCheck, addExplain, addOpen;

/// Reads the scenario of a verb that uses its motion, and says on standard error what `check` warns of. Throws
/// UsageError if one of the options' values `written` is a file that the scenario names, such as its samples.
Scenario openScenario(const std::string& file, std::initializer_list<std::string> written = {});
/// Says how files that the scenario names were read, and what `check` warns of. Each verb says it once, before its
/// work.
void sayWarnings(const Scenario& scenario);

/// Returns the result of `run`. A pose that the machine cannot take becomes an error at the scenario's trajectory.
template <class Run>
auto alongMotion(const Scenario& scenario, Run&& run) {
  try {
    return run();
  } catch (const PoseError& refusal) {
    throw motionRefusal(scenario, refusal);
  }
}

/// Writes to `file` atomically, or to standard output if it is "-" or empty.
void writeOutput(const std::string& file, const std::string& content);
/// Shows a page in the user's browser without waiting for it; returns false if there is none.
bool showPage(const std::string& page);
/// Throws UsageError if `--out` names a file; it may be empty, or a folder that does not exist.
void refuseFile(const std::string& out);
/// Throws UsageError if `--out` names a folder with a validation's results, among which other files must not be.
void refuseResults(const std::filesystem::path& out);

}  // namespace ursula

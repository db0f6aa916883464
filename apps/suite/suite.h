#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/mechanism_scenario.h"
#include "model/scenario.h"
#include "report/files/report.h"
#include "validation/verdict/result.h"

namespace ursula {

/// One scenario of a suite: parsed and checked, or its error.
struct SuiteMember {
  std::string name;                    ///< the scenario's name, or the file's if it could not be read
  std::filesystem::path file = {};     ///< as the caller named it
  std::filesystem::path torques = {};  ///< efforts to judge: NAME.csv beside NAME.toml in a folder; else empty
  std::optional<Scenario> scenario;
  std::shared_ptr<const MechanismScenario> mechanism = nullptr;  ///< instead, for a scenario with [mechanism]
  std::string error = {};      ///< why it cannot be judged, starting with file:line:column; else empty
  std::string at_length = {};  ///< the same with the line in the file, if it is known

  bool isRead() const { return scenario.has_value() || mechanism != nullptr; }
};

/// Reads the scenarios named by `arguments`, in their order. An argument is a file, - for standard input, or a folder,
/// which gives its *.toml files, sorted, without subfolders. Checks that every motion is possible (inverse kinematics
/// and Jacobians at the judged instants and many between them). A problem of one member is its own error; so is a
/// folder without scenarios. Throws ScenarioError if two members share a name and thus a folder, or if one has the name
/// of a suite file. `map` is for the motions' files of mechanisms.
std::vector<SuiteMember> readSuite(const std::vector<std::filesystem::path>& arguments,
                                   const std::vector<std::string>& map = {});

/// The same if all are valid; otherwise throws ScenarioError with every error, one per line.
std::vector<SuiteMember> allOrNothing(std::vector<SuiteMember> members);

struct SuiteOptions {
  int jobs = 1;  ///< number of threads, >= 1
  /// Several threads call it at once, each for another scenario.
  std::function<ValidationResult(const SuiteMember&)> judge;
  /// Receives each finished scenario and the number of finished ones; calls never overlap. May be empty.
  std::function<void(const SuiteEntry&, std::size_t done)> finished;
};

/// Judges each scenario and writes its results into dir/NAME, then one JUnit file, `suite.json` and the index into
/// `dir`. `dir` keeps an older run's files until all are complete: see OutputFolder. Write errors are detected before
/// anything is judged. The bytes do not depend on the number of jobs, except for wall times in these and the JUnit
/// files. A member with an error, or for which `judge` throws, has no result: its entry fails with the error. Entries
/// keep the members' order. Throws std::invalid_argument for jobs < 1, and errors of writing.
std::vector<SuiteEntry> runSuite(const std::vector<SuiteMember>& members, const std::filesystem::path& dir,
                                 const SuiteOptions& options);

}  // namespace ursula

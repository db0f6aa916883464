#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "report/report.h"
#include "validation/verdict/result.h"

namespace ursula {

/// One scenario of a suite: read and tried, or what is wrong with it.
struct SuiteMember {
  std::string name;  ///< the scenario's, or the file's where that could not be read
  std::optional<Scenario> scenario;
  std::string error;  ///< why it cannot be judged, begins with file:line:column; else empty
};

/// Reads the scenarios that `arguments` name, in their order: a file stands for itself, - for standard input, a folder
/// for every *.toml in it, sorted, not for those in folders below. Checks that every motion can be made (inverse
/// kinematics and Jacobians at the instants judged and at many between them). What is wrong with one is its error
/// alone; a folder that holds none is one. Throws ScenarioError where two share a name, thus a folder, or one has that
/// of a file of the suite's own.
std::vector<SuiteMember> readSuite(const std::vector<std::filesystem::path>& arguments);

/// The same if all are good; else throws ScenarioError with every error found, a line each.
std::vector<SuiteMember> allOrNothing(std::vector<SuiteMember> members);

struct SuiteOptions {
  int jobs = 1;  ///< threads, >= 1
  /// Called by several threads at once, each time for another scenario.
  std::function<ValidationResult(const Scenario&)> judge;
  /// Told of each scenario as it is done, with the number of those done; never called twice at once. May be empty.
  std::function<void(const SuiteEntry&, std::size_t done)> finished;
};

/// Judges each scenario and writes its results into dir/NAME, then one JUnit file, `suite.json` and the index over all
/// into `dir`, which has the older run's until all are there: see OutputFolder. What cannot be written is found before
/// anything is judged. What is written is the same to the byte for any number of jobs, but for wall times, which are in
/// these and the JUnit files alone. A member in error, or one where `judge` throws, has no result: that entry fails and
/// holds the error. Entries keep the members' order. Throws std::invalid_argument for jobs < 1, and what writing
/// throws.
std::vector<SuiteEntry> runSuite(const std::vector<SuiteMember>& members, const std::filesystem::path& dir,
                                 const SuiteOptions& options);

}  // namespace ursula

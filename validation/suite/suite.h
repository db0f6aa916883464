#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "model/scenario.h"
#include "validation/report/report.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Reads the scenarios that `arguments` name, in their order: a file stands for itself, a folder for every *.toml in
/// it, sorted, not for those in folders below. Checks that every motion can be made (inverse kinematics and Jacobians
/// at the instants judged and at many between them) and that each scenario has a name, thus a folder, of its own.
/// Throws ScenarioError with every error found, a line each; a folder that holds none is one.
std::vector<Scenario> readSuite(const std::vector<std::filesystem::path>& arguments);

struct SuiteOptions {
  int jobs = 1;  ///< threads, >= 1
  /// Called by several threads at once, each time for another scenario.
  std::function<ValidationResult(const Scenario&)> judge;
  /// Told of each scenario as it is done, with the number of those done; never called twice at once. May be empty.
  std::function<void(const SuiteEntry&, std::size_t done)> finished;
};

/// Judges each scenario and writes its results into dir/NAME, then one JUnit file, `suite.json` and the index over all
/// into `dir`. What is written is the same to the byte for any number of jobs, but for wall times, which are in
/// `suite.json` and the index alone.
/// Where `judge` throws there is no result: that entry fails and holds the error. Entries keep the scenarios' order.
/// Throws std::invalid_argument for jobs < 1, and what writing throws.
std::vector<SuiteEntry> runSuite(const std::vector<Scenario>& scenarios, const std::filesystem::path& dir,
                                 const SuiteOptions& options);

}  // namespace ursula

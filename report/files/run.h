#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/output_folder.h"
#include "report/files/report.h"
#include "validation/verdict/result.h"

namespace ursula::report {

/// A run's files for one scenario, in the order of writing.
constexpr std::array<const char*, 4> result_files = {"timeseries.csv", "junit.xml", "report.html", "summary.json"};

/// The files over all scenarios of a suite.
constexpr std::array<const char*, 3> suite_files = {"junit.xml", "suite.json", "index.html"};

/// Passes the text of `timeseries.csv` to `take` in pieces and returns its sha1.
std::string timeseriesCsv(const ValidationResult& result, const std::function<void(const std::string&)>& take);

/// Adds the run to its provenance: `timeseries.csv sha1`, and `run`, a hash of all results. Runs with equal files have
/// equal hashes. An existing hash stays.
void stamp(const std::string& timeseries_sha1, ValidationResult& result);

/// Returns a hash of a suite's runs and errors.
std::string runOf(const std::vector<SuiteEntry>& entries);

/// Returns the files in `folder`, relative to it, that a run wrote, of one scenario or of a suite, and the suite's
/// scenario folders. A file that is no valid suite summary lists none.
Paths resultsIn(const std::filesystem::path& folder);

/// Returns the first of `inputs` that results in `folder` would replace; empty if there is none.
std::filesystem::path replacedInput(const std::vector<std::filesystem::path>& inputs,
                                    const std::filesystem::path& folder);

/// The files of a results folder belong to different runs.
struct MixedResults : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws MixedResults if a results folder, of a scenario or a suite, mixes several runs or was changed. It reads the
/// folder again before it throws, because another run may be replacing the files. Older versions' results, which lack
/// the hash, are accepted.
void refuseMixture(const std::filesystem::path& folder);

}  // namespace ursula::report

#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/output_folder.h"
#include "report/report.h"
#include "validation/verdict/result.h"

namespace ursula::report {

/// What a run writes for one scenario, the last of them last.
constexpr std::array<const char*, 4> result_files = {"timeseries.csv", "junit.xml", "report.html", "summary.json"};

/// And over all scenarios of a suite.
constexpr std::array<const char*, 3> suite_files = {"junit.xml", "suite.json", "index.html"};

/// The text of `timeseries.csv`, piece by piece, and its sha1.
std::string timeseriesCsv(const ValidationResult& result, const std::function<void(const std::string&)>& take);

/// Puts the run into its provenance: `timeseries.csv sha1`, and `run`, a hash of everything that the run found, so that
/// two runs that write the same have the same. One that has it already is left as it is.
void stamp(const std::string& timeseries_sha1, ValidationResult& result);

/// Of a suite: a hash of its scenarios' runs and errors.
std::string runOf(const std::vector<SuiteEntry>& entries);

/// The files in `folder`, relative to it, that a run wrote there, of one scenario or of a suite, and the folders of the
/// suite's scenarios. What is not read as a suite's summary lists none of these.
Paths resultsIn(const std::filesystem::path& folder);

/// The first of `inputs` that results written into `folder` would replace; empty where none would.
std::filesystem::path replacedInput(const std::vector<std::filesystem::path>& inputs,
                                    const std::filesystem::path& folder);

/// Files of a folder of results that are not of one run.
struct MixedResults : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws MixedResults where what is there of a folder of results, of one scenario or of a suite, is of several runs or
/// was changed, still at a second look: a run beside may have put its own there while they were read. Results of older
/// versions, which do not say, are taken as they are.
void refuseMixture(const std::filesystem::path& folder);

}  // namespace ursula::report

#include "base/csv.h"
#include "base/text.h"
#include "parts/compare/compare.h"
#include "report/files/run.h"

namespace ursula {
namespace {

/// The history that `validate` writes, or the shorter one in shipped results.
std::filesystem::path historyIn(const std::filesystem::path& folder) {
  std::error_code ignored;
  const bool is_short = !std::filesystem::exists(folder / "timeseries.csv", ignored) &&
                        std::filesystem::exists(folder / "inverse.csv", ignored);
  return folder / (is_short ? "inverse.csv" : "timeseries.csv");
}

}  // namespace

TimeSeries readHistory(const std::filesystem::path& file_or_folder) {
  std::error_code ignored;
  const bool is_folder = std::filesystem::is_directory(file_or_folder, ignored);
  if (is_folder) report::refuseMixture(file_or_folder);
  if (file_or_folder.extension() == ".toml")
    throw CsvError(shownPath(file_or_folder.string()) +
                   ": error: a file of keys (TOML), expected a result folder or a CSV file");
  return historyOf(readCsv(is_folder ? historyIn(file_or_folder) : file_or_folder, {{}, false}));
}

}  // namespace ursula

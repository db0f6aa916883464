#include "validation/report/report.h"

#include "model/atomic_file.h"
#include "model/csv.h"
#include "validation/report/html.h"
#include "validation/report/junit.h"
#include "validation/report/sparkline.h"
#include "validation/report/suite_json.h"
#include "validation/report/summary.h"

namespace ursula {

SuiteEntry suiteEntry(const ValidationResult& result, std::filesystem::path folder, double seconds) {
  SuiteEntry entry{result.scenario, result.verdict, std::move(folder), result.checks, "", seconds, "", {}};
  if (result.replay_error) entry.dominant = result.replay_error->dominant;
  entry.trend = report::trendOf(result.timeseries);
  return entry;
}

void writeResults(const ValidationResult& result, const std::filesystem::path& dir, Place place) {
  std::filesystem::remove(dir / "summary.json");
  writeFileAtomically(dir / "timeseries.csv",
                      csvText(result.timeseries.names, result.timeseries.columns, NanAs::empty_cell));
  writeFileAtomically(dir / "junit.xml", report::junitXml({suiteEntry(result, "", 0)}));
  writeFileAtomically(dir / "report.html", report::reportHtml(result, place));
  writeFileAtomically(dir / "summary.json", report::summaryJson(result));
}

void writeSuiteIndex(const std::vector<SuiteEntry>& entries, const std::filesystem::path& dir) {
  std::filesystem::remove(dir / "index.html");
  writeFileAtomically(dir / "junit.xml", report::junitXml(entries));
  writeFileAtomically(dir / "suite.json", report::suiteJson(entries));
  writeFileAtomically(dir / "index.html", report::indexHtml(entries));
}

}  // namespace ursula

#include "validation/report/report.h"

#include <ctime>

#include "model/atomic_file.h"
#include "model/csv.h"
#include "validation/report/html.h"
#include "validation/report/junit.h"
#include "validation/report/sparkline.h"
#include "validation/report/suite_json.h"
#include "validation/report/summary.h"

namespace ursula {

Stopwatch::Stopwatch() : start_(std::chrono::steady_clock::now()) {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  char text[32] = "";
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &utc);
  started_ = text;
}

RunTime Stopwatch::time() const {
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(), started_};
}

SuiteEntry suiteEntry(const ValidationResult& result, std::filesystem::path folder, const RunTime& time) {
  SuiteEntry entry{result.scenario, result.verdict, std::move(folder), result.checks, "", time, "", {}, {}};
  if (result.replay_error) entry.dominant = result.replay_error->dominant;
  entry.trend = report::trendOf(result.timeseries);
  entry.properties = {{"verdict", name(result.verdict)}, {"limits", name(result.limits)}};
  entry.properties.insert(entry.properties.end(), result.provenance.begin(), result.provenance.end());
  return entry;
}

void writeResults(const ValidationResult& result, const std::filesystem::path& dir, const RunTime& time, Place place) {
  std::filesystem::remove(dir / "summary.json");
  writeFileAtomically(dir / "timeseries.csv",
                      csvText(result.timeseries.names, result.timeseries.columns, NanAs::empty_cell));
  writeFileAtomically(dir / "junit.xml", report::junitXml({suiteEntry(result, "", time)}));
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

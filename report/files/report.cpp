#include "report/files/report.h"

#include <ctime>

#include "base/output_folder.h"
#include "report/files/run.h"
#include "report/files/written_files.h"
#include "report/page/plots.h"
#include "report/text/result_facts.h"

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
  if (result.replay_error) entry.dominant = name(result.replay_error->dominant);
  entry.run = result.run;
  entry.kind = result.kind;
  if (!result.cause_words.cause.empty()) entry.cause = report::causeText(result.cause_words);
  entry.trend = report::trendOf(result.timeseries);
  entry.properties = {{"verdict", name(result.verdict)}, {"limits", name(result.limits)}};
  entry.properties.insert(entry.properties.end(), result.provenance.begin(), result.provenance.end());
  return entry;
}

SuiteEntry addResults(ValidationResult& result, OutputFolder& out, const std::filesystem::path& below,
                      const RunTime& time, Place place) {
  std::string series_sha1;
  out.write(below / "timeseries.csv",
            [&](const OutputFolder::Take& take) { series_sha1 = report::timeseriesCsv(result, take); });
  report::stamp(series_sha1, result);
  SuiteEntry entry = suiteEntry(result, below, time);
  out.write(below / "junit.xml", report::junitXml({entry}));
  out.write(below / "report.html", report::reportHtml(result, place));
  out.write(below / "summary.json", report::summaryJson(result));
  return entry;
}

void requireResults(const OutputFolder& out, const std::filesystem::path& below) {
  for (const char* file : report::result_files) out.require(below / file);
}

void writeResults(const ValidationResult& result, const std::filesystem::path& dir, const RunTime& time, Place place) {
  OutputFolder out(dir, report::resultsIn);
  requireResults(out, "");
  ValidationResult whole = result;
  addResults(whole, out, "", time, place);
  out.commit();
}

void addSuiteIndex(const std::vector<SuiteEntry>& entries, OutputFolder& out) {
  const std::string run = report::runOf(entries);
  std::vector<SuiteEntry> named = entries;
  for (SuiteEntry& entry : named) entry.properties.emplace_back("run of the suite", run);
  out.write("junit.xml", report::junitXml(named));
  out.write("suite.json", report::suiteJson(entries));
  out.write("index.html", report::indexHtml(entries));
}

}  // namespace ursula

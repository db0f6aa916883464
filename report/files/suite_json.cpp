#include "report/files/written_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/json_text.h"
#include "report/files/run.h"
#include "report/text/result_facts.h"

namespace ursula::report {
namespace {

using Json = nlohmann::ordered_json;

// Rounds to the millisecond, because more digits would be noise.
double rounded(double seconds) { return std::round(seconds * 1000) / 1000; }

Json checkCounts(const std::vector<Check>& checks) {
  Json counts = Json::object();
  for (const Verdict verdict : {Verdict::pass, Verdict::fail, Verdict::inconclusive, Verdict::not_applicable})
    counts[name(verdict)] = countOf(checks, verdict);
  return counts;
}

Json entryJson(const SuiteEntry& entry) {
  const Check* worst = worstCheck(entry.checks);
  Json json = {{"name", entry.scenario},
               {"verdict", wordOf(entry)},
               {"checks", checkCounts(entry.checks)},
               {"seconds", rounded(entry.time.seconds)},
               {"folder", entry.error.empty() ? entry.folder.generic_string() : ""},
               {"decided_by", worst == nullptr ? "" : worst->name},
               {"dominant_error", entry.dominant}};
  if (!entry.error.empty()) json["error"] = entry.error;
  if (!entry.run.empty()) json["run"] = entry.run;
  return json;
}

}  // namespace

Verdict suiteVerdict(const std::vector<SuiteEntry>& entries) {
  std::vector<Check> verdicts;
  for (const SuiteEntry& entry : entries) {
    verdicts.emplace_back();
    verdicts.back().verdict = entry.verdict;
  }
  return overall(verdicts);
}

std::string wordOf(const SuiteEntry& entry) { return entry.error.empty() ? name(entry.verdict) : "error"; }

std::size_t countOf(const std::vector<SuiteEntry>& entries, const std::string& word) {
  return static_cast<std::size_t>(std::count_if(entries.begin(), entries.end(),
                                                [&word](const SuiteEntry& entry) { return wordOf(entry) == word; }));
}

std::string countsOf(const std::vector<SuiteEntry>& entries, const std::string& whole) {
  const std::size_t errors = countOf(entries, "error");
  return fmt::format("{}{} passed, {} failed, {} inconclusive{}", countOf(entries, "pass"), whole,
                     countOf(entries, "fail"), countOf(entries, "inconclusive"),
                     errors == 0 ? "" : fmt::format(", {} in error", errors));
}

double secondsOf(const std::vector<SuiteEntry>& entries) {
  double sum = 0;
  for (const SuiteEntry& entry : entries) sum += entry.time.seconds;
  return sum;
}

std::string suiteJson(const std::vector<SuiteEntry>& entries) {
  Json counts = {{"scenarios", entries.size()}};
  for (const char* word : {"pass", "fail", "inconclusive", "error"}) counts[word] = countOf(entries, word);
  Json scenarios = Json::array();
  for (const SuiteEntry& entry : entries) scenarios.push_back(entryJson(entry));
  const Json suite = {{"verdict", name(suiteVerdict(entries))},
                      {"counts", counts},
                      {"seconds", rounded(secondsOf(entries))},
                      {"run", runOf(entries)},
                      {"scenarios", scenarios}};
  return jsonText(suite, 2) + "\n";
}

}  // namespace ursula::report

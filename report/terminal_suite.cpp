#include <fmt/format.h>

#include <algorithm>

#include "report/columns.h"
#include "report/terminal.h"

namespace ursula::report {
namespace {

/// The verdict in one word, or "error".
std::string word(const SuiteEntry& entry) { return entry.error.empty() ? name(entry.verdict) : "error"; }

Paint paintOf(const SuiteEntry& entry) {
  if (!entry.error.empty() || entry.verdict == Verdict::fail) return Paint::bad;
  return entry.verdict == Verdict::pass ? Paint::good : Paint::open;
}

std::string why(const SuiteEntry& entry) {
  const Check* worst = worstCheck(entry.checks);
  if (!entry.error.empty()) return entry.error;
  return worst == nullptr ? "no check was made" : worst->name + " " + standing(*worst);
}

std::string totals(const std::vector<SuiteEntry>& entries) {
  const auto count = [&entries](const std::string& which) {
    return std::count_if(entries.begin(), entries.end(),
                         [&which](const SuiteEntry& entry) { return word(entry) == which; });
  };
  const auto errors = count("error");
  return fmt::format("{} passed, {} failed, {} inconclusive{}\n", count("pass"), count("fail"), count("inconclusive"),
                     errors == 0 ? "" : fmt::format(", {} in error", errors));
}

}  // namespace

std::string suiteText(const std::vector<SuiteEntry>& entries, const std::filesystem::path& dir, bool coloured) {
  std::size_t width = 0;
  for (const SuiteEntry& entry : entries) width = std::max(width, columnsOf(entry.scenario));
  std::string out;
  for (const SuiteEntry& entry : entries)
    out += fmt::format("{}  {}  {}  {}\n", painted(padded(word(entry), 12), paintOf(entry), coloured),
                       padded(entry.scenario, width), why(entry),
                       entry.error.empty() ? (dir / entry.folder / "report.html").string() : "no report");
  return out + totals(entries) + "index: " + (dir / "index.html").string() + "\n";
}

}  // namespace ursula::report

#include <fmt/format.h>

#include <algorithm>

#include "report/columns.h"
#include "report/terminal.h"
#include "report/written_files.h"

namespace ursula::report {
namespace {

Paint paintOf(const SuiteEntry& entry) {
  if (!entry.error.empty() || entry.verdict == Verdict::fail) return Paint::bad;
  return entry.verdict == Verdict::pass ? Paint::good : Paint::open;
}

std::string why(const SuiteEntry& entry) {
  const Check* worst = worstCheck(entry.checks);
  if (!entry.error.empty()) return entry.error;
  return worst == nullptr ? "no check was made" : worst->name + " " + standing(*worst);
}

}  // namespace

std::string suiteText(const std::vector<SuiteEntry>& entries, const std::filesystem::path& dir, bool coloured) {
  std::size_t width = 0;
  for (const SuiteEntry& entry : entries) width = std::max(width, columnsOf(entry.scenario));
  std::string out;
  for (const SuiteEntry& entry : entries)
    out += fmt::format("{}  {}  {}  {}\n", painted(padded(wordOf(entry), 12), paintOf(entry), coloured),
                       padded(entry.scenario, width), why(entry),
                       entry.error.empty() ? (dir / entry.folder / "report.html").string() : "no report");
  return out + countsOf(entries) + "\nindex: " + (dir / "index.html").string() + "\n";
}

}  // namespace ursula::report

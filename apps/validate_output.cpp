#include "apps/validate_output.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "apps/verbs.h"
#include "report/terminal.h"
#include "report/written_files.h"

namespace ursula {
namespace {

bool coloured() {
  return report::wantsColour(::isatty(::fileno(stdout)) == 1, std::getenv("NO_COLOR"), std::getenv("TERM"));
}

std::string summaryOf(const SuiteEntry& entry, const std::filesystem::path& dir) {
  if (!entry.error.empty()) return report::errorJson(entry.scenario, entry.error);
  std::ifstream file(dir / entry.folder / "summary.json", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

void printResult(const ValidationResult& result, const std::filesystem::path& dir, PrintedForm form) {
  switch (form) {
    case PrintedForm::json:
      return writeOutput("-", report::summaryJson(result));
    case PrintedForm::verdict:
      return writeOutput("-", report::quietText(result, coloured()));
    case PrintedForm::table:
      break;
  }
  writeOutput("-", report::validationText(result, coloured()) + "report: " + (dir / "report.html").string() + "\n");
}

void printSuite(const std::vector<SuiteEntry>& entries, const std::filesystem::path& dir, PrintedForm form) {
  if (form == PrintedForm::table) return writeOutput("-", report::suiteText(entries, dir, coloured()));
  std::string out = form == PrintedForm::json ? "[\n" : "";
  for (const SuiteEntry& entry : entries)
    out += form == PrintedForm::json ? (&entry == &entries.front() ? "" : ",\n") + summaryOf(entry, dir)
                                     : report::quietText(entry, coloured());
  writeOutput("-", out + (form == PrintedForm::json ? "]\n" : ""));
}

int exitCode(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return exit_passed;
    case Verdict::inconclusive:
      return exit_inconclusive;
    case Verdict::fail:
    case Verdict::not_applicable:
      break;
  }
  return exit_failed;
}

int exitCode(const std::vector<SuiteEntry>& entries) {
  const auto any = [&entries](int code) {
    return std::any_of(entries.begin(), entries.end(), [code](const SuiteEntry& entry) {
      return (entry.error.empty() ? exitCode(entry.verdict) : exit_failed) == code;
    });
  };
  for (const int code : {exit_failed, exit_inconclusive})
    if (any(code)) return code;
  return exit_passed;
}

}  // namespace ursula

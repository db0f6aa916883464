#include "apps/validate_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "apps/output.h"
#include "apps/verbs.h"
#include "base/text.h"
#include "model/torque_names.h"
#include "report/files/written_files.h"
#include "report/text/terminal.h"

namespace ursula {

void addMapOption(CLI::App& verb, std::vector<std::string>& map) {
  verb.add_option(
          "--map", map,
          "The name that a file of efforts, or of a mechanism's motion, gives to a column, such as tau_1_Nm=tau1,\n"
          "t_ms=Time or JOINT_rad=enc; may be repeated")
      ->type_name("NAME=COLUMN")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
}

TorqueFile readTorquesAloud(const std::string& file, const std::vector<std::string>& map, const Motors& motors) {
  const TorqueFile torques = readTorqueFile(file, parseColumnMap(map, motors), motors);
  sayHowRead(file, torques.read_as, torques.ignored, targetNames(motors));
  return torques;
}

void sayHowRead(const std::string& file, const std::string& read_as, const std::vector<std::string>& ignored,
                const std::vector<std::string>& wanted) {
  if (!read_as.empty()) say("{}: read as: {}\n", shownPath(file), read_as);
  if (ignored.empty()) return;
  const std::string motors = wanted.size() > 2 ? fmt::format("{} … {}", wanted[1], wanted.back()) : wanted.back();
  say("{}: columns other than t_s, {} are ignored: {}\n", shownPath(file), motors,
      shown(fmt::format("{}", fmt::join(ignored, ", ")), 400));
}

namespace {

bool coloured() {
  return report::wantsColour(::isatty(::fileno(stdout)) == 1, std::getenv("NO_COLOR"), std::getenv("TERM"));
}

std::string summaryOf(const SuiteEntry& entry, const std::filesystem::path& dir) {
  if (!entry.error.empty()) return report::errorJson(entry.scenario, entry.error);
  std::ifstream file(dir / entry.folder / "summary.json", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// What to do with that result.
std::string nextText(const ValidationResult& result, const std::filesystem::path& dir) {
  const Check* worst = worstCheck(result.checks);
  if (worst == nullptr || result.verdict == Verdict::pass)
    return fmt::format("next: ursula open {}\n", shellWord(dir.string()));
  return fmt::format("next: ursula open {}, or ursula explain {}\n", shellWord(dir.string()), worst->name);
}

}  // namespace

void printResult(const ValidationResult& result, const std::filesystem::path& dir, PrintedForm form) {
  std::string out;
  switch (form) {
    case PrintedForm::json:
      out = report::summaryJson(result);
      break;
    case PrintedForm::verdict:
      out = report::quietText(result, coloured());
      break;
    case PrintedForm::groups:
    case PrintedForm::table:
      out = report::validationText(result, coloured(), form == PrintedForm::table) +
            "report: " + (dir / "report.html").string() + "\n" + nextText(result, dir);
  }
  writeOutput("-", out);
}

void printSuite(const std::vector<SuiteEntry>& entries, const std::filesystem::path& dir, PrintedForm form) {
  if (form == PrintedForm::groups || form == PrintedForm::table)
    return writeOutput("-", report::suiteText(entries, dir, coloured()));
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

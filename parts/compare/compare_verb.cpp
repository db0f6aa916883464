#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/files_apart.h"
#include "apps/output.h"
#include "apps/validate_options.h"
#include "apps/verbs.h"
#include "base/text.h"
#include "parts/compare/compare_page.h"
#include "report/files/written_files.h"

namespace ursula {
namespace {

struct Options {
  std::string reference, test, out, junit;
  CompareOptions tolerances;
};

/// `--out` names a CSV file for the table, or a folder for page, table and JUnit file.
bool isTable(const std::string& out) { return out == "-" || std::filesystem::path(out).extension() == ".csv"; }

Comparison compareAndWrite(const Options& options) {
  if (options.out == "-" && options.junit == "-")
    throw UsageError("--out - and --junit -: expected standard output for one of them");
  requireOutside({options.reference, options.test}, {options.junit, isTable(options.out) ? options.out : ""});
  const TimeSeries reference = readHistory(options.reference), test = readHistory(options.test);
  if (options.out.empty() || isTable(options.out)) return compare(reference, test, options.tolerances);
  refuseFile(options.out);
  refuseResults(options.out);
  return writeComparison(reference, test, options.tolerances, {options.reference, options.test}, options.out);
}

int compareFiles(const Options& options) {
  const Comparison comparison = compareAndWrite(options);
  if (!options.junit.empty())
    writeOutput(options.junit,
                report::junitXml({comparisonSuite(comparison, options.reference + " : " + options.test)}));
  if (isTable(options.out)) writeOutput(options.out, comparisonCsv(comparison));
  // Standard output gets either data or text. If the CSV goes there, the table goes to standard error.
  std::string text = withoutControls(comparisonText(comparison));
  if (!options.out.empty() && !isTable(options.out))
    text += fmt::format("page: {}\n", (std::filesystem::path(options.out) / "compare.html").string());
  if (options.out == "-" || options.junit == "-")
    sayText(text);
  else
    writeOutput("-", text);
  return exitCode(comparison.verdict);
}

}  // namespace

void addCompare(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand("compare", "Compares two result folders or two CSV files, channel by channel");
  verb->group(judging)->footer("Example: ursula compare results/old results/new");
  verb->add_option("reference", options->reference, "Result folder, or CSV file with t_s")->required();
  verb->add_option("test", options->test, "Result folder, or CSV file, to compare with it")->required();
  verb->add_option("--tolerance", options->tolerances.tolerance,
                   "Tolerance in value, relative to the largest of the channel's group (all tau_*, …)")
      ->check(finiteNotNegative())
      ->capture_default_str();
  verb->add_option("--time-tolerance", options->tolerances.time_tolerance, "Tolerance in time, s")
      ->check(finiteNotNegative())
      ->capture_default_str();
  verb->add_flag_function(
      "--interpolate,!--no-interpolate", [options](std::int64_t given) { options->tolerances.interpolate = given > 0; },
      "Interpolates the reference between its instants; --no-interpolate leaves such instants out. Default: "
      "interpolates if the reference is at least as fine as the test");
  verb->add_option("--columns", options->tolerances.columns, "Columns to compare, such as tau_*,p_x_m. Default: all")
      ->delimiter(',');
  verb->add_option("--out", options->out,
                   "Folder for a page with every channel drawn, the table and JUnit. FILE.csv, or - for standard "
                   "output, gets the table alone");
  verb->add_option("--junit", options->junit, "JUnit XML, a case for each channel");
  verb->callback([options, &run] { run = [options] { return compareFiles(*options); }; });
}

}  // namespace ursula

#include <fmt/format.h>

#include <memory>

#include "apps/output.h"
#include "apps/verbs.h"
#include "base/output_file.h"
#include "parts/sweep/report/sweep_outputs.h"
#include "parts/sweep/sweep_verbs.h"

namespace ursula {
namespace {

struct ReportOptions {
  std::string database, out, csv;
};

int writeReport(const ReportOptions& options) {
  if (options.out == "-" && options.csv == "-")
    throw UsageError("--out - and --csv -: expected standard output for one of them");
  Sqlite database(options.database, Sqlite::Access::read);
  if (!options.csv.empty()) {
    Output out(options.csv);
    writeSweepCsv(database, [&out](std::string_view rows) { out.write(rows); });
    out.commit();
    if (options.out.empty()) return exit_passed;
  }
  const std::string page = sweepPage(summarise(database));
  if (options.out == "-") {
    writeOutput("-", page);
    return exit_passed;
  }
  const std::filesystem::path stem = std::filesystem::path(options.database).stem();
  const std::filesystem::path dir = options.out.empty() ? "results" / stem : std::filesystem::path(options.out);
  refuseFile(dir.string());
  refuseResults(dir);
  writeFileAtomically(dir / "report.html", page);
  fmt::print("{}\n", (dir / "report.html").string());
  return exit_passed;
}

}  // namespace

void addSweepReport(CLI::App& sweep, std::function<int()>& run) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App* verb = sweep.add_subcommand(
      "report", "Writes a page of a sweep's results: which parameters drive which results, and the worst points");
  verb->add_option("database", options->database, "Database of a sweep")->required();
  verb->add_option("--out", options->out, "Folder of report.html, default results/DATABASE; - for standard output");
  verb->add_option(
      "--csv", options->csv,
      "Writes all points as CSV instead, one row each: a file, or - for standard output; with --out, both");
  verb->footer("Exit code: 0, whatever the verdicts of the points are.");
  verb->callback([options, &run] { run = [options] { return writeReport(*options); }; });
}

}  // namespace ursula

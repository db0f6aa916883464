#include <fmt/ranges.h>

#include <memory>
#include <string>

#include "apps/files_apart.h"
#include "apps/output.h"
#include "apps/progress.h"
#include "apps/verbs.h"
#include "base/csv.h"
#include "base/output_folder.h"
#include "base/text.h"
#include "parts/identify/identify.h"

namespace ursula {
namespace {

struct IdentifyCall {
  std::string scenario, out;
  LogOptions log;
  std::string measured;
  bool prior = false, json = false, quiet = false;
};

void write(const IdentifyResult& result, const std::string& folder) {
  OutputFolder out(folder);
  out.write("summary.json", identifySummary(result));
  out.write("report.html", identifyPage(result));
  if (!result.series.names.empty()) {
    out.write("efforts.csv", csvText(result.series.names, result.series.columns));
    out.write("spectra.csv", csvText(result.spectra.names, result.spectra.columns));
    out.write("parameters.csv", identifyTable(result));
    if (!result.identified_scenario.empty()) out.write("identified.toml", result.identified_scenario);
  }
  out.commit();
}

int exitOf(Verdict verdict) {
  if (verdict == Verdict::pass) return exit_passed;
  return verdict == Verdict::fail ? exit_failed : exit_inconclusive;
}

int identifyLog(IdentifyCall call) {
  const Scenario scenario = openScenario(call.scenario);
  call.log.file = call.measured;
  const std::string folder = call.out.empty() ? "results/" + scenario.name : call.out;
  refuseFile(folder);
  requireKept(scenario, folder,
              {"summary.json", "report.html", "efforts.csv", "spectra.csv", "parameters.csv", "identified.toml"},
              call.measured);
  MeasuredLog log = readMeasuredLog(call.log, *scenario.manipulator);
  if (!call.quiet) say("{}: read as: {}\n", shownPath(call.measured), log.read_as);
  if (!log.ignored.empty())
    say("{}: columns that are not used: {}\n", shownPath(call.measured),
        shown(fmt::format("{}", fmt::join(log.ignored, ", ")), 400));
  Progress progress(scenario.name);
  IdentifyOptions options;
  options.prior = call.prior;
  options.progress = [&progress](double share, const std::string& what) { progress.at(share, what); };
  const IdentifyResult result = alongMotion(scenario, [&] { return identify(scenario, std::move(log), options); });
  write(result, folder);
  if (call.json)
    writeOutput("-", identifySummary(result));
  else if (!call.quiet)
    writeOutput("-", identifyText(result) + folder + "/summary.json\n");
  return exitOf(result.verdict);
}

}  // namespace

void addIdentify(CLI::App& app, std::function<int()>& run) {
  const auto call = std::make_shared<IdentifyCall>();
  CLI::App* verb = app.add_subcommand(
      "identify", "Compares measured efforts with the model, judges it, and estimates its parameters");
  verb->group(judging)->footer("Example: ursula identify my.toml --measured log.csv");
  verb->add_option("scenario", call->scenario, "Scenario file (TOML), - for standard input")->required();
  verb->add_option("--measured", call->measured,
                   "CSV file with t_s, driven coordinates or poses, efforts or currents, and optionally a load")
      ->required();
  verb->add_option("--out", call->out, "Folder of the results; default: results/NAME");
  verb->add_option("--map", call->log.map,
                   "Names a column of the log, such as phi_1_rad=enc1 or t_ms=Time; may be repeated")
      ->type_name("NAME=COLUMN")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  verb->add_option("--constant", call->log.constants,
                   "Motor constants for currents, N·m/A or N/A: one for all motors, or six")
      ->delimiter(',');
  verb->add_flag("--prior", call->prior, "Uses the scenario's tolerances as the numbers' prior uncertainty");
  verb->add_flag("--json", call->json, "Writes summary.json to standard output, and nothing else");
  verb->add_flag("--quiet", call->quiet, "Writes nothing to standard output");
  verb->callback([call, &run] { run = [call] { return identifyLog(*call); }; });
}

}  // namespace ursula

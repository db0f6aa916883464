#include <fmt/format.h>

#include <map>
#include <memory>

#include "apps/choice.h"
#include "apps/mechanism.h"
#include "apps/output.h"
#include "apps/validate_options.h"
#include "apps/verbs.h"
#include "base/csv.h"
#include "parts/simulate/simulate.h"
#include "parts/simulate/simulate_verbs.h"
#include "validation/findings/findings.h"
#include "validation/verdict/effort_words.h"

namespace ursula {
namespace {

/// Returns why the motion is incomplete; empty if it is complete.
std::string whatIsMissing(const Simulation& run, const TorqueFile& file, const Scenario& scenario) {
  const double duration = scenario.trajectory->duration();
  if (!run.gave_up.empty())
    return fmt::format("stopped at t = {} s of {} s: {}", run.motions.empty() ? 0 : run.motions.back().t, file.t.back(),
                       run.gave_up);
  if (covers(file, duration)) return "";
  return fmt::format("{}: the {}s reach from t = {} s to {} s of a motion from 0 to {} s; the rest is not simulated",
                     file.file.string(), effortNoun(scenario.manipulator->motors()), file.t.front(), file.t.back(),
                     duration);
}

int simulateVerb(const SimulateOptions& options) {
  const AnyScenario any = openAny(options.scenario, {options.out}, options.map);
  if (options.torques.empty()) requireUsed(options.map, any);
  if (any.mechanism) return simulateMechanismVerb(*any.mechanism, options);
  const Scenario& scenario = *any.manipulator;
  if (options.torques.empty())
    throw UsageError(fmt::format("--torques is required, as {} has [manipulator]", scenario.file.string()));
  const TorqueFile file = within(readTorquesAloud(options.torques, options.map, scenario.manipulator->motors()),
                                 scenario.trajectory->duration());
  const Deadline deadline(options.time_limit);
  const Simulation run = alongMotion(scenario, [&] { return simulate(scenario, options.engine, file, deadline); });
  const TimeSeries series = simulatedSeries(*scenario.manipulator, run.motions, run.torques);
  writeOutput(options.out, csvText(series.names, series.columns));
  const std::string missing = whatIsMissing(run, file, scenario);
  if (missing.empty()) return exit_passed;
  say("{}\n", missing);
  return exit_failed;
}

}  // namespace

void addSimulate(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<SimulateOptions>();
  CLI::App* verb = app.add_subcommand("simulate", "Computes the motion that a torque history produces, as CSV");
  verb->group(computing)->footer("Example: ursula simulate my.toml --torques efforts.csv --out motion.csv");
  verb->add_option("scenario", options->scenario,
                   "Scenario file (TOML), - for standard input; the motion starts in its commanded state")
      ->required();
  verb->add_option("--torques", options->torques,
                   "CSV file with t_s and tau_{1..6}_Nm, or _N for motors that slide. Only a scenario with [mechanism] "
                   "may do\nwithout: its motors then have the right efforts of the commanded motion");
  addMapOption(*verb, options->map);
  const std::map<std::string, SimulationEngine> engines{{"noc", SimulationEngine::noc},
                                                        {"simbody", SimulationEngine::simbody}};
  takeOneOf(verb->add_option("--engine", options->engine, "noc: (36); simbody: the closed loop. Default: simbody"),
            engines);
  verb->add_option("--time-limit", options->time_limit,
                   "The simulation stops after this wall time, s, with exit code 1. Default: no limit")
      ->check(finitePositive());
  verb->add_option("--out", options->out, "CSV file; - for standard output")->capture_default_str();
  verb->callback([options, &run] { run = [options] { return simulateVerb(*options); }; });
}

}  // namespace ursula

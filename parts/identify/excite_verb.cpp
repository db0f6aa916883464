#include <memory>
#include <string>

#include "apps/output.h"
#include "apps/progress.h"
#include "apps/verbs.h"
#include "parts/identify/excite.h"

namespace ursula {
namespace {

struct ExciteCall {
  std::string scenario, out = "-";
  ExciteOptions options;
};

int exciteMachine(ExciteCall call) {
  const Scenario scenario = openScenario(call.scenario, {call.out});
  Progress progress(scenario.name);
  call.options.progress = [&progress](double share, const std::string& what) { progress.at(share, what); };
  const Excitation found = alongMotion(scenario, [&] { return excite(scenario, call.options); });
  writeOutput(call.out, found.csv);
  say("{} combination{} of numbers shown, condition number {:.4g} (the scenario's own motion: {:.4g}); largest speed "
      "{:.3g}, effort {:.4g}, condition of B {:.4g}\n",
      found.shown, found.shown == 1 ? "" : "s", found.condition, found.scenario_condition, found.speed, found.effort,
      found.kappa);
  return exit_passed;
}

}  // namespace

void addExcite(CLI::App& app, std::function<int()>& run) {
  const auto call = std::make_shared<ExciteCall>();
  CLI::App* verb = app.add_subcommand(
      "excite", "Finds a periodic motion that shows the machine's numbers to `identify`, as a samples file");
  verb->group(preparing)->footer("Example: ursula excite my.toml --out excitation.csv");
  ExciteOptions& o = call->options;
  verb->add_option("scenario", call->scenario, "Scenario file (TOML), - for standard input")->required();
  verb->add_option("--out", call->out, "CSV file for kind = \"samples\"; - for standard output")->capture_default_str();
  verb->add_option("--period", o.period, "Period, s; default: the scenario's duration, at least 4 s")
      ->check(finitePositive());
  verb->add_option("--harmonics", o.harmonics, "Number of harmonics of the Fourier series")
      ->check(CLI::Range(1, 50))
      ->capture_default_str();
  verb->add_option("--samples", o.samples, "Number of rows; default: 20 for each period of the highest harmonic")
      ->check(CLI::Range(6, 1000000));
  verb->add_option("--speed", o.speed, "Limit of driven speeds, rad/s or m/s; default: 1.5 times the scenario's")
      ->check(finitePositive());
  verb->add_option("--effort", o.effort, "Limit of efforts, N·m or N; default: 1.5 times the scenario's")
      ->check(finitePositive());
  verb->add_option("--reach", o.reach,
                   "Limit of P's distance from the middle, m; default: a tenth of the machine's length")
      ->check(finitePositive());
  verb->add_option("--turn", o.turn, "Limit of the rotation from the middle, rad")
      ->check(finitePositive())
      ->capture_default_str();
  verb->add_option("--condition", o.condition, "Limit of B's condition number; default: 3 times the scenario's")
      ->check(finitePositive());
  verb->add_option("--tries", o.tries, "Number of tries of the search")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  verb->add_option("--seed", o.seed, "Seed of the search")->check(wholeNumber())->capture_default_str();
  verb->callback([call, &run] { run = [call] { return exciteMachine(*call); }; });
}

}  // namespace ursula

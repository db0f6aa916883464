#include <memory>

#include "apps/verbs.h"
#include "base/csv.h"
#include "parts/simulate/simulate.h"

namespace ursula {
namespace {

struct PosesOptions {
  std::string scenario, out = "-";
  int samples = 5;
};

}  // namespace

void addPoses(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<PosesOptions>();
  CLI::App* verb =
      app.add_subcommand("poses", "Writes points A, R, B of every leg along the trajectory as CSV, for drawings");
  verb->group(computing)->footer("Example: ursula poses my.toml --samples 11 --out points.csv");
  verb->add_option("scenario", options->scenario, "Scenario file (TOML), - for standard input")->required();
  verb->add_option("--samples", options->samples, "Equally spaced instants from 0 to t_f")
      ->check(CLI::Range(2, 1000000))
      ->capture_default_str();
  verb->add_option("--out", options->out, "CSV file; - for standard output")->capture_default_str();
  verb->callback([options, &run] {
    run = [options] {
      const Scenario scenario = openScenario(options->scenario, {options->out});
      const TimeSeries series = alongMotion(scenario, [&] { return poseSeries(scenario, options->samples); });
      writeOutput(options->out, csvText(series.names, series.columns));
      return exit_passed;
    };
  });
}

}  // namespace ursula

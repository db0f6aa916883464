#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "apps/mechanism.h"
#include "apps/output.h"
#include "apps/progress.h"
#include "apps/validate_options.h"
#include "apps/verbs.h"
#include "report/files/inverse_blocks.h"

namespace ursula {
namespace {

struct InverseOptions {
  std::string scenario, out = "-";
  std::vector<std::string> map;
  int samples = 301;
  RowFormat format = RowFormat::csv;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
};

int inverse(const InverseOptions& options) {
  const AnyScenario any = openAny(options.scenario, {options.out}, options.map);
  requireUsed(options.map, any);
  if (any.mechanism && options.format != RowFormat::csv)
    throw UsageError(fmt::format("--format: {} has [mechanism], expected csv", options.scenario));
  if (any.mechanism) return inverseOfMechanism(*any.mechanism, options.samples, options.out);
  const Scenario& scenario = *any.manipulator;
  const BlockTable table = inverseBlocks(scenario, options.samples);
  Progress progress(scenario.name);
  const auto written = [&](double share) {
    progress.at(share, fmt::format("{:.0f} of {} samples", share * options.samples, options.samples));
  };
  Output out(options.out);
  alongMotion(scenario, [&] {
    streamBlocks(table, {options.format, options.jobs, written}, [&out](std::string_view rows) { out.write(rows); });
  });
  out.commit();
  return exit_passed;
}

}  // namespace

void addInverse(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<InverseOptions>();
  CLI::App* verb =
      app.add_subcommand("inverse", "Writes motion, joint variables and efforts along the trajectory, as CSV");
  verb->group(computing)->footer("Example: ursula inverse my.toml --samples 1001 --out efforts.csv");
  verb->add_option("scenario", options->scenario, "Scenario file (TOML), - for standard input")->required();
  verb->add_option("--samples", options->samples, "Equally spaced instants from 0 to t_f")
      ->check(CLI::Range(2, 1000000000))
      ->capture_default_str();
  verb->add_option("--out", options->out, "CSV file; - for standard output")->capture_default_str();
  addMapOption(*verb, options->map);
  addRowOptions(*verb, options->format, options->jobs);
  verb->callback([options, &run] { run = [options] { return inverse(*options); }; });
}

}  // namespace ursula

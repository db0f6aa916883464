#include <fmt/format.h>

#include <map>
#include <memory>
#include <string>

#include "apps/choice.h"
#include "apps/output.h"
#include "apps/verbs.h"
#include "model/scenario_files.h"
#include "parts/exchange/leg_pose.h"
#include "parts/exchange/write/export.h"

namespace ursula {
namespace {

using exchange::ModelFormat;

struct ExportOptions {
  std::string scenario, out = "-";
  ModelFormat format = ModelFormat::sdf;
};

exchange::WrittenModel written(const Scenario& scenario, ModelFormat format) {
  try {
    return exchange::exportScenario(scenario, format);
  } catch (const exchange::UnreachablePose& refusal) {
    throw ScenarioError(fmt::format("{}: error: the motion's first pose cannot be taken: {}",
                                    placeInFile(scenario, "trajectory").place, refusal.what()));
  }
}

int exportModel(const ExportOptions& options) {
  const Scenario scenario = openScenario(options.scenario, {options.out});
  const exchange::WrittenModel model = written(scenario, options.format);
  writeOutput(options.out, model.text);
  for (const exchange::Assumption& note : model.notes) say("note: {}\n", inWords(note));
  return exit_passed;
}

}  // namespace

void addExport(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<ExportOptions>();
  CLI::App* verb =
      app.add_subcommand("export", "Writes the machine at the motion's first instant as a model for other tools");
  verb->group(preparing)->footer("Example: ursula export my.toml --format mjcf --out my.xml");
  verb->add_option("scenario", options->scenario, "Scenario file (TOML), - for standard input")->required();
  const std::map<std::string, ModelFormat> formats = {
      {"sdf", ModelFormat::sdf}, {"mjcf", ModelFormat::mjcf}, {"urdf", ModelFormat::urdf}};
  takeOneOf(
      verb->add_option("--format", options->format, "sdf: for Gazebo; mjcf: for MuJoCo; urdf: for most other tools")
          ->required(),
      formats);
  verb->add_option("--out", options->out, "Model file; - for standard output")->capture_default_str();
  verb->callback([options, &run] { run = [options] { return exportModel(*options); }; });
}

}  // namespace ursula

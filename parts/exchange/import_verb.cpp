#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "apps/output.h"
#include "apps/verbs.h"
#include "base/json_text.h"
#include "base/text.h"
#include "parts/exchange/import.h"
#include "validation/subject/singular_everywhere.h"

namespace ursula {
namespace {

struct ImportOptions {
  std::string model, out = "-";
  exchange::ImportChoices choices;
  bool json = false;
};

std::string asJson(const exchange::Imported& imported) {
  nlohmann::ordered_json assumptions = nlohmann::ordered_json::array();
  for (const exchange::Assumption& each : imported.assumptions)
    assumptions.push_back({{"what", each.what},
                           {"where", each.where},
                           {"size", each.size},
                           {"unit", each.unit},
                           {"warning", each.warning}});
  const nlohmann::ordered_json document = {{"scenario", imported.scenario}, {"assumptions", assumptions}};
  return jsonText(document, 2) + "\n";
}

/// Returns where a machine that is no manipulator of six motors goes; empty if other choices, or another file, help.
std::string elsewhere(const std::string& model) {
  try {
    const std::string advice = exchange::adviceOnModel(model);
    return advice.rfind("ursula init", 0) == 0 ? ". As a machine of another kind: " + advice : "";
  } catch (const std::exception&) {
    return "";
  }
}

exchange::Imported importOrHint(const ImportOptions& options) {
  try {
    return exchange::importModel(options.model, options.choices);
  } catch (const exchange::ImportError& error) {
    throw exchange::ImportError(error.what() + elsewhere(options.model), error.line);
  }
}

/// With `--json` standard output gets only the document, and the scenario goes to a named file.
int import(const ImportOptions& options) {
  exchange::Imported imported = importOrHint(options);
  if (const auto found = singularEverywhere(parseScenario(imported.scenario, options.model)))
    imported.assumptions.push_back({"The machine is " + found->words(), "legs", found->largest, "1"});
  if (!options.json) {
    for (const exchange::Assumption& each : imported.assumptions) say("{}\n", inWords(each));
    writeOutput(options.out, imported.scenario);
    return exit_passed;
  }
  if (namesFile(options.out)) writeOutput(options.out, imported.scenario);
  writeOutput("-", asJson(imported));
  return exit_passed;
}

}  // namespace

void addImport(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<ImportOptions>();
  CLI::App* verb =
      app.add_subcommand("import", "Makes a scenario from a model in SDF, MJCF or URDF, and prints its assumptions");
  verb->group(preparing)->footer("Example: ursula import robot.xml --out my.toml");
  exchange::ImportChoices& choices = options->choices;
  verb->add_option("model", options->model, "Model file: SDF, MJCF or URDF")->required();
  verb->add_option("--base", choices.base,
                   "Fixed body, whose frame is B; default: the bodies fixed to the world, in the world's axes");
  verb->add_option("--platform", choices.platform, "Body that the legs carry; its frame is M");
  verb->add_option("--actuated", choices.actuated,
                   "The six joints that motors drive, instead of those that the file names")
      ->delimiter(',');
  verb->add_option("--close", choices.closed,
                   "Two links, A:B: a ball joint connects the origins of their frames; once for each loop");
  verb->add_option("--key", choices.key, "Keyframe of an MJCF whose pose is the initial one");
  verb->add_option("--leave-out", choices.leave_out,
                   "Leaves out what the file has: fluid, ball-friction, passive-armature, passive-friction, springs, "
                   "limits; passive joints are those without a motor")
      ->delimiter(',');
  verb->add_option("--tolerance", choices.tolerance,
                   "Axes count as square or parallel within this angle, rad, and as meeting within this share of the "
                   "machine's size")
      ->check(finiteNotNegative())
      ->capture_default_str();
  verb->add_option("--lump", choices.lump,
                   "Crosses within joints are left out if their share of the leg's moments of inertia is at most this")
      ->transform(withoutPercent)
      ->check(finiteNotNegative())
      ->capture_default_str();
  verb->add_option("--out", options->out, "Scenario file (TOML); - for standard output")->capture_default_str();
  verb->add_flag("--json", options->json, "Prints only scenario and assumptions as JSON on standard output");
  verb->callback([options, &run] { run = [options] { return import(*options); }; });
}

}  // namespace ursula

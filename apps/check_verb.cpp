#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "apps/mechanism.h"
#include "apps/output.h"
#include "apps/suggest.h"
#include "apps/validate_options.h"
#include "apps/verbs.h"
#include "base/csv.h"
#include "base/text.h"
#include "model/scenario_excerpt.h"
#include "model/scenario_files.h"
#include "report/files/written_files.h"
#include "report/page/scenario_picture.h"
#include "report/text/terminal.h"
#include "validation/check_scenario/check_scenario.h"
#include "validation/subject/motion_check.h"

namespace ursula {
namespace {

struct CheckOptions {
  std::vector<std::string> scenarios, map;
  std::string picture, out;
  bool json = false, suggest = false;
};

CheckedScenario checkManipulator(const Scenario& scenario, const std::string& picture_file) {
  for (const std::string& note : readAs(scenario)) say("{}\n", note);
  CheckedScenario out{scenario.file.string(), scenario.name};
  out.warnings = warnings(scenario);
  if (!picture_file.empty()) writePicture(picture_file, picture(scenario));
  tryMotion(scenario);
  return out;
}

/// Prints what was found to standard output, or to standard error if that has the picture or a scenario.
void print(const CheckedScenario& checked, const std::string& freedoms, const CheckOptions& options) {
  const auto tell = [on_stderr = options.picture == "-" || options.suggest](const std::string& text) {
    on_stderr ? sayText(withoutControls(text)) : writeOutput("-", withoutControls(text));
  };
  for (const auto* lines : {&checked.warnings, &checked.assumptions})
    for (const std::string& line : *lines) tell(line + "\n");
  tell(fmt::format("{}: {}the scenario and its motion are valid; {} warning{}\n", checked.file, freedoms,
                   checked.warnings.size(), checked.warnings.size() == 1 ? "" : "s"));
  if (checked.blind && !options.suggest) tell(report::blindText(*checked.blind));
}

/// Checks one scenario; errors go to standard error.
CheckedScenario checkOne(const std::string& file, const CheckOptions& options) {
  CheckedScenario failed{file, ""};
  try {
    const AnyScenario any = readAny(file, {options.picture, options.out}, options.map);
    requireUsed(options.map, any);
    if (any.mechanism && !any.mechanism->motion_read_as.empty()) say("{}\n", any.mechanism->motion_read_as);
    std::string freedoms;
    CheckedScenario out = any.mechanism ? checkMechanism(*any.mechanism, options.picture, freedoms)
                                        : checkManipulator(*any.manipulator, options.picture);
    out.blind = blindSpotsOf(any);
    if (!options.json) print(out, freedoms, options);
    if (options.suggest) suggestMotion(any, *out.blind, options.out);
    return out;
  } catch (const ScenarioError& error) {
    say("{}\n", atLength(error));
    failed.error = error.what();
  } catch (const InputError& error) {
    say("{}\n", error.what());
    failed.error = error.what();
  }
  return failed;
}

int check(const CheckOptions& options) {
  const bool one_alone = !options.picture.empty() || options.suggest;
  if (one_alone && options.scenarios.size() > 1)
    throw UsageError(fmt::format("{}: {} scenarios, expected one", options.suggest ? "--suggest" : "--picture",
                                 options.scenarios.size()));
  if (options.suggest) requireSuggestion(options.out);
  std::vector<CheckedScenario> all;
  for (const std::string& file : options.scenarios) all.push_back(checkOne(file, options));
  const bool good = std::all_of(all.begin(), all.end(), [](const auto& each) { return each.error.empty(); });
  if (options.json && (good || all.size() > 1)) writeOutput("-", report::checkedJson(all));
  return good ? exit_passed : exit_bad_input;
}

}  // namespace

void addCheck(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* verb = app.add_subcommand(
      "check", "Reads a scenario and tries its motion: errors, odd values, and mistakes that it could not show");
  verb->group(preparing)->footer("Example: ursula check my.toml --picture my.svg");
  verb->add_option("scenarios", options->scenarios, "Scenario files (TOML), - for standard input")->required();
  CLI::Option* picture =
      verb->add_option("--picture", options->picture,
                       "Draws the machine at the start of the motion, even if it is out of reach: SVG or PNG file; - "
                       "for standard output, as SVG. PNG needs rsvg-convert, of Debian's librsvg2-bin");
  CLI::Option* json =
      verb->add_flag("--json", options->json,
                     "Prints only warnings, assumptions and blind spots as JSON; an array for several scenarios");
  CLI::Option* suggest =
      verb->add_flag("--suggest", options->suggest,
                     "Prints the scenario with another motion, under which more mistakes show, and says which do not");
  addMapOption(*verb, options->map);
  suggest->excludes(json)->excludes(picture);
  verb->add_option("--out", options->out, "New file for that scenario instead of standard output; never overwrites")
      ->needs(suggest);
  verb->callback([options, &run] { run = [options] { return check(*options); }; });
}

}  // namespace ursula

#include <fmt/format.h>

#include <memory>
#include <vector>

#include "apps/mechanism.h"
#include "apps/output.h"
#include "apps/verbs.h"
#include "base/csv.h"
#include "base/text.h"
#include "model/scenario_excerpt.h"
#include "model/scenario_files.h"
#include "report/page/scenario_picture.h"
#include "validation/check_scenario/check_scenario.h"
#include "validation/subject/motion_check.h"

namespace ursula {
namespace {

struct CheckOptions {
  std::vector<std::string> scenarios;
  std::string picture;
};

/// Prints warnings to standard output and errors to standard error; returns false if there is an error.
bool checkOne(const std::string& file, const CheckOptions& options) {
  try {
    const AnyScenario any = readAny(file, {options.picture});
    if (any.mechanism) return checkMechanism(*any.mechanism, options.picture) == exit_passed;
    const Scenario& scenario = *any.manipulator;
    for (const std::string& note : readAs(scenario)) say("{}\n", note);
    const std::vector<std::string> odd = warnings(scenario);
    const auto tell = [on_stderr = options.picture == "-"](const std::string& text) {
      return on_stderr ? sayText(withoutControls(text)) : writeOutput("-", withoutControls(text));
    };
    for (const std::string& line : odd) tell(line + "\n");
    if (!options.picture.empty()) writePicture(options.picture, picture(scenario));
    tryMotion(scenario);
    tell(fmt::format("{}: the scenario and its motion are valid; {} warning{}\n", scenario.file.string(), odd.size(),
                     odd.size() == 1 ? "" : "s"));
    return true;
  } catch (const ScenarioError& error) {
    say("{}\n", atLength(error));
    return false;
  } catch (const InputError& error) {
    say("{}\n", error.what());
    return false;
  }
}

int check(const CheckOptions& options) {
  if (!options.picture.empty() && options.scenarios.size() > 1)
    throw UsageError(fmt::format("--picture: {} scenarios, expected one", options.scenarios.size()));
  bool good = true;
  for (const std::string& file : options.scenarios) good = checkOne(file, options) && good;
  return good ? exit_passed : exit_bad_input;
}

}  // namespace

void addCheck(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* verb =
      app.add_subcommand("check", "Reads a scenario and tries its motion: reports errors, and warns of odd values");
  verb->group(preparing)->footer("Example: ursula check my.toml --picture my.svg");
  verb->add_option("scenarios", options->scenarios, "Scenario files (TOML), - for standard input")->required();
  verb->add_option("--picture", options->picture,
                   "Draws the machine at the start of the motion, even if it is out of reach: SVG or PNG file; - for "
                   "standard output, as SVG. PNG needs rsvg-convert, of Debian's librsvg2-bin");
  verb->callback([options, &run] { run = [options] { return check(*options); }; });
}

}  // namespace ursula

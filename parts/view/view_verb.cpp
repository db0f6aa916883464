#include <memory>

#include "apps/mechanism.h"
#include "apps/output.h"
#include "apps/verbs.h"
#include "parts/view/view.h"

namespace ursula {
namespace {

struct ViewOptions {
  std::string scenario, out;
};

int view(const ViewOptions& options) {
  const AnyScenario any = openAny(options.scenario, {options.out});
  const bool shows = options.out.empty();
  const std::string name = any.mechanism ? any.mechanism->name : any.manipulator->name;
  const std::string file = shows ? "results/view/" + name + ".html" : options.out;
  writeOutput(file, any.mechanism ? alongLoops(*any.mechanism, [&] { return viewHtml(*any.mechanism); })
                                  : viewHtml(*any.manipulator));
  if (file == "-") return exit_passed;
  const std::string page = std::filesystem::absolute(file).string();
  writeOutput("-", page + "\n");
  if (shows && !showPage(page))
    say("no browser: neither $BROWSER nor xdg-open is there; open the page above yourself\n");
  return exit_passed;
}

}  // namespace

void addView(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<ViewOptions>();
  CLI::App* verb = app.add_subcommand("view", "Makes a page with the machine to move, and shows it in the browser");
  verb->group(preparing);
  verb->add_option("scenario", options->scenario, "Scenario file (TOML), - for standard input")->required();
  verb->add_option("--out", options->out,
                   "HTML file, - for standard output; nothing is then started. Default: results/view/NAME.html");
  verb->footer(
      "Example: ursula view my.toml\n"
      "The page needs no network and no server. Sliders move the pose or the motors, also along the commanded path;\n"
      "legs, reach, the distance from singular poses and the efforts that hold the machine at rest follow.");
  verb->callback([options, &run] { run = [options] { return view(*options); }; });
}

}  // namespace ursula

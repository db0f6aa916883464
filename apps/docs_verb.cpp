#include <memory>

#include "apps/verbs.h"
#include "validation/scenario_docs/scenario_docs.h"

namespace ursula {

void addDocs(CLI::App& app, std::function<int()>& run) {
  const auto folder = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("docs", "Writes scenario.md and scenario.schema.json, for ./dev docs");
  verb->group("");  // for those who work on the program: not listed
  verb->add_option("folder", *folder, "Where to")->required();
  verb->callback([folder, &run] {
    run = [folder] {
      writeOutput(*folder + "/scenario.md", scenarioMarkdown());
      writeOutput(*folder + "/scenario.schema.json", scenarioSchema());
      return exit_passed;
    };
  });
}

}  // namespace ursula

#include <memory>

#include "apps/usage.h"
#include "apps/verbs.h"
#include "parts/scenario_docs/scenario_docs.h"
#include "report/text/result_facts.h"

namespace ursula {
namespace {

struct DocsOptions {
  std::string folder, shell;
  bool man = false;
};

std::string completion(const ProgramWords& words, const std::string& shell) {
  if (shell == "bash") return bashCompletion(words);
  return shell == "zsh" ? zshCompletion(words) : fishCompletion(words);
}

int docs(const DocsOptions& options, const CLI::App& app) {
  if (options.folder.empty() && options.shell.empty() && !options.man)
    throw UsageError("docs: nothing to write, expected a folder, --completion or --man");
  if (!options.folder.empty()) {
    writeOutput(options.folder + "/checks.md", report::checksMarkdown());
    writeOutput(options.folder + "/scenario.md", scenarioMarkdown());
    writeOutput(options.folder + "/scenario.schema.json", scenarioSchema());
  }
  if (!options.shell.empty()) writeOutput("-", completion(wordsOf(app), options.shell));
  if (options.man) writeOutput("-", manPage(wordsOf(app)));
  return exit_passed;
}

}  // namespace

void addDocs(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<DocsOptions>();
  CLI::App* verb = app.add_subcommand("docs", "Writes the documents that are made from the program's own definitions");
  verb->group("");  // for developers: not listed
  verb->add_option("folder", options->folder,
                   "Folder for checks.md, scenario.md and scenario.schema.json (./dev docs)");
  CLI::Option* shell = verb->add_option("--completion", options->shell, "Prints the completion for bash, zsh or fish")
                           ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  verb->add_flag("--man", options->man, "Prints the man page")->excludes(shell);
  verb->callback([options, &app, &run] { run = [options, &app] { return docs(*options, app); }; });
}

}  // namespace ursula

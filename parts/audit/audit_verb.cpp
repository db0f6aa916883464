#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/embedded_scenario.h"
#include "apps/files_apart.h"
#include "apps/output.h"
#include "apps/progress.h"
#include "apps/verbs.h"
#include "base/output_file.h"
#include "base/output_folder.h"
#include "model/scenario_files.h"
#include "parts/audit/audit.h"

namespace ursula {
namespace {

struct AuditOptions {
  std::string scenario, json, markdown, out;
};

int audit(const AuditOptions& options) {
  if (options.json == "-" && options.markdown == "-")
    throw UsageError("--json and --markdown both go to standard output");
  refuseFile(options.out);
  for (const std::string& file : {options.json, options.markdown})
    if (namesFile(file)) requireWritable(file);  // the rest takes a while
  const Scenario scenario = options.scenario.empty() ? paperHelix() : readScenarioOrInput(options.scenario);
  requireApart(scenario, {options.json, options.markdown});
  if (!scenario.manipulator->isOfThePaper())
    say("note: the formulas are those of six URS legs driven by phi, which this machine does not have\n");
  const Audit result = alongMotion(scenario, [&] {
    const Progress progress("audit");
    return runAudit(scenario);
  });
  if (!options.out.empty()) {
    const std::filesystem::path dir = options.out;
    OutputFolder out(dir);
    out.write("audit.json", auditJson(result));
    out.write("audit.html", auditHtml(result));
    out.commit();
    say("page: {}\n", (dir / "audit.html").string());
  }
  if (options.json != "-" && options.markdown != "-") writeOutput("-", auditText(result));
  if (!options.json.empty()) writeOutput(options.json, auditJson(result));
  if (!options.markdown.empty()) writeOutput(options.markdown, auditMarkdown(result));
  return exit_passed;
}

}  // namespace

void addAudit(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<AuditOptions>();
  CLI::App* verb =
      app.add_subcommand("audit", "Compares every printed formula of the paper with the correct one, with residuals");
  verb->add_option("scenario", options->scenario,
                   "Scenario file (TOML), - for standard input; default: the paper's helix, built in");
  verb->add_option("--out", options->out, "Folder for the page and the numbers");
  verb->add_option("--json", options->json, "The numbers as JSON; - for standard output");
  verb->add_option("--markdown", options->markdown, "The page docs/audit.md; - for standard output");
  verb->callback([options, &run] { run = [options] { return audit(*options); }; });
}

}  // namespace ursula

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "apps/files_apart.h"
#include "apps/mechanism.h"
#include "apps/progress.h"
#include "apps/verbs.h"
#include "base/output_folder.h"
#include "base/text.h"
#include "parts/engines/side_by_side/side_by_side.h"

namespace ursula {
namespace {

struct EnginesOptions {
  std::string scenario, out;
  std::vector<std::string> engines;
  SideBySideOptions asked;
  bool json = false;
};

std::vector<const LoopEngineKind*> namedEngines(const std::vector<std::string>& names) {
  std::vector<const LoopEngineKind*> out;
  for (const std::string& name : names) {
    const LoopEngineKind* kind = loopEngineNamed(name);
    if (kind == nullptr) {
      std::string known;
      for (const LoopEngineKind& each : loopEngines()) known += (known.empty() ? "" : ", ") + std::string(each.name);
      throw UsageError(fmt::format("--engine: '{}', expected one of {}", name, known));
    }
    if (!kind->available()) throw UsageError("--engine: " + sentenceOfMissing(*kind));
    out.push_back(kind);
  }
  return out;
}

int engines(EnginesOptions options) {
  if (!options.out.empty()) {
    refuseFile(options.out);
    refuseResults(options.out);
  }
  options.asked.engines = namedEngines(options.engines);
  const AnyScenario any = openAny(options.scenario);
  const std::string& said = any.mechanism ? any.mechanism->text : any.manipulator->text;
  const std::filesystem::path& file = any.mechanism ? any.mechanism->file : any.manipulator->file;
  if (!options.out.empty())
    requireKept(said, file, options.out, {"engines.json", "engines.csv", "efforts.csv", "report.html"});
  std::optional<OutputFolder> folder;  // made before the work, so that a folder that cannot be written is found early
  if (!options.out.empty()) folder.emplace(options.out);
  Progress progress(any.mechanism ? any.mechanism->name : any.manipulator->name);
  options.asked.on_progress = [&progress](double share, const std::string& engine) { progress.at(share, engine); };
  const auto asked = [&options](const auto& scenario) {
    return [&options, &scenario] { return engineSideBySide(scenario, options.asked); };
  };
  const SideBySide found = any.mechanism ? alongLoops(*any.mechanism, asked(*any.mechanism))
                                         : alongMotion(*any.manipulator, asked(*any.manipulator));
  if (folder) {
    folder->write("engines.json", sideBySideJson(found));
    folder->write("engines.csv", sideBySideCsv(found));
    folder->write("efforts.csv", effortsCsv(found));
    folder->write("report.html", sideBySideHtml(found));
    folder->commit();
  }
  std::string text = options.json ? sideBySideJson(found) : withoutControls(sideBySideText(found));
  if (folder && !options.json)
    text += fmt::format("page: {}\n", (std::filesystem::path(options.out) / "report.html").string());
  writeOutput("-", text);
  return exit_passed;
}

}  // namespace

void addEngines(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<EnginesOptions>();
  CLI::App* verb = app.add_subcommand(
      "engines", "Compares engines on one machine: how to get efforts right, how wrong the obvious calls are");
  verb->group(studying)->footer("Example: ursula engines my.toml --out engines");
  verb->add_option("scenario", options->scenario, "Scenario file (TOML), - for standard input")->required();
  verb->add_option("--out", options->out, "Folder for report.html, engines.json and engines.csv");
  verb->add_option("--engine", options->engines, "Names of the engines to ask; default: all in this build")
      ->delimiter(',');
  verb->add_option("--samples", options->asked.samples, "Number of instants at which efforts are compared")
      ->check(CLI::Range(2, 100000))
      ->capture_default_str();
  verb->add_option("--seconds", options->asked.moved, "Duration of the stepped motion from its start, s")
      ->check(finitePositive())
      ->capture_default_str();
  verb->add_flag("--json", options->json, "Writes JSON to standard output, and nothing else");
  verb->callback([options, &run] { run = [options] { return engines(*options); }; });
}

}  // namespace ursula

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/choice.h"
#include "apps/embedded_scenario.h"
#include "apps/mechanism.h"
#include "apps/output.h"
#include "apps/verbs.h"
#include "base/text.h"
#include "model/scenario_lengths.h"

namespace ursula {
namespace {

struct InitOptions {
  std::string file, kind = "URS", from, model;
  std::vector<std::string> motors;
  int lengths_per_metre = 1;
};

LegKind kindOf(const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < leg_kind_count; ++k) {
    names.emplace_back(leg_kinds[k].name);
    if (name == names.back()) return static_cast<LegKind>(k);
  }
  throw UsageError(fmt::format("--kind {}: unknown kind of leg, expected one of {}{}", name, fmt::join(names, ", "),
                               didYouMean(name, names)));
}

/// Returns the starting scenario, named after the file if that is a valid name.
std::string textFor(const std::string& file, LegKind kind) {
  const std::string stem = std::filesystem::path(file).stem().string();
  const bool plain = file != "-" && !stem.empty() && std::all_of(stem.begin(), stem.end(), [](unsigned char c) {
                       return c >= ' ' && c != '"' && c != '\\';
                     });
  std::string text = startingScenario(kind);
  const std::string name = "name = \"my-machine\"";
  if (plain) text.replace(text.find(name), name.size(), "name = \"" + stem + "\"");
  return text;
}

int init(const InitOptions& options) {
  if (options.file != "-" && std::filesystem::exists(std::filesystem::symlink_status(options.file)))
    throw UsageError(options.file + " exists, expected the name of a new file");
  if (!options.model.empty()) return initFromModel(options.file, options.model, options.motors);
  writeOutput(options.file, options.from.empty()
                                ? schemaLine(options.file) + textFor(options.file, kindOf(options.kind))
                                : withLengthsInMetres(options.lengths_per_metre, options.from));
  if (options.file != "-") say("wrote {}; change it, then: ursula check {}\n", options.file, shellWord(options.file));
  return exit_passed;
}

}  // namespace

std::string schemaLine(const std::string& file) {
  std::error_code failed;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", failed);
  for (const char* of : {"../share/ursula", "../docs"}) {  // installed, or built in its sources
    const auto schema = (program.parent_path() / of / "scenario.schema.json").lexically_normal();
    if (file != "-" && std::filesystem::exists(schema, failed)) return "#:schema " + schema.string() + "\n";
  }
  return "";
}

void addInit(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<InitOptions>();
  CLI::App* verb = app.add_subcommand("init", "Writes a commented scenario to start from; never overwrites");
  verb->group(preparing)->footer("Example: ursula init my.toml --kind UPS");
  verb->add_option("file", options->file, "New scenario file (TOML); - for standard output")->required();
  std::string kinds;
  for (const LegKindRow& row : leg_kinds)
    kinds += fmt::format("{}{} ({})", kinds.empty() ? "" : ", ", row.name, row.words);
  CLI::Option* kind = verb->add_option("--kind", options->kind, "Kind of the legs: " + kinds)->capture_default_str();
  CLI::Option* from = verb->add_option("--from", options->from, "Scenario (TOML) to write anew, with its comments");
  CLI::Option* lengths = verb->add_option("--lengths", options->lengths_per_metre,
                                          "Unit of the lengths in --from, which the new file has in m; all else stays");
  takeOneOf<int>(lengths, {{"mm", 1000}, {"cm", 100}})->needs(from);
  from->needs(lengths)->excludes(kind);
  CLI::Option* model = verb->add_option(
      "--model", options->model, "Model of a machine with closed loops (MJCF, SDF, URDF) to write a scenario for");
  model->excludes(kind)->excludes(from);
  verb->add_option("--motors", options->motors, "Joints that motors drive, instead of those that the model names")
      ->delimiter(',')
      ->needs(model);
  verb->callback([options, &run] { run = [options] { return init(*options); }; });
}

}  // namespace ursula

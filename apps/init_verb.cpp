#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/embedded_scenario.h"
#include "apps/output.h"
#include "apps/verbs.h"
#include "base/text.h"

namespace ursula {
namespace {

struct InitOptions {
  std::string file, kind = "URS";
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
  const LegKind kind = kindOf(options.kind);
  if (options.file != "-" && std::filesystem::exists(std::filesystem::symlink_status(options.file)))
    throw UsageError(options.file + " exists, expected the name of a new file");
  writeOutput(options.file, textFor(options.file, kind));
  if (options.file != "-") say("wrote {}; change it, then: ursula check {}\n", options.file, shellWord(options.file));
  return exit_passed;
}

}  // namespace

void addInit(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<InitOptions>();
  CLI::App* verb = app.add_subcommand("init", "Writes a commented scenario to start from; never overwrites");
  verb->add_option("file", options->file, "New scenario file (TOML); - for standard output")->required();
  std::string kinds;
  for (const LegKindRow& row : leg_kinds)
    kinds += fmt::format("{}{} ({})", kinds.empty() ? "" : ", ", row.name, row.words);
  verb->add_option("--kind", options->kind, "Kind of the legs: " + kinds)->capture_default_str();
  verb->callback([options, &run] { run = [options] { return init(*options); }; });
}

}  // namespace ursula

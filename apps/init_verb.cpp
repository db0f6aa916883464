#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/embedded_scenario.h"
#include "apps/verbs.h"
#include "model/nearest.h"

namespace ursula {
namespace {

struct InitOptions {
  std::string file, kind = "URS";
};

void requireKind(const std::string& kind) {
  const std::vector<std::string> kinds = {"URS", "UPS", "RUS", "PUS"};
  if (kind == kinds.front()) return;
  if (std::find(kinds.begin(), kinds.end(), kind) != kinds.end())
    throw UsageError(fmt::format("--kind {}: legs of this kind are not supported yet, expected URS", kind));
  throw UsageError(fmt::format("--kind {}: no such kind of leg, expected URS{}", kind, didYouMean(kind, kinds)));
}

/// The starting scenario, named after the file where that makes a name.
std::string textFor(const std::string& file) {
  const std::string stem = std::filesystem::path(file).stem().string();
  const bool plain = file != "-" && !stem.empty() && std::all_of(stem.begin(), stem.end(), [](unsigned char c) {
                       return c >= ' ' && c != '"' && c != '\\';
                     });
  std::string text = startingScenario();
  const std::string name = "name = \"my-machine\"";
  if (plain) text.replace(text.find(name), name.size(), "name = \"" + stem + "\"");
  return text;
}

int init(const InitOptions& options) {
  requireKind(options.kind);
  if (options.file != "-" && std::filesystem::exists(std::filesystem::symlink_status(options.file)))
    throw UsageError(options.file + ": is there already and is left as it is, expected the name of a new file");
  writeOutput(options.file, textFor(options.file));
  if (options.file != "-")
    fmt::print(stderr, "wrote {}; change it, then: ursula check {}\n", options.file, options.file);
  return exit_passed;
}

}  // namespace

void addInit(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<InitOptions>();
  CLI::App* verb = app.add_subcommand("init", "Writes a commented scenario to start from; never overwrites");
  verb->add_option("file", options->file, "New scenario file (TOML); - for standard output")->required();
  verb->add_option("--kind", options->kind, "Kind of the legs; URS alone yet")->capture_default_str();
  verb->callback([options, &run] { run = [options] { return init(*options); }; });
}

}  // namespace ursula

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/verbs.h"
#include "model/scenario.h"
#include "validation/report/report.h"
#include "validation/validate.h"

namespace ursula {
namespace {

struct ValidateOptions {
  std::vector<std::string> scenarios;
  std::string torques, out;
  int jobs = 1;
};

int exitCode(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass: return exit_passed;
    case Verdict::inconclusive: return exit_inconclusive;
    case Verdict::fail: break;
  }
  return exit_failed;
}

void printChecks(const ValidationResult& result) {
  fmt::print("{}: {}\n", result.scenario, name(result.verdict));
  for (const Check& check : result.checks)
    fmt::print("  {:<12} {:<32} {:>10.3g} of {:>10.3g} {}\n", name(check.verdict), check.name, check.value, check.limit,
               check.unit);
}

int validateOne(const std::string& file, const std::filesystem::path& out) {
  const Scenario scenario = readScenario(file);
  const std::filesystem::path dir = out.empty() ? std::filesystem::path("results") / scenario.name : out;
  const ValidationResult result = validate(scenario);
  writeResults(result, dir);
  printChecks(result);
  fmt::print("verdict: {} — {}\nreport: {}\n", name(result.verdict), reason(result.verdict, result.checks),
             (dir / "report.html").string());
  return exitCode(result.verdict);
}

}  // namespace

void addValidate(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<ValidateOptions>();
  CLI::App* verb = app.add_subcommand("validate", "Judge the torques of a scenario against Simbody, with reasons");
  verb->add_option("scenario", options->scenarios, "Scenario files (TOML)")->required();
  verb->add_option("--out", options->out, "Folder of the results; default results/NAME");
  verb->callback([options, &run] { run = [options] { return validateOne(options->scenarios.front(), options->out); }; });
}

}  // namespace ursula

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <thread>

#include "apps/choice.h"
#include "apps/progress.h"
#include "apps/verbs.h"
#include "base/output_file.h"
#include "parts/prove/prove.h"

namespace ursula {
namespace {

struct ProveOptions {
  std::string scenario, out;
  int jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  int random = 24;
  std::uint64_t seed = 1;
  RandomKind kind = RandomKind::URS;
  bool only_random = false;
};

/// Counts finished items from any thread; the argument is their total.
std::function<void(int)> progress(const char* what) {
  const auto bar = std::make_shared<Progress>(what);
  const auto count = std::make_shared<std::atomic<int>>(0);
  return [bar, count](int total) {
    const int done = ++*count;
    bar->at(static_cast<double>(done) / total, fmt::format("{} of {}", done, total));
  };
}

std::string remark(const DefectOutcome& outcome) {
  if (!outcome.refused.empty()) return "  refused: " + outcome.refused;
  if (!outcome.shows) return "  changes nothing here";
  if (!outcome.caught()) return fmt::format("  TOO FEW of {}", outcome.formulations_wanted);
  return outcome.formulations_wanted == 1 ? "  of 1 that can" : "";
}

void printMatrix(const std::vector<DefectOutcome>& outcomes) {
  const std::vector<std::string> columns = catchingChecks(outcomes);
  fmt::print("Defect by check: x where the check failed, as it should.\n\n");
  for (std::size_t k = 0; k < columns.size(); ++k) fmt::print("  {:>2} {}\n", k + 1, columns[k]);
  fmt::print("\n{:<70}", "");
  for (std::size_t k = 0; k < columns.size(); ++k) fmt::print("{:>3}", k + 1);
  fmt::print(" formulations\n");
  int shown = 0, on_one = 0;
  for (const DefectOutcome& outcome : outcomes) {
    fmt::print("{:<70}", outcome.name);
    for (const std::string& column : columns) {
      const bool caught =
          std::find(outcome.caught_by.begin(), outcome.caught_by.end(), column) != outcome.caught_by.end();
      fmt::print("{:>3}", caught ? "x" : ".");
    }
    shown += outcome.shows;
    on_one += outcome.shows && outcome.formulations_wanted == 1;
    fmt::print("{:>4}{}\n", outcome.formulations(), remark(outcome));
  }
  fmt::print(
      "\n{} defects, {} of them change results here; {} of these can show on one formulation only; {} are caught on "
      "too few formulations (at least two for the others)\n\n",
      outcomes.size(), shown, on_one, weakDefects(outcomes));
}

void printChecks(const std::vector<CheckProof>& checks) {
  fmt::print(
      "Each check, with the defects that it alone catches, and those that it catches first (in the result's "
      "order).\n\n");
  fmt::print("{:<30} {:>5} {:>5}\n", "", "alone", "first");
  for (const CheckProof& proof : checks) {
    fmt::print("{:<30} {:>5} {:>5}  ", proof.check, proof.alone.size(), proof.first.size());
    fmt::print("{}\n", !isNeeded(proof) ? "NONE" : caughtBy(proof, 3));
  }
  fmt::print("\n{} checks; {} of them catch no defect alone or first\n\n", checks.size(), idleChecks(checks));
}

void printSensitivities(const std::vector<Sensitivity>& sensitivities) {
  fmt::print("Smallest relative error that torque.pointwise still catches, over each kind of parameter:\n\n");
  fmt::print("{:<10} {:>5} {:>7}  {:>10} {:>10}  {:<34} {}\n", "kind", "count", "unseen", "best", "worst", "the worst",
             "torque change caught, at most");
  for (const SensitivityGroup& group : groupsOf(sensitivities))
    fmt::print("{:<10} {:>5} {:>7}  {:>10.1e} {:>10.1e}  {:<34} {:.1e}\n", group.name, group.count, group.unseen,
               group.smallest, group.worst.smallest_caught, group.worst.parameter, group.largest_change);
  fmt::print("\nThe same for each parameter (relative error; change of torque over the largest torque):\n\n");
  for (const Sensitivity& each : sensitivities)
    if (std::isinf(each.smallest_caught))
      fmt::print("  {:<34} does not show\n", each.parameter);
    else
      fmt::print("  {:<34} {:.1e}  {:.1e}\n", each.parameter, each.smallest_caught, each.torque_change);
  fmt::print("\n");
}

void printRandom(const RandomOutcomes& random, std::uint64_t seed, RandomKind kind) {
  const std::string of = kind == RandomKind::URS ? "" : fmt::format(" ({})", nameOf(kind));
  fmt::print("Random valid scenarios{}, seeds {} to {}: {} passed, {} failed, {} inconclusive\n", of, seed,
             seed + static_cast<std::uint64_t>(random.runs) - 1, random.passed, random.failed.size(),
             random.inconclusive.size());
  if (random.runs > 0) fmt::print("\nThe largest share of its limit that each check reached:\n\n");
  for (const auto& [check, share] : random.largest_share) fmt::print("  {:<34} {:.2g}\n", check, share);
  for (const std::string& why : random.failed) fmt::print("  false alarm: {}\n", why);
  for (const std::string& why : random.inconclusive) fmt::print("  inconclusive: {}\n", why);
}

void proveChecks(const ProveOptions& options, const Scenario& scenario, ProveResult& found) {
  found.proof = alongMotion(scenario, [&] { return proveDefects(scenario, options.jobs, progress("defects")); });
  printMatrix(found.proof->outcomes);
  found.sensitivities = proveSensitivities(scenario);
  printSensitivities(found.sensitivities);
  printChecks(found.proof->checks);
  for (const std::string& check : found.proof->without_defect) fmt::print("Without a defect this fails: {}.\n", check);
}

int prove(const ProveOptions& options) {
  refuseFile(options.out);
  const std::filesystem::path page = std::filesystem::path(options.out) / "prove.html";
  if (!options.out.empty()) requireWritable(page);  // the rest takes minutes
  const Scenario scenario = options.scenario.empty() ? provingGround() : openScenario(options.scenario);
  ProveResult found;
  found.scenario = scenario.name;
  found.seed = options.seed;
  if (!options.only_random) proveChecks(options, scenario, found);
  found.random = proveRandom(options.seed, options.random, options.jobs, progress("random scenarios"), options.kind);
  printRandom(found.random, options.seed, options.kind);
  if (!options.out.empty()) {
    writeOutput(page.string(), proveHtml(found));
    fmt::print("page: {}\n", page.string());
  }
  return isProved(found) ? exit_passed : exit_failed;
}

}  // namespace

void addProve(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<ProveOptions>();
  CLI::App* verb = app.add_subcommand("prove", "Injects defects into the solver and shows which check catches each");
  verb->group(studying)->footer("Example: ursula prove my.toml");
  verb->add_option("scenario", options->scenario,
                   "Scenario file (TOML), - for standard input; default: the built-in proving ground");
  verb->add_option("--out", options->out, "Folder for a page: defects against checks, thresholds");
  verb->add_option("--jobs", options->jobs, "Threads")->check(CLI::Range(1, 1024))->capture_default_str();
  verb->add_option("--random", options->random, "Number of random valid scenarios; none may fail")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  verb->add_option("--seed", options->seed, "Seed of the first random scenario")
      ->check(wholeNumber())
      ->capture_default_str();
  std::map<std::string, RandomKind> kinds;
  for (std::size_t k = 0; k < random_kind_names.size(); ++k) kinds[random_kind_names[k]] = static_cast<RandomKind>(k);
  takeOneOf(verb->add_option("--kind", options->kind, "Legs of the random machines"), kinds)->default_str("URS");
  verb->add_flag("--only-random", options->only_random, "Leaves out the defects");
  verb->callback([options, &run] { run = [options] { return prove(*options); }; });
}

}  // namespace ursula

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <set>
#include <thread>

#include "apps/embedded_scenario.h"
#include "apps/verbs.h"
#include "model/scenario.h"
#include "validation/prove.h"

namespace ursula {
namespace {

struct ProveOptions {
  std::string scenario;
  int jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  int random = 24;
  std::uint64_t seed = 1;
  bool only_random = false;
};

/// One line each tenth on stderr.
std::function<void(int)> progress(const char* what) {
  const auto count = std::make_shared<std::atomic<int>>(0);
  return [count, what](int total) {
    const int done = ++*count;
    if (done * 10 / total != (done - 1) * 10 / total) fmt::print(stderr, "{}: {} of {}\n", what, done, total);
  };
}

/// Columns: every check that caught anything, in the order of its first catch.
std::vector<std::string> columnsOf(const std::vector<DefectOutcome>& outcomes) {
  std::vector<std::string> columns;
  for (const DefectOutcome& outcome : outcomes)
    for (const std::string& check : outcome.caught_by)
      if (std::find(columns.begin(), columns.end(), check) == columns.end()) columns.push_back(check);
  return columns;
}

std::size_t roadsThatCaught(const DefectOutcome& outcome) {
  std::set<std::string> roads;
  for (const std::string& check : outcome.caught_by) roads.insert(roadOf(check));
  return roads.size();
}

/// Returns how many defects that show were caught on fewer than two roads.
int printMatrix(const std::vector<DefectOutcome>& outcomes) {
  const std::vector<std::string> columns = columnsOf(outcomes);
  fmt::print("Defect by check: x where the check failed, as it should.\n\n");
  for (std::size_t k = 0; k < columns.size(); ++k) fmt::print("  {:>2} {}\n", k + 1, columns[k]);
  fmt::print("\n{:<52}", "");
  for (std::size_t k = 0; k < columns.size(); ++k) fmt::print("{:>3}", k + 1);
  fmt::print(" roads\n");
  int shown = 0, weak = 0;
  for (const DefectOutcome& outcome : outcomes) {
    fmt::print("{:<52}", outcome.name);
    for (const std::string& column : columns) {
      const bool caught =
          std::find(outcome.caught_by.begin(), outcome.caught_by.end(), column) != outcome.caught_by.end();
      fmt::print("{:>3}", caught ? "x" : ".");
    }
    shown += outcome.shows;
    const std::size_t roads = roadsThatCaught(outcome);
    const bool too_few = outcome.shows && roads < 2;
    weak += too_few;
    fmt::print("{:>4}{}\n", roads, !outcome.shows ? "  changes nothing here" : too_few ? "  TOO FEW" : "");
  }
  fmt::print("\n{} defects, {} of them change something here; {} caught on fewer than two roads\n\n", outcomes.size(),
             shown, weak);
  return weak;
}

void printSensitivities(const std::vector<Sensitivity>& sensitivities) {
  struct Group {
    int count = 0, unseen = 0;
    Sensitivity worst;
    double smallest = 1, largest_change = 0;
  };
  std::map<std::string, Group> groups;
  for (const Sensitivity& each : sensitivities) {
    Group& group = groups[each.group];
    ++group.count;
    if (std::isinf(each.smallest_caught)) {
      ++group.unseen;
      continue;
    }
    group.smallest = std::min(group.smallest, each.smallest_caught);
    group.largest_change = std::max(group.largest_change, each.torque_change);
    if (each.smallest_caught > group.worst.smallest_caught) group.worst = each;
  }
  fmt::print("Smallest relative error that torque.pointwise still catches, over each kind of parameter:\n\n");
  fmt::print("{:<10} {:>5} {:>7}  {:>10} {:>10}  {:<34} {}\n", "kind", "count", "unseen", "best", "worst", "the worst",
             "torque change caught, at most");
  for (const auto& [name, group] : groups)
    fmt::print("{:<10} {:>5} {:>7}  {:>10.1e} {:>10.1e}  {:<34} {:.1e}\n", name, group.count, group.unseen,
               group.smallest, group.worst.smallest_caught, group.worst.parameter, group.largest_change);
  fmt::print("\nThe same for each parameter (relative error; change of torque over the largest torque):\n\n");
  for (const Sensitivity& each : sensitivities)
    if (std::isinf(each.smallest_caught))
      fmt::print("  {:<34} does not show\n", each.parameter);
    else
      fmt::print("  {:<34} {:.1e}  {:.1e}\n", each.parameter, each.smallest_caught, each.torque_change);
  fmt::print("\n");
}

void printRandom(const RandomOutcomes& random, std::uint64_t seed) {
  fmt::print("Random valid scenarios, seeds {} to {}: {} passed, {} failed, {} inconclusive\n", seed,
             seed + static_cast<std::uint64_t>(random.runs) - 1, random.passed, random.failed.size(),
             random.inconclusive.size());
  if (random.runs > 0) fmt::print("\nThe largest share of its limit that each check reached:\n\n");
  for (const auto& [check, share] : random.largest_share) fmt::print("  {:<34} {:.2g}\n", check, share);
  for (const std::string& why : random.failed) fmt::print("  false alarm: {}\n", why);
  for (const std::string& why : random.inconclusive) fmt::print("  inconclusive: {}\n", why);
}

int prove(const ProveOptions& options) {
  int weak = 0;
  if (!options.only_random) {
    const Scenario scenario = options.scenario.empty() ? provingGround() : readScenario(options.scenario);
    weak = printMatrix(proveDefects(scenario, options.jobs, progress("defects")));
    printSensitivities(proveSensitivities(scenario));
  }
  const RandomOutcomes random = proveRandom(options.seed, options.random, options.jobs, progress("random scenarios"));
  printRandom(random, options.seed);
  return weak == 0 && random.failed.empty() ? exit_passed : exit_failed;
}

}  // namespace

void addProve(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<ProveOptions>();
  CLI::App* verb = app.add_subcommand("prove", "Inject defects into the solver and show which check catches each");
  verb->add_option("scenario", options->scenario, "Scenario file (TOML); default: the built-in proving ground");
  verb->add_option("--jobs", options->jobs, "Threads")->check(CLI::Range(1, 1024))->capture_default_str();
  verb->add_option("--random", options->random, "Random valid scenarios, none of which may fail")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  verb->add_option("--seed", options->seed, "Seed of the first of them")->capture_default_str();
  verb->add_flag("--only-random", options->only_random, "Leave out the defects");
  verb->callback([options, &run] { run = [options] { return prove(*options); }; });
}

}  // namespace ursula

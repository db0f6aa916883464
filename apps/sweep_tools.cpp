#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "apps/progress.h"
#include "apps/streams.h"
#include "apps/sweep_verbs.h"
#include "apps/verbs.h"
#include "base/shell_word.h"
#include "studies/sweep/merge.h"

namespace ursula {
namespace {

struct MergeOptions {
  std::vector<std::string> parts;
  std::string database;
};

/// Reports the missing points, and the commands that compute them.
void sayMissing(const MergeResult& result, const std::string& database) {
  const SweepIdentity& sweep = result.identity;
  const auto missing = sweep.points - result.done;
  say("{} of {} points {} missing", missing, sweep.points, missing == 1 ? "is" : "are");
  if (!result.missing.empty())
    say(", the first from {} to {}", result.missing.front().first, result.missing.front().end - 1);
  say("; to make them:\n");
  const std::string flag = sweep.pointwise ? " --pointwise" : "";
  const std::string file = shellWord(sweep.file);
  if (result.missing_shards.empty()) say("  ursula sweep {}{} --db {}\n", file, flag, shellWord(database));
  for (const Shard& shard : result.missing_shards)
    say("  ursula sweep {}{} --shard {}/{}\n", file, flag, shard.index, shard.of);
}

int merge(const MergeOptions& options) {
  MergeResult result;
  catchStops();
  try {
    Progress progress("merge");
    const auto count = static_cast<double>(options.parts.size());
    result = mergeSweeps(
        {options.parts.begin(), options.parts.end()}, options.database,
        [&](std::size_t done) {
          progress.at(static_cast<double>(done) / count, fmt::format("{} of {} databases", done, options.parts.size()));
        },
        [] { return stopSignal() != 0; });
  } catch (const DatabaseStopped&) {
    say("stopped: the databases merged so far are in {}; the same command continues from there\n", options.database);
    return 128 + stopSignal();
  }
  fmt::print("{} of {} points, {} of them new\n{}\n", result.done, result.identity.points, result.added,
             options.database);
  if (result.missing.empty()) return exit_passed;
  sayMissing(result, options.database);
  return exit_inconclusive;
}

struct ShowOptions {
  std::string sweep;
  std::int64_t id = 0;
};

int show(const ShowOptions& options) {
  SweepPlan plan(readSweepFile(options.sweep));
  if (options.id >= plan.points().count())
    throw UsageError(
        fmt::format("point {}: {} has points 0 to {}", options.id, options.sweep, plan.points().count() - 1));
  fmt::print("{}", plan.text(options.id));
  return exit_passed;
}

}  // namespace

void addSweepMerge(CLI::App& sweep, std::function<int()>& run) {
  const auto options = std::make_shared<MergeOptions>();
  CLI::App* verb = sweep.add_subcommand("merge", "Merges the databases of shards into one; may be called again");
  verb->add_option("databases", options->parts, "Databases of one sweep")->required();
  verb->add_option("--db", options->database, "Database that receives all points; it is made if it does not exist")
      ->required();
  verb->footer(
      "Exit code: 0 if all points are there; 3 if some are missing: it then names them and prints the commands that "
      "make them.\n"
      "130 or 143 if Ctrl-C or SIGTERM stopped it: the same command continues.");
  verb->callback([options, &run] { run = [options] { return merge(*options); }; });
}

void addSweepShow(CLI::App& sweep, std::function<int()>& run) {
  const auto options = std::make_shared<ShowOptions>();
  CLI::App* verb = sweep.add_subcommand("show", "Writes one point as a scenario, for ursula validate");
  verb->add_option("sweep", options->sweep, "Sweep file (TOML)")->required();
  verb->add_option("id", options->id, "Number of the point, from 0")
      ->required()
      ->check(CLI::Range(std::int64_t{0}, most_points - 1));
  verb->footer("Exit code: 0, or 2 if there is no such point.");
  verb->callback([options, &run] { run = [options] { return show(*options); }; });
}

}  // namespace ursula

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <memory>
#include <thread>

#include "apps/output.h"
#include "apps/progress.h"
#include "apps/verbs.h"
#include "parts/sweep/run.h"
#include "parts/sweep/slurm.h"
#include "parts/sweep/sweep_verbs.h"

namespace ursula {
namespace {

struct SweepOptions {
  std::string sweep, database, shard;
  bool pointwise = false, retry_errors = false;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  bool jobs_given = false, slurm = false, dry_run = false;
  int shards = 0;
};

volatile std::sig_atomic_t asked_to_stop = 0;

extern "C" void askToStop(int signal) { asked_to_stop = signal; }

Shard shardOf(const std::string& text) {
  Shard shard;
  if (text.empty()) return shard;
  char rest = '\0';
  if (std::sscanf(text.c_str(), "%d/%d%c", &shard.index, &shard.of, &rest) != 2 || shard.of < 1 || shard.index < 1 ||
      shard.index > shard.of || shard.of > most_shards)
    throw UsageError(
        fmt::format("--shard {}: expected I/N with I from 1 to N, and N to {}, such as 1/4", text, most_shards));
  return shard;
}

std::filesystem::path databaseOf(const SweepOptions& options, const Shard& shard) {
  if (options.database == "-") throw UsageError("--db -: expected a file, not standard output");
  if (!options.database.empty()) return options.database;
  const std::string stem = std::filesystem::path(options.sweep).stem().string();
  return std::filesystem::path("results") / defaultDatabase(stem, shard);
}

/// "998 pass, 2 out_of_reach".
std::string inWords(const std::map<std::string, std::int64_t>& verdicts) {
  std::string out;
  for (const char* verdict : {"pass", "fail", "inconclusive", "out_of_reach", "singular", "error"})
    if (const auto found = verdicts.find(verdict); found != verdicts.end())
      out += fmt::format("{}{} {}", out.empty() ? "" : ", ", found->second, verdict);
  return out;
}

int codeOf(const SweepRunResult& result) {
  if (result.stopped) return 128 + stopSignal();
  if (result.verdicts.count("fail") > 0) return exit_failed;
  return result.verdicts.count("inconclusive") + result.verdicts.count("error") > 0 ? exit_inconclusive : exit_passed;
}

void tellOutcome(const SweepRunResult& result, const std::filesystem::path& database, bool retried) {
  if (result.stopped) {
    say("stopped: {} of {} points are in {}; the same command continues from there\n", result.done, result.points,
        database.string());
    return;
  }
  if (result.new_ones == 0) say("nothing to do: all {} points are in {}\n", result.points, database.string());
  if (!retried && result.verdicts.count("error") > 0) say("points in error stay so; --retry-errors makes them again\n");
  fmt::print("{} points: {}\n{}\n", result.points, inWords(result.verdicts), database.string());
}

int sweep(const SweepOptions& options) {
  const Shard shard = shardOf(options.shard);
  const std::filesystem::path database = databaseOf(options, shard);
  SweepFile file = readSweepFile(options.sweep);
  if (options.pointwise && file.work != SweepWork::validate)
    throw UsageError("--pointwise: expected a sweep with what = \"validate\"");
  file.pointwise = file.pointwise || options.pointwise;
  SweepPlan plan(std::move(file));
  if (plan.mechanism() == nullptr) sayWarnings(plan.base());
  if (options.slurm)
    return submitSweep(
        plan, {options.sweep, database, options.shards, options.jobs_given ? options.jobs : 1, options.dry_run});
  catchStops();
  SweepRunResult result;
  {
    Progress progress(std::filesystem::path(options.sweep).stem().string());
    const auto start = std::chrono::steady_clock::now();
    std::int64_t before = -1;
    SweepRunOptions run{options.jobs, shard, options.retry_errors, [] { return stopSignal() != 0; }};
    run.progress = [&](std::int64_t done, std::int64_t of) {
      if (before < 0) before = done - 1;
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      progress.at(
          static_cast<double>(done) / static_cast<double>(of),
          fmt::format("{} of {} points, {:.3g} a second", done, of, static_cast<double>(done - before) / seconds));
    };
    result = runSweep(plan, database, run);
  }
  tellOutcome(result, database, options.retry_errors);
  return codeOf(result);
}

void addSlurmOptions(CLI::App& verb, SweepOptions& options) {
  CLI::Option* slurm =
      verb.add_flag("--slurm", options.slurm, "Submits the sweep to a Slurm cluster: a job array, then a merge");
  slurm->excludes("--shard")->excludes("--retry-errors");
  verb.add_option("--shards", options.shards, "Number of tasks in the array; each has --jobs processes, default 1")
      ->check(CLI::Range(1, most_slurm_shards))
      ->needs(slurm);
  verb.add_flag("--dry-run", options.dry_run, "Prints the scripts and submits nothing; needs no Slurm")->needs(slurm);
}

}  // namespace

void catchStops() {
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_IGN) std::signal(signal, askToStop);  // NOLINT(performance-no-int-to-ptr)
  }
}

int stopSignal() { return static_cast<int>(asked_to_stop); }

std::string defaultDatabase(const std::string& stem, const Shard& shard) {
  return shard.of == 1 ? stem + ".db" : fmt::format("{}.shard-{}-of-{}.db", stem, shard.index, shard.of);
}

void addSweep(CLI::App& app, std::function<int()>& run) {
  const auto options = std::make_shared<SweepOptions>();
  CLI::App* verb = app.add_subcommand("sweep",
                                      "Runs many variants of one scenario into a database; continues where it stopped. "
                                      "Also:\nsweep merge, report, show");
  verb->group(studying);
  verb->add_option("sweep", options->sweep, "Sweep file (TOML)");
  verb->add_option("--db", options->database, "SQLite database; default results/SWEEP.db");
  verb->add_option("--jobs", options->jobs, "Processes; rows are the same for any number")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  verb->add_option("--shard", options->shard, "I/N: runs only the I-th of N parts, I from 1, into its own database");
  verb->add_flag("--pointwise", options->pointwise,
                 "Runs only the checks that need no replay, which is some hundred times as fast");
  verb->add_flag("--retry-errors", options->retry_errors,
                 "Runs points again that ended in error, for example because memory ran out");
  addSlurmOptions(*verb, *options);
  verb->footer(
      "Example: ursula sweep study.toml --db study.db --jobs 2\n"
      "Exit code: 1 if any point failed, else 3 if any was inconclusive or in error, else 0; a point out of reach or\n"
      "singular is a result. 130 if Ctrl-C stopped it, 143 if SIGTERM did: finished points are kept, and the same\n"
      "command continues.");
  addSweepMerge(*verb, run);
  addSweepReport(*verb, run);
  addSweepShow(*verb, run);
  verb->callback([verb, options, &run] {
    if (!verb->get_subcommands().empty()) return;
    if (options->sweep.empty()) throw CLI::RequiredError("sweep");
    options->jobs_given = verb->count("--jobs") > 0;
    run = [options] { return sweep(*options); };
  });
}

}  // namespace ursula

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <system_error>

#include "apps/output.h"
#include "apps/progress.h"
#include "apps/verbs.h"
#include "base/child_process.h"
#include "base/output_file.h"
#include "base/text.h"
#include "parts/sweep/merge.h"
#include "parts/sweep/slurm.h"
#include "parts/sweep/sweep_verbs.h"

namespace ursula {
namespace {

std::filesystem::path absolutePath(const std::filesystem::path& path) {
  return std::filesystem::absolute(path).lexically_normal();
}

SlurmJob jobOf(const SweepPlan& plan, const SlurmCall& call) {
  SlurmJob out;
  out.program = std::filesystem::read_symlink("/proc/self/exe");
  out.sweep = absolutePath(call.sweep);
  out.database = absolutePath(call.database);
  out.pointwise = plan.file().pointwise;
  out.shards = call.shards;
  out.cpus = call.cpus;
  out.settings = plan.file().slurm;
  return out;
}

std::string outputOf(const std::vector<std::string>& words) try {
  return answerOf(words);
} catch (const std::system_error& refusal) {
  if (refusal.code() == std::errc::no_such_file_or_directory)
    throw std::runtime_error("there is no " + words.front() + " on PATH");
  throw;
}

std::vector<QueuedTask> queueOf(const SlurmJobs& jobs) {
  if (jobs.shards == 0) return {};
  return readQueue(outputOf({"squeue", "--noheader", "--array", fmt::format("--user={}", ::getuid()),
                             fmt::format("--format={}", queue_format)}));
}

/// Parses the answer with --parsable: "12", or "12;cluster".
std::int64_t submitted(const std::vector<std::string>& words) {
  const std::string answer = outputOf(words);
  try {
    return std::stoll(answer);
  } catch (const std::logic_error&) {
    throw std::runtime_error(fmt::format("sbatch said '{}', expected the number of a job", shown(answer)));
  }
}

/// Reports shards that are neither missing nor complete.
void sayOthers(const SlurmStanding& standing, const std::filesystem::path& database, int shards) {
  if (const std::vector<int> queued = standing.in(ShardState::queued); !queued.empty())
    fmt::print("{} of {} shards are already in the queue (job {}) and are not submitted again\n", queued.size(), shards,
               fmt::join(standing.arrays, " and "));
  for (const int index : standing.in(ShardState::locked))
    fmt::print("{} is in use and its shard is not submitted; call again when its writer has ended\n",
               shardDatabase(database, {index, shards}).string());
}

/// Submits the jobs of one call and records them.
class Submission {
 public:
  Submission(SlurmJob job, const SlurmStanding& standing)
      : job_(std::move(job)),
        folder_(slurmFolder(job_.database)),
        jobs_{job_.shards, standing.arrays, standing.merges} {
    std::filesystem::create_directories(folder_ / "logs");  // Slurm does not create the folder of logs
    writeSlurmJobs(folder_, jobs_);                         // fails before anything is submitted
  }

  void array() {
    const std::filesystem::path script = folder_ / "array.sh";
    writeFileAtomically(script, arrayScript(job_));
    jobs_.arrays.push_back(submitted({"sbatch", "--parsable", script.string()}));
    fmt::print("{} of {} shards submitted ({}): job {}\n", job_.todo.size(), job_.shards, arrayNumbers(job_.todo),
               jobs_.arrays.back());
    writeSlurmJobs(folder_, jobs_);
  }

  /// Runs after all queued jobs, because two merges would block each other.
  void merge() {
    const std::filesystem::path script = folder_ / "merge.sh";
    writeFileAtomically(script, mergeScript(job_));
    std::vector<std::string> words = {"sbatch", "--parsable"};
    std::vector<std::int64_t> before = jobs_.arrays;
    before.insert(before.end(), jobs_.merges.begin(), jobs_.merges.end());
    if (!before.empty()) words.push_back(fmt::format("--dependency=afterany:{}", fmt::join(before, ":")));
    words.push_back(script.string());
    jobs_.merges.push_back(submitted(words));
    fmt::print("merge into {}: job {}\n", job_.database.string(), jobs_.merges.back());
    writeSlurmJobs(folder_, jobs_);
  }

  std::filesystem::path logs() const { return folder_ / "logs"; }

 private:
  SlurmJob job_;
  std::filesystem::path folder_;
  SlurmJobs jobs_;
};

void printScripts(const SlurmJob& job, bool merge) {
  const std::filesystem::path folder = slurmFolder(job.database);
  if (!job.todo.empty()) fmt::print("# {}\n{}\n", (folder / "array.sh").string(), arrayScript(job));
  if (merge)
    fmt::print("# {}, with --dependency=afterany:JOB of the array\n{}", (folder / "merge.sh").string(),
               mergeScript(job));
}

void submit(const SlurmJob& job, const SlurmStanding& standing, bool merge) {
  Submission submission(job, standing);
  if (!job.todo.empty()) submission.array();
  if (merge) submission.merge();
  fmt::print("logs: {}\n", submission.logs().string());
}

}  // namespace

int submitSweep(const SweepPlan& plan, SlurmCall call) {
  if (call.shards == 0) throw UsageError("--slurm: expected also --shards N, the number of tasks that share the sweep");
  const SweepIdentity sweep = plan.identity();
  if (call.shards > sweep.points) {
    say("--shards {}: reduced to {}, the number of points\n", call.shards, sweep.points);
    call.shards = static_cast<int>(sweep.points);
  }
  SlurmJob job = jobOf(plan, call);
  const SlurmJobs jobs = readSlurmJobs(slurmFolder(job.database));
  const std::vector<QueuedTask> queue = call.dry_run ? std::vector<QueuedTask>{} : queueOf(jobs);
  const SlurmStanding standing = standingOf(sweep, job.database, job.shards, jobs, queue);
  const bool in_queue = !standing.arrays.empty() || !standing.merges.empty();
  if (in_queue && jobs.shards != job.shards)
    throw UsageError(fmt::format("--shards {}: jobs of this sweep in {} are in the queue; wait for them, or scancel {}",
                                 job.shards, jobs.shards,
                                 fmt::join(standing.arrays.empty() ? standing.merges : standing.arrays, " ")));
  if (standing.merged) {
    fmt::print("nothing to do: all {} points are in {}\n", sweep.points, job.database.string());
    return exit_passed;
  }
  job.todo = standing.in(ShardState::missing);
  const bool all_there = standing.in(ShardState::complete).size() == standing.shards.size();
  const bool merge = !job.todo.empty() || (standing.merges.empty() && (all_there || !standing.arrays.empty()));
  if (call.dry_run) {
    printScripts(job, merge);
    return exit_passed;
  }
  sayOthers(standing, job.database, job.shards);
  if (!job.todo.empty() || merge)
    submit(job, standing, merge);
  else if (!standing.merges.empty())
    fmt::print("the merge is in the queue already: job {}\n", fmt::join(standing.merges, " and "));
  return exit_passed;
}

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

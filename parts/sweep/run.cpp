#include "parts/sweep/run.h"

#include <algorithm>
#include <chrono>

namespace ursula {
namespace {

/// Returns missing points in order, a handful at a time.
class Missing {
 public:
  Missing(SweepDatabase& database, std::int64_t first, std::int64_t end, std::int64_t handful)
      : database_(database), at_(first), end_(end), handful_(handful), known_(database.firstDone(first, end)) {}

  PointRange next() {
    for (; at_ == known_ && at_ < end_; known_ = database_.firstDone(at_, end_)) ++at_;
    const std::int64_t from = at_;
    at_ = std::min({from + handful_, end_, known_});
    return {from, at_};
  }

 private:
  SweepDatabase& database_;
  std::int64_t at_, end_, handful_;
  std::int64_t known_;  ///< the first existing point from at_ on
};

/// Returns how many points to hand out at once, so that hand-outs are few and all workers end at about the same time.
std::int64_t handfulOf(const SweepPlan& plan, std::int64_t points, int jobs) {
  const std::int64_t most = plan.file().work == SweepWork::inverse ? 64 : 1;
  return std::clamp<std::int64_t>(points / (8 * jobs), 1, most);
}

/// Computes missing points. Commits so rarely that it costs little, and so often that little can be lost.
void compute(SweepPlan& plan, Missing missing, SweepDatabase& database, const SweepRunOptions& options,
             SweepRunResult& out) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds between{500};
  Clock::time_point last = Clock::now();
  WorkerTasks tasks;
  tasks.next = [&] { return missing.next(); };
  tasks.makeWork = [&plan] { return workOn(plan); };
  tasks.parameters = [&plan](std::int64_t i) { return plan.parameters(i); };
  tasks.done = [&](const SweepPoint& point) {
    database.add(point);
    if (Clock::now() - last >= between) {
      database.commit();
      last = Clock::now();
    }
    ++out.new_ones;
    if (options.progress) options.progress(out.done + out.new_ones, out.points);
  };
  tasks.stop = options.stop;
  out.stopped = !runWorkers(options.jobs, tasks);
  database.commit();
}

}  // namespace

SweepRunResult runSweep(SweepPlan& plan, const std::filesystem::path& file, const SweepRunOptions& options) {
  SweepIdentity identity = plan.identity();
  identity.shard = options.shard.index;
  identity.shards = options.shard.of;
  SweepDatabase database(file, identity);
  const std::int64_t first = options.shard.first(identity.points), end = options.shard.end(identity.points);
  SweepRunResult out;
  out.points = end - first;
  if (options.retry_errors) database.dropErrors();
  out.done = database.pointsDone();
  if (out.done < out.points)
    compute(plan, {database, first, end, handfulOf(plan, out.points, options.jobs)}, database, options, out);
  out.done += out.new_ones;
  if (!out.stopped) database.finish();
  Statement counts(database.sqlite(), "SELECT verdict, count(*) FROM point GROUP BY verdict");
  while (counts.step()) out.verdicts[counts.text(0)] = counts.integer(1);
  return out;
}

}  // namespace ursula

#include "studies/sweep/run.h"

#include <algorithm>
#include <chrono>
#include <memory>

#include "studies/sweep/work.h"
#include "studies/sweep/worker_pool.h"

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

/// Commits so rarely that it costs little, and so often that little can be lost.
class Writer {
 public:
  explicit Writer(SweepDatabase& database) : database_(database) {}

  void add(const SweepPoint& point) {
    database_.add(point);
    if (Clock::now() - last_ < between) return;
    database_.commit();
    last_ = Clock::now();
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds between{500};
  SweepDatabase& database_;
  Clock::time_point last_ = Clock::now();
};

std::map<std::string, std::int64_t> verdictsOf(Sqlite& database) {
  std::map<std::string, std::int64_t> out;
  Statement counts(database, "SELECT verdict, count(*) FROM point GROUP BY verdict");
  while (counts.step()) out[counts.text(0)] = counts.integer(1);
  return out;
}

/// Returns how many points to hand out at once, so that hand-outs are few and all workers end at about the same time.
std::int64_t handfulOf(const SweepPlan& plan, std::int64_t points, int jobs) {
  const std::int64_t most = plan.file().work == SweepWork::inverse ? 64 : 1;
  return std::clamp<std::int64_t>(points / (8 * jobs), 1, most);
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
  if (out.done < out.points) {
    Missing missing(database, first, end, handfulOf(plan, out.points, options.jobs));
    Writer writer(database);
    WorkerPool::Tasks tasks;
    tasks.next = [&] { return missing.next(); };
    tasks.makeWork = [&plan] {
      const auto worker = std::make_shared<SweepWorker>(plan);
      return [worker](std::int64_t i) { return worker->at(i); };
    };
    tasks.parameters = [&plan](std::int64_t i) { return plan.parameters(i); };
    tasks.done = [&](const SweepPoint& point) {
      writer.add(point);
      ++out.new_ones;
      if (options.progress) options.progress(out.done + out.new_ones, out.points);
    };
    tasks.stop = options.stop;
    out.stopped = !WorkerPool(options.jobs, tasks).run();
    database.commit();
  }
  out.done += out.new_ones;
  if (!out.stopped) database.finish();
  out.verdicts = verdictsOf(database.sqlite());
  return out;
}

}  // namespace ursula

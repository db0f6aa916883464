#include "studies/sweep/run.h"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>

#include "base/errors.h"
#include "nocsolver/errors.h"
#include "studies/sweep/motion_extremes.h"
#include "studies/sweep/worker_pool.h"
#include "validation/checks/judges.h"
#include "validation/validate.h"

namespace ursula {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

const char* verdictOf(const PoseError& refusal) {
  return dynamic_cast<const SingularJacobian*>(&refusal) != nullptr ||
                 dynamic_cast<const StretchedLeg*>(&refusal) != nullptr
             ? "singular"
             : "out_of_reach";
}

/// The name of the margin from margins(); "" for legs without one, which cannot be stretched.
std::string marginName(const Manipulator& manipulator) {
  const LegKind first = manipulator.leg(0).kind;
  for (int i = 1; i < manipulator.legCount(); ++i)
    if (manipulator.leg(i).kind != first) return "leg_margin";
  const char* knee = rowOf(first).knee;
  std::string name = knee == nullptr ? "" : knee;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

void refused(const char* verdict, int leg, double t, SweepPoint& point) {
  point.verdict = verdict;
  point.values.clear();
  if (leg >= 0) point.values.push_back({"refused_leg", leg + 1.0, none, ""});
  point.values.push_back({"refused_t_s", t, none, ""});
}

void failed(const char* why, SweepPoint& point) {
  point.verdict = "error";
  point.error = why;
  point.values.clear();
}

void addCheck(const Check& check, SweepPoint& point) {
  if (check.verdict == Verdict::not_applicable) return;
  const auto known = [](double x) { return std::isfinite(x) ? x : none; };
  point.values.push_back({check.name, known(check.value), known(check.limit), name(check.verdict)});
}

}  // namespace

SweepPoint SweepWorker::at(std::int64_t i) {
  SweepPoint point;
  point.id = i;
  point.parameters = plan_.parameters(i);
  const auto start = std::chrono::steady_clock::now();
  try {
    plan_.file().work == SweepWork::inverse ? inverse(i, point) : validate(i, point);
  } catch (const PoseError& refusal) {
    refused(verdictOf(refusal), refusal.leg(), refusal.instant(), point);
  } catch (const std::bad_alloc&) {
    failed(out_of_memory_for_scenario, point);
  } catch (const std::exception& error) {
    failed(error.what(), point);
  }
  point.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return point;
}

void SweepWorker::inverse(std::int64_t i, SweepPoint& point) {
  const Scenario scenario = plan_.make(i);
  const Extremes found = extremes_.of(scenario, plan_.variesMotion());
  const Motors& motors = scenario.manipulator->motors();
  for (int k = 0; k < motor_count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const char* unit = motors[at].effortUnit();
    point.values.push_back({fmt::format("tau_{}_{}", k + 1, unit), found.efforts[at].value, none, ""});
    point.values.push_back({fmt::format("tau_{}_t_s", k + 1), found.efforts[at].t, none, ""});
  }
  point.values.push_back({"kappa_B", found.kappa, none, ""});
  if (const std::string margin = marginName(*scenario.manipulator); !margin.empty())
    point.values.push_back({margin, found.sine, none, ""});
  point.verdict = "pass";
}

void SweepWorker::validate(std::int64_t i, SweepPoint& point) {
  const ValidationResult result = plan_.file().pointwise ? pointwise(i) : ursula::validate(plan_.read(i));
  for (const Check& check : result.checks) addCheck(check, point);
  point.verdict = name(result.verdict);
}

/// Judges the commanded motion only once if all points share it.
ValidationResult SweepWorker::pointwise(std::int64_t i) {
  if (plan_.variesMotion()) return validatePointwise(plan_.read(i));
  if (!of_motion_) of_motion_ = judgeCommandedMotion(plan_.base());
  return validatePointwise(plan_.make(i), &*of_motion_);
}

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

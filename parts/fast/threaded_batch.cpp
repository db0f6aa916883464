#include "parts/fast/threaded_batch.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <stdexcept>

namespace ursula {
namespace {

/// Some 50 µs of work, which exceeds the cost of another thread.
constexpr std::size_t least_share = 512;

/// Calls part(from, count) until all `count` poses are done.
template <class Part>
void byThreads(std::size_t count, int jobs, const Part& part) {
  if (count <= least_share || jobs == 1) return part(0, count);
  const auto all = [&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, least_share),
                      [&part](const auto& range) { part(range.begin(), range.size()); });
  };
  try {
    if (jobs <= 0) return all();
    const auto allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    tbb::task_arena arena(static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(jobs), allowed)));
    arena.execute(all);
  } catch (const std::runtime_error&) {
    part(0, count);  // the only TBB error: the system gives it no threads
  }
}

const Vector6d* from(const Vector6d* vectors, std::size_t first) {
  return vectors != nullptr ? vectors + first : nullptr;
}

}  // namespace

void inverseDynamics(const BatchDynamics& batch, const Motion<double>* motions, std::size_t count, Vector6d* efforts,
                     PoseFault* faults, const Vector6d* loads, int jobs) {
  byThreads(count, jobs, [=, &batch](std::size_t first, std::size_t some) {
    batch.inverseDynamics(motions + first, some, efforts + first, faults + first, from(loads, first));
  });
}

void directDynamics(const BatchDynamics& batch, const Motion<double>* motions, const Vector6d* efforts,
                    std::size_t count, Vector6d* twist_rates, PoseFault* faults, const Vector6d* loads, int jobs) {
  byThreads(count, jobs, [=, &batch](std::size_t first, std::size_t some) {
    batch.directDynamics(motions + first, efforts + first, some, twist_rates + first, faults + first,
                         from(loads, first));
  });
}

}  // namespace ursula

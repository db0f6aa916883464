#include "studies/engines/in_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>

namespace ursula {
namespace {

class MovedLoop {
 public:
  MovedLoop(const LoopEngine& engine, const Rigidity& rigidity, EngineReference& reference)
      : engine_(engine), reference_(reference), loop_(engine.stepped(rigidity)) {
    out_.rigidity = rigidity;
  }

  TimeSteppingResult move(int steps) {
    loop_->start(reference_.at(0).motion);
    loop_->read(is_);
    const double energy = is_.energy;
    while (out_.steps < steps && step()) {
    }
    out_.energy = is_.energy - energy - work_;
    if (out_.steps == 0) out_.sag = out_.away = out_.energy = std::numeric_limits<double>::quiet_NaN();
    out_.seconds = median(seconds_);
    return out_;
  }

 private:
  /// Throws if a loop is wide open, because later states say nothing and may make an engine end the process.
  void requireClosed(const SteppedLoop::State& state) {
    const double gap = largestGap(state.tree, engine_.manipulator());
    out_.gap = std::max(out_.gap, gap);
    if (!(gap < reference_.length() / 10)) throw std::runtime_error(fmt::format("a loop is open by {:.2g} m", gap));
  }

  /// Returns false if the engine gives up.
  bool step() {
    const double step = out_.rigidity.step;
    const Vector6d efforts = reference_.at((out_.steps + out_.rigidity.instant) * step).efforts;
    SteppedLoop::State next;
    try {
      const auto start = std::chrono::steady_clock::now();
      loop_->step(efforts);
      seconds_.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      loop_->read(next);
      requireClosed(next);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& words) {
      out_.gave_up = words.what();
      return false;
    }
    const double of_motors = efforts.dot(next.q - is_.q), of_others = step / 2 * (is_.power + next.power);
    work_ += of_motors + of_others;
    out_.work += std::abs(of_motors) + std::abs(of_others);
    out_.away = std::max(out_.away, (next.p - reference_.at(out_.steps * step + step).motion.p).norm());
    out_.sag = std::max(out_.sag, sag(next.tree, engine_.manipulator()));
    is_ = next;
    ++out_.steps;
    return true;
  }

  const LoopEngine& engine_;
  EngineReference& reference_;
  std::unique_ptr<SteppedLoop> loop_;
  TimeSteppingResult out_;
  SteppedLoop::State is_;
  double work_ = 0;
  std::vector<double> seconds_;
};

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

TimeSteppingResult moveInTime(const LoopEngine& engine, const Rigidity& rigidity, EngineReference& reference,
                              double moved) {
  const int steps = std::max(1, static_cast<int>(std::floor(moved / rigidity.step)));
  try {
    return MovedLoop(engine, rigidity, reference).move(steps);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& words) {  // the engine gave up before the first step
    TimeSteppingResult out;
    out.rigidity = rigidity;
    out.gave_up = words.what();
    out.gap = out.sag = out.away = out.energy = std::numeric_limits<double>::quiet_NaN();
    return out;
  }
}

}  // namespace ursula

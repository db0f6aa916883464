#include "studies/engines/in_time.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>

#include "base/angles.h"

namespace ursula {
namespace {

/// A fast servo in the place of the motors' drives: open-loop efforts alone would show how unstable the motion is, not
/// how soft the loops are. A tenth of 1/step at the longest step of an engine's rigidities.
constexpr double servo_rate = 50;  // 1/s

/// Critically damped, decoupled by the machine's inertia.
Vector6d servoEfforts(const EngineReference::Here& wanted, const SteppedLoop::State& is, const Motors& motors) {
  Vector6d off = wanted.q - is.q;
  for (int m = 0; m < motor_count; ++m)
    if (!motors[static_cast<std::size_t>(m)].slides()) off(m) = std::remainder(off(m), 2 * pi);
  return wanted.inertia * (servo_rate * servo_rate * off + 2 * servo_rate * (wanted.q_dot - is.q_dot));
}

class MovedLoop {
 public:
  MovedLoop(const LoopEngine& engine, const Rigidity& rigidity, EngineReference& reference)
      : engine_(engine), reference_(reference), loop_(engine.stepped(rigidity)) {
    out_.rigidity = rigidity;
  }

  InTimeFound move(int steps, double largest_effort) {
    loop_->start(reference_.at(0).motion);
    loop_->read(is_);
    const double energy = is_.energy;
    while (out_.steps < steps && step()) {
    }
    out_.effort /= largest_effort;
    out_.energy = is_.energy - energy - work_;
    out_.seconds = median(seconds_);
    return out_;
  }

 private:
  /// False where the engine gives up.
  bool step() {
    const double step = out_.rigidity.step;
    const EngineReference::Here wanted = reference_.at(out_.steps * step);
    const Vector6d added = servoEfforts(wanted, is_, engine_.manipulator().motors()), efforts = wanted.efforts + added;
    SteppedLoop::State next;
    try {
      const auto start = std::chrono::steady_clock::now();
      loop_->step(efforts);
      seconds_.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      loop_->read(next);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& words) {
      out_.gave_up = words.what();
      return false;
    }
    const double of_motors = efforts.dot(next.q - is_.q), of_others = step / 2 * (is_.power + next.power);
    work_ += of_motors + of_others;
    out_.work += std::abs(of_motors) + std::abs(of_others);
    out_.effort = std::max(out_.effort, added.cwiseAbs().maxCoeff());
    out_.gap = std::max(out_.gap, largestGap(next.tree, engine_.manipulator()));
    out_.sag = std::max(out_.sag, sag(next.tree, engine_.manipulator()));
    is_ = next;
    ++out_.steps;
    return true;
  }

  const LoopEngine& engine_;
  EngineReference& reference_;
  std::unique_ptr<SteppedLoop> loop_;
  InTimeFound out_;
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

InTimeFound moveInTime(const LoopEngine& engine, const Rigidity& rigidity, EngineReference& reference, double window,
                       double largest_effort) {
  const int steps = std::max(1, static_cast<int>(std::floor(window / rigidity.step)));
  return MovedLoop(engine, rigidity, reference).move(steps, largest_effort);
}

}  // namespace ursula

// An engine moves a machine under the NOC's efforts.

#include "parts/engines/side_by_side/in_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>

namespace ursula {
namespace {

class MovedLoop {
 public:
  MovedLoop(const Moving& moving, const Rigidity& rigidity) : moving_(moving) { out_.rigidity = rigidity; }

  TimeSteppingResult move(int steps) {
    is_ = moving_.start();
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
  void requireClosed(double gap) {
    out_.gap = larger(out_.gap, gap);
    if (!(gap < moving_.length / 10)) throw std::runtime_error(fmt::format("a loop is open by {:.2g} m", gap));
  }

  /// Returns false if the engine gives up.
  bool step() {
    const double step = out_.rigidity.step;
    const Eigen::VectorXd efforts = moving_.efforts((out_.steps + out_.rigidity.instant) * step);
    Moving::State next;
    try {
      const auto start = std::chrono::steady_clock::now();
      moving_.step(efforts);
      seconds_.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      next = moving_.read();
      requireClosed(next.gap);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& words) {
      out_.gave_up = words.what();
      return false;
    }
    const double of_motors = efforts.dot(next.q - is_.q), of_others = step / 2 * (is_.power + next.power);
    work_ += of_motors + of_others;
    out_.work += std::abs(of_motors) + std::abs(of_others);
    out_.away = larger(out_.away, (next.p - moving_.position(out_.steps * step + step)).norm());
    out_.sag = larger(out_.sag, next.sag);
    is_ = next;
    ++out_.steps;
    return true;
  }

  const Moving& moving_;
  TimeSteppingResult out_;
  Moving::State is_;
  double work_ = 0;
  std::vector<double> seconds_;
};

/// Where the loops hold the output body's mass centre, by this program.
class OutputOfLoops {
 public:
  explicit OutputOfLoops(const MechanismAlong& along) : along_(along) {}

  Vector3d along(double t) {
    along_.motion().inverseDynamics(t, work_);
    return place();
  }
  Eigen::VectorXd efforts(double t) { return along_.motion().inverseDynamics(t, work_); }
  Vector3d at(const Eigen::VectorXd& q) {
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(q.size());
    loops::LoopPose pose = work_.pose;
    along_.solver().moveTo(q, pose);
    along_.solver().kinematics({0, q, none, none}, pose, work_);
    return place();
  }

 private:
  Vector3d place() const {
    const Mechanism& mechanism = along_.solver().mechanism();
    return work_.bodies[mechanism.output()].displacement * mechanism.bodies()[mechanism.output()].center_of_mass;
  }

  const MechanismAlong& along_;
  LoopWork work_;
};

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

TimeSteppingResult moveInTime(const Rigidity& rigidity, double moved, const std::function<Moving()>& make) {
  const int steps = std::max(1, static_cast<int>(std::floor(moved / rigidity.step)));
  try {
    const Moving moving = make();
    return MovedLoop(moving, rigidity).move(steps);
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

Moving movingManipulator(const LoopEngine& engine, const Rigidity& rigidity, EngineReference& reference) {
  const std::shared_ptr<SteppedLoop> loop = engine.stepped(rigidity);
  const auto read = [loop, &engine] {
    SteppedLoop::State is;
    loop->read(is);
    Moving::State out;
    out.q = is.q;
    out.p = is.p;
    out.gap = largestGap(is.tree, engine.manipulator());
    out.energy = is.energy;
    out.power = is.power;
    out.sag = sag(is.tree, engine.manipulator());
    return out;
  };
  return {[=, &reference] { return loop->start(reference.at(0).motion), read(); },
          [loop](const Eigen::VectorXd& efforts) { loop->step(Vector6d(efforts)); },
          read,
          [&reference](double t) { return Eigen::VectorXd(reference.at(t).efforts); },
          [&reference](double t) { return reference.at(t).motion.p; },
          reference.length()};
}

Moving movingMechanism(MechanismCalls& engine, const Rigidity& rigidity, const MechanismAlong& along) {
  const auto output = std::make_shared<OutputOfLoops>(along);
  const auto stateOf = [output](const MechanismCalls::Moved& is) {
    Moving::State out;
    static_cast<MechanismCalls::Moved&>(out) = is;
    out.sag = (is.p - output->at(is.q)).norm();
    return out;
  };
  const double last = along.motion().trajectory().duration();
  return {[=, &engine, &along] {
            output->efforts(0);
            return stateOf(engine.start(rigidity, along.motion().trajectory().at(0)));
          },
          [&engine](const Eigen::VectorXd& efforts) { engine.step(efforts); },
          [=, &engine] { return stateOf(engine.moved()); },
          [=](double t) { return output->efforts(std::min(t, last)); },
          [=](double t) { return output->along(std::min(t, last)); },
          along.solver().mechanism().length()};
}

}  // namespace ursula

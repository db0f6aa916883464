#include <fmt/format.h>

#include <algorithm>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "simbody/simbody_mechanism.h"
#include "validation/mechanism/mechanism_evidence.h"

namespace ursula {
namespace {

using State = std::vector<double>;
constexpr int window_count = 12;
/// Where the output body is at a window's end.
struct End {
  Eigen::Isometry3d output = Eigen::Isometry3d::Identity();
  SimbodyMechanism::Closure closure;
};

/// Runs windows of Simbody's motion under efforts.
class Replayer {
 public:
  Replayer(const MechanismScenario& scenario, std::function<MotorEfforts(double)> efforts, const Deadline& deadline)
      : simbody_(*scenario.mechanism),
        output_(scenario.mechanism->output()),
        efforts_(std::move(efforts)),
        deadline_(deadline) {}

  /// Integrates from the commanded state at `start` in equal steps of Fehlberg's order 8, with `more` added to efforts.
  /// Returns nullopt if the motion grows beyond all numbers.
  std::optional<End> run(const MotorMotion& start, double end, int steps, const MotorEfforts& more) {
    simbody_.place(start);
    const State placed = simbody_.state();
    State y = placed;
    constexpr double huge = 1e30;  // its squares are still numbers
    boost::numeric::odeint::runge_kutta_fehlberg78<State> stepper;
    const double h = (end - start.t) / steps;
    const auto system = [&](const State& at, State& rate, double t) {
      simbody_.derivative(t, at.data(), effortsAt(t) + more, rate.data());
    };
    for (int k = 0; k < steps; ++k) {
      deadline_.require();
      stepper.do_step(system, y, start.t + k * h, h);
      if (std::all_of(y.begin(), y.end(), [](double each) { return std::abs(each) < huge; })) continue;
      simbody_.setState(start.t, placed.data());  // the next window continues from there
      return std::nullopt;
    }
    simbody_.setState(end, y.data());
    return End{simbody_.bodies()[output_].displacement, simbody_.closure()};
  }

 private:
  /// Stages and runs share instants.
  const MotorEfforts& effortsAt(double t) {
    const auto [at, is_new] = known_.try_emplace(t);
    if (is_new) at->second = efforts_(t);
    return at->second;
  }

  SimbodyMechanism simbody_;
  std::size_t output_;
  std::function<MotorEfforts(double)> efforts_;
  std::map<double, MotorEfforts> known_;
  Deadline deadline_;
};

/// The sample nearest to an instant, for its limits.
const MechanismSample& sampleAt(const MechanismEvidence& evidence, double t) {
  const MechanismSample* best = &evidence.samples.front();
  for (const MechanismSample& each : evidence.samples)
    if (std::abs(each.motion.t - t) < std::abs(best->motion.t - t)) best = &each;
  return *best;
}

/// The least time constant of friction and damping along the motion, s: an explicit step must not be much longer.
double shortestTime(const MechanismEvidence& evidence) {
  const Mechanism& mechanism = *evidence.scenario->mechanism;
  double out = std::numeric_limits<double>::infinity();
  double rub = 0;
  for (const MechanismJoint& joint : mechanism.joints()) {
    const double own = joint.damping + joint.friction / joint.smoothing();
    rub = std::max(rub, joint.slides() ? own * mechanism.length() * mechanism.length() : own);
  }
  for (const MechanismSample& sample : evidence.samples) {
    const double mobility = sample.inverse_inertia.cwiseAbs().maxCoeff();
    if (rub * mobility > 0) out = std::min(out, 1 / (rub * mobility));
  }
  return out;
}

/// Runs windows of so many steps. Returns false if a motion grows beyond all numbers.
bool replayWindows(Replayer& replayer, int steps, MechanismEvidence& evidence) {
  constexpr double allowance = 10;
  // As much work whatever the step: fewer windows if they need more steps.
  constexpr int work_of_all = 12 * 16;
  const int windows = std::clamp(work_of_all / steps, 2, window_count);
  const Mechanism& mechanism = *evidence.scenario->mechanism;
  const double duration = evidence.scenario->trajectory->duration(), length = mechanism.length();
  const Vector3d center = mechanism.bodies()[mechanism.output()].center_of_mass;
  const LoopFreedoms freedoms = evidence.motion->solver().freedoms(evidence.motion->solver().assembled());
  const auto turn = [&](const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
    return turnBetween(a, b, freedoms.idleBody(mechanism.output()));
  };
  LoopWork work;
  for (int w = 0; w < windows; ++w) {
    MechanismWindow window;
    window.start = duration * w / windows;
    window.end = window.start + duration / window_count;
    const MotorMotion start = evidence.motion->trajectory().at(window.start);
    const MechanismSample& sample = sampleAt(evidence, window.end);
    MotorEfforts noise(mechanism.motorCount());
    for (Eigen::Index k = 0; k < noise.size(); ++k)
      noise(k) =
          ((k % 2 == 0) ? 1 : -1) * evidence.limit(sample, k, evidence.acceleration_level) / evidence.efforts_in(k);
    const MotorEfforts none = MotorEfforts::Zero(noise.size());
    // Where half the step changes more than the efforts' rounding does, order_gain has it.
    const std::optional<End> runs[] = {replayer.run(start, window.end, steps, none),
                                       replayer.run(start, window.end, 2 * steps, none),
                                       replayer.run(start, window.end, steps, noise)};
    if (!runs[0] || !runs[1] || !runs[2]) return false;
    const End &coarse = *runs[0], &fine = *runs[1], &noisy = *runs[2];
    static_cast<void>(evidence.motion->inverseDynamics(window.end, work));
    const Eigen::Isometry3d wanted = work.bodies[mechanism.output()].displacement;
    const auto apart = [&](const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
      return (a * center - b * center).norm();
    };
    window.position = apart(fine.output, wanted);
    window.orientation = turn(fine.output, wanted);
    window.order_gain = apart(fine.output, coarse.output);
    const double floor = evidence.level * rounding * sample.condition * sample.condition;
    window.position_limit = allowance * (window.order_gain + apart(noisy.output, coarse.output) + floor * length);
    window.orientation_limit =
        allowance * (turn(fine.output, coarse.output) + turn(noisy.output, coarse.output) + floor);
    window.closure_position = fine.closure.position;
    window.closure_velocity = fine.closure.velocity;
    const double own_steps = (std::abs(fine.closure.position - coarse.closure.position));
    window.closure_position_limit = allowance * (own_steps + floor * length) + window.position_limit;
    window.closure_velocity_limit =
        window.closure_position_limit * steps / (window.end - window.start) +
        allowance * (std::abs(fine.closure.velocity - coarse.closure.velocity) + floor * sample.twist_size);
    evidence.windows.push_back(window);
  }
  return true;
}

}  // namespace

void replayMechanism(const std::function<MotorEfforts(double t)>& efforts, const Deadline& deadline,
                     MechanismEvidence& evidence) {
  constexpr int most_steps = 64;
  const MechanismScenario& scenario = *evidence.scenario;
  const double window = scenario.trajectory->duration() / window_count, step_bound = shortestTime(evidence);
  int steps = 8;
  while (window / steps > 0.5 * step_bound && steps < 4096) steps *= 2;
  if (steps > most_steps) {
    evidence.not_replayed =
        "friction changes within a time that no explicit step follows; accelerations are compared instead";
    return;
  }
  Replayer replayer(scenario, efforts, deadline);
  for (; steps <= most_steps; steps *= 2) {
    if (replayWindows(replayer, steps, evidence)) return;
    evidence.windows.clear();
  }
  evidence.replay_diverged = fmt::format(
      "Simbody's motion under the efforts grows beyond all numbers within a window of {:.3g} s, even in {} steps",
      window, most_steps);
}

}  // namespace ursula

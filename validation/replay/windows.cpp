#include "validation/replay/windows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/instants.h"
#include "validation/limits/moved_inputs.h"
#include "validation/replay/radau.h"
#include "validation/subject/subject.h"

namespace ursula {

template <class Sample>
double SampledLimit<Sample>::operator()(double t) const {
  const auto after = std::lower_bound(samples_.begin(), samples_.end(), t,
                                      [](const Sample& sample, double at) { return sample.motion.t < at; });
  const auto last = static_cast<std::ptrdiff_t>(samples_.size()) - 1;
  const std::size_t i = std::min(after - samples_.begin(), last);
  return std::max(samples_[i].conditioning.accelerationRounding(),
                  samples_[i == 0 ? 0 : i - 1].conditioning.accelerationRounding());
}

template class SampledLimit<Conditions>;
template class SampledLimit<PointwiseSample>;

namespace {

/// The largest change of ẋ, in natural units, when each state changes by one rounding.
double derivativeNoise(SimbodyLoop& loop, const Motion<double>& motion, const Vector6d& torques) {
  loop.place(motion);
  const std::vector<double> x = loop.state();
  std::vector<double> base(x.size()), changed(x.size());
  loop.derivative(motion.t, x.data(), torques, base.data());
  double noise = 0;
  for (unsigned pattern = 0; pattern < 4; ++pattern) {
    std::vector<double> near = x;
    for (std::size_t k = 0; k < near.size(); ++k)
      near[k] *= 1 + ((k >> pattern) % 2 == 0 ? 1 : -1) * Eigen::NumTraits<double>::epsilon();
    loop.derivative(motion.t, near.data(), torques, changed.data());
    for (std::size_t k = 0; k < near.size(); ++k) noise = std::max(noise, std::abs(changed[k] - base[k]));
  }
  return noise;
}

}  // namespace

double reachableTolerance(const Scenario& scenario, double step_rate, bool stiff) {
  SimbodyLoop loop(*scenario.manipulator, SimbodyLoop::Topology::ball_per_leg, scenario.load);
  const Subject right = nocSubject(*scenario.manipulator, scenario.load);  // not the subject's torques
  constexpr int instants = 5;
  double noise = 0;
  for (int k = 0; k < instants; ++k) {
    const Motion<double> motion = scenario.trajectory->at(scenario.trajectory->duration() * (k + 0.5) / instants);
    noise = std::max(noise, derivativeNoise(loop, motion, right.torques(motion)));
  }
  constexpr double in_error_of_pair = 0.1;  // √4 · 41/840: four stages of Fehlberg's estimate round independently
  const double in_error = stiff ? RadauStep::noiseInError() : in_error_of_pair;
  return std::max(scenario.simulation.tolerance, in_error * noise / step_rate);
}

double plannedStepRate(double duration) { return 128 / std::min(duration, 8.0); }

/// Fehlberg's pair is stable up to about five decays per step; from eight in a planned step, stability alone sets its
/// steps.
bool isStiff(const Amplification& amplification, double duration) {
  return amplification.decayRate() > 8 * plannedStepRate(duration);
}

long enoughEvaluations(const Scenario& scenario, double step_rate) {
  const auto knots = static_cast<long>(allKnots(scenario).size());
  constexpr double most = 1e12;  // a time limit deals with longer work
  return 20000 + static_cast<long>(std::min(most, 4 * 13 * step_rate * scenario.trajectory->duration())) +
         4 * 13 * knots;
}

template <class Sample>
double positionScale(const std::vector<Sample>& samples) {
  double scale = 0;
  for (const Sample& sample : samples) scale = std::max(scale, sample.conditioning.position_scale);
  return scale;
}

/// ∫ n(s) ds and ∫ (end − s) n(s) ds, with the larger n of the two samples beside s.
template <class Sample>
void measureOpening(const std::vector<Sample>& samples, std::vector<WindowedReplay>& windows) {
  for (WindowedReplay& window : windows) {
    const double start = window.window.start(), end = window.window.end();
    window.opening = {};
    for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
      const double from = std::max(start, samples[k].motion.t), to = std::min(end, samples[k + 1].motion.t);
      if (!(to > from)) continue;
      const double noise = std::max(samples[k].conditioning.rounding(Rounded::gaps),
                                    samples[k + 1].conditioning.rounding(Rounded::gaps));
      window.opening.velocity += noise * (to - from);
      window.opening.position += noise * (to - from) * (end - (from + to) / 2);
    }
  }
}

template <class Sample>
LoopForces loopForces(const std::vector<Sample>& samples) {
  LoopForces forces;
  for (const Sample& sample : samples) forces.include(sample.conditioning);
  return forces;
}

template double positionScale(const std::vector<Conditions>&);
template double positionScale(const std::vector<PointwiseSample>&);
template void measureOpening(const std::vector<Conditions>&, std::vector<WindowedReplay>&);
template void measureOpening(const std::vector<PointwiseSample>&, std::vector<WindowedReplay>&);
template LoopForces loopForces(const std::vector<Conditions>&);
template LoopForces loopForces(const std::vector<PointwiseSample>&);

int linearisedIntervals(double duration) {
  constexpr double least = 300, many = 60'000, most = 300'000;    // an interval takes a kilobyte
  const double coarse = std::max(many, std::ceil(4 * duration));  // of a motion this long, if it is no slow one
  return static_cast<int>(std::clamp(std::min(std::ceil(40 * duration), coarse), least, most));
}

Amplification linearised(const Scenario& scenario, const Deadline& deadline) {
  return Amplification(scenario, linearisedIntervals(scenario.trajectory->duration()), deadline);
}

namespace {

/// The expected error of the steps, m/s.
double plannedErrorRate(const ReplayPlan& plan) {
  return plan.step_rate * errorPerStep(plan.tolerance, plan.position_scale);
}

}  // namespace

std::vector<GrowthWindow> planWindows(const Amplification& amplification, const ReplayPlan& plan) {
  const double rate = plannedErrorRate(plan);
  // Plans for a quarter of the useful limit, because the actual number of steps may exceed the planned one.
  double planned = useful_replay_limit / 4 * amplification.length();
  // Without a limit of the accelerations no window is useful, so one is enough.
  if (std::any_of(amplification.instants().begin(), amplification.instants().end(),
                  [&plan](double t) { return std::isinf(plan.acceleration(t)); }))
    planned = std::numeric_limits<double>::infinity();
  std::vector<GrowthWindow> windows;
  for (std::size_t first = 0; first + 1 < amplification.instants().size(); first = windows.back().last)
    windows.push_back(amplification.window(first, plan.acceleration, rate, planned, plan.deadline));
  return windows;
}

double plannedBound(const ReplayPlan& plan, const GrowthWindow& window) {
  return window.bound(window.end(), plannedErrorRate(plan), 0);
}

ReplaySettings settingsOf(const Scenario& scenario, const ReplayPlan& plan, const GrowthWindow& window,
                          double tolerance_factor) {
  ReplaySettings settings;
  settings.integrator = scenario.simulation.integrator;
  settings.tolerance = tolerance_factor * plan.tolerance;
  settings.stiff = plan.stiff;
  settings.start = window.start();
  settings.end = window.end();
  settings.max_evaluations = plan.max_evaluations;
  settings.deadline = plan.deadline;
  settings.foresee = plan.foresee;
  return settings;
}

std::vector<WindowedReplay> replayInWindows(const Scenario& scenario, const ReplayPlan& plan,
                                            const std::vector<GrowthWindow>& windows) {
  std::vector<WindowedReplay> replays;
  for (const GrowthWindow& window : windows)
    replays.push_back({window, replay(scenario, plan.torques, settingsOf(scenario, plan, window, 1))});
  return replays;
}

namespace {

constexpr unsigned moves_of_replay = 3;

/// Replays with halved steps. The difference from `here` is the steps' error, if none was rejected.
Replay replayedByHalves(const Scenario& scenario, const ReplayPlan& plan, const GrowthWindow& window,
                        const Replay& here) {
  ReplaySettings settings = settingsOf(scenario, plan, window, 1);
  for (std::size_t k = 0; k + 1 < here.steps.size(); ++k) {
    settings.stops.push_back((here.steps[k].t + here.steps[k + 1].t) / 2);
    settings.stops.push_back(here.steps[k + 1].t);
  }
  const auto steps = static_cast<double>(std::max(here.accepted, 1L));
  settings.longest_step = (window.end() - window.start()) / (2 * steps);
  settings.max_evaluations *= 4;
  return replay(scenario, plan.torques, settings);
}

/// Two replays differ by the error of the coarser one only if it takes fewer steps, by this factor at least.
constexpr double fewer_steps = 1.1;

bool hasLongerSteps(const Replay& coarse, const Replay& fine) {
  return fewer_steps * static_cast<double>(coarse.accepted) <= static_cast<double>(fine.accepted);
}

}  // namespace

void measureIntegration(const Scenario& scenario, const ReplayPlan& plan, std::vector<WindowedReplay>& windows) {
  for (WindowedReplay& window : windows) {
    window.coarse = std::make_shared<const Replay>(
        replay(scenario, plan.torques, settingsOf(scenario, plan, window.window, coarser)));
    const bool tells = hasLongerSteps(*window.coarse, window.replay) || !window.replay.gave_up.empty();
    window.integration = integrationError(
        window.replay, tells ? *window.coarse : replayedByHalves(scenario, plan, window.window, window.replay));
  }
}

IntegrationError closerLook(const Scenario& scenario, const ReplayPlan& plan, const GrowthWindow& window,
                            const Replay& here) {
  IntegrationError out = integrationError(here, replayedByHalves(scenario, plan, window, here));
  for (unsigned seed = 1; seed <= moves_of_replay; ++seed) {
    const IntegrationError error =
        integrationError(here, replay(moved(scenario, seed), plan.torques, settingsOf(scenario, plan, window, 1)));
    out.steps.resize(std::min(out.steps.size(), error.steps.size()));
    for (std::size_t k = 0; k < out.steps.size(); ++k)
      for (double IntegrationError::At::*part :
           {&IntegrationError::At::position, &IntegrationError::At::rotation, &IntegrationError::At::gap,
            &IntegrationError::At::gap_rate, &IntegrationError::At::energy})
        out.steps[k].*part = larger(out.steps[k].*part, error.steps[k].*part);
  }
  return out;
}

namespace {

/// The largest step rate of undecided windows that can be shortened, 1/s; 0 without one.
double stepRateOfUndecided(const std::vector<WindowedReplay>& replays, const ReplayPlan& plan, double length) {
  double rate = 0;
  for (const WindowedReplay& each : replays) {
    const GrowthWindow& window = each.window;
    const auto steps = static_cast<double>(each.replay.steps.size());
    const double limit = driftLimit(window, plan.tolerance, steps, plan.position_scale, window.end());
    if (window.t.size() > 2 && each.replay.gave_up.empty() && !(limit <= useful_replay_limit * length))
      rate = std::max(rate, steps / (window.end() - window.start()));
  }
  return rate;
}

}  // namespace

std::vector<WindowedReplay> replayInWindows(const Scenario& scenario, const Amplification& amplification,
                                            const ReplayPlan& plan) {
  std::vector<WindowedReplay> replays = replayInWindows(scenario, plan, planWindows(amplification, plan));
  const double taken = stepRateOfUndecided(replays, plan, amplification.length());
  if (!(taken > plan.step_rate)) return replays;
  ReplayPlan shorter = plan;
  shorter.step_rate = taken;
  return replayInWindows(scenario, shorter, planWindows(amplification, shorter));
}

}  // namespace ursula

#pragma once

#include <functional>
#include <vector>

#include "engines/simbody/simbody_loop.h"
#include "model/scenario.h"
#include "validation/replay/windowed_replay.h"
#include "validation/samples/pointwise.h"

namespace ursula {

/// What is replayed, and the errors that it may carry: they decide how long a window may be.
struct ReplayPlan {
  SimbodyLoop::TorqueHistory torques;
  std::function<double(double)> acceleration;  ///< error that the platform's acceleration may have at t, m/s²
  double position_scale = 0;                   ///< as errorPerStep has it, m
  double step_rate = 0;                        ///< steps a second that the replay is taken to need, for planning only
  long max_evaluations = 200000;               ///< of the derivatives in one window; more is giving up
  double tolerance = 1e-14;                    ///< of the integrator: reachableTolerance
  bool stiff = false;                          ///< as ReplaySettings has it
  std::function<void(const std::vector<double>&)> foresee = nullptr;  ///< as ReplaySettings has it; may be empty
};

/// 300, and 40 a second where that is more, up to 300,000.
int linearisedIntervals(double duration);
/// The growth of deviations along the scenario's motion, in so many intervals.
Amplification linearised(const Scenario& scenario);

/// The whole motion in windows that restart on the commanded state, each as long as its limit stays useful; where none
/// is short enough for that, one of the shortest.
std::vector<GrowthWindow> planWindows(const Amplification& amplification, const ReplayPlan& plan);

/// The bound that planWindows held against the useful limit, at the end of `window`, m.
double plannedBound(const ReplayPlan& plan, const GrowthWindow& window);

/// Of a replay of `window` at so many times the plan's tolerance.
ReplaySettings settingsOf(const Scenario& scenario, const ReplayPlan& plan, const GrowthWindow& window,
                          double of_tolerance);

/// A replay for each window.
std::vector<WindowedReplay> replayInWindows(const Scenario& scenario, const ReplayPlan& plan,
                                            const std::vector<GrowthWindow>& windows);

/// Sets what the integration may be off by in each of `windows`, replays under the right torques, by replaying once
/// more with `coarser` times the tolerance.
void measureIntegration(const Scenario& scenario, const ReplayPlan& plan, std::vector<WindowedReplay>& windows);
constexpr double coarser = 100;

/// What steps and rounding make of a replay of `window` under the plan's torques: the same with every step halved, and
/// in turned and shifted frames with other labels, against `here`.
IntegrationError closerLook(const Scenario& scenario, const ReplayPlan& plan, const GrowthWindow& window,
                            const Replay& here);

/// Plans windows and replays in them; once more with shorter windows where more steps were taken than planned and left
/// one that cannot be judged.
std::vector<WindowedReplay> replayInWindows(const Scenario& scenario, const Amplification& amplification,
                                            const ReplayPlan& plan);
std::vector<WindowedReplay> replayInWindows(const Scenario& scenario, const ReplayPlan& plan);

/// The scenario's tolerance, or where the loop's derivatives are too noisy for that, what they allow: a step's error
/// estimate by Fehlberg's pair adds their rounding with 41/840 at four stages, so that a step of the planned length is
/// never accepted below a tenth of it; RadauStep's, for a `stiff` replay, sees more of it (noiseInError). Where bodies
/// of very different mass hold each other this is far above eps.
double reachableTolerance(const Scenario& scenario, double step_rate, bool stiff = false);

/// For smooth torques: the judgement counts the steps taken.
double plannedStepRate(double duration);

/// Friction would make an explicit integrator's steps so much shorter than planned that implicit ones cost less.
bool isStiff(const Amplification& amplification, double duration);

/// Where to give up: torques that are wrong may throw the machine about, but four times what right ones take, 13
/// evaluations a step, is enough.
long enoughEvaluations(const Scenario& scenario, double step_rate);

/// Rounding of the platform's acceleration along the motion: the larger of the two samples beside t, m/s². Keeps a
/// reference to `samples`: Conditions or PointwiseSample, as below.
template <class Sample>
class SampledLimit {
 public:
  explicit SampledLimit(const std::vector<Sample>& samples) : samples_(samples) {}
  double operator()(double t) const;

 private:
  const std::vector<Sample>& samples_;
};

/// Of each window, from the conditioning of its samples.
template <class Sample>
void measureOpening(const std::vector<Sample>& samples, std::vector<WindowedReplay>& windows);

/// Over the samples.
template <class Sample>
LoopForces loopForces(const std::vector<Sample>& samples);

/// The largest coordinate over the samples, m.
template <class Sample>
double positionScale(const std::vector<Sample>& samples);

}  // namespace ursula

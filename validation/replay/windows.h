#pragma once

#include <functional>
#include <vector>

#include "model/scenario.h"
#include "simbody/simbody_loop.h"
#include "validation/replay/windowed_replay.h"
#include "validation/samples/pointwise.h"

namespace ursula {

/// The torques to replay, and their possible errors, which determine the length of the windows.
struct ReplayPlan {
  SimbodyLoop::TorqueHistory torques;
  std::function<double(double)> acceleration;  ///< possible error of the platform's acceleration at t, m/s²
  double position_scale = 0;                   ///< as in errorPerStep, m
  double step_rate = 0;                        ///< expected steps per second of the replay, for planning only
  long max_evaluations = 200000;               ///< limit of derivative evaluations in one window
  double tolerance = 1e-14;                    ///< of the integrator: reachableTolerance
  bool stiff = false;                          ///< as in ReplaySettings
  Deadline deadline = {};                      ///< as in ReplaySettings
  std::function<void(const std::vector<double>&)> foresee = nullptr;  ///< as in ReplaySettings; may be empty
};

/// Returns 300 intervals, or 40 per unit of time if that is more. Above 60,000 there are fewer, at least 4 per unit of
/// time up to 300,000, because so long a motion takes long otherwise.
int linearisedIntervals(double duration);
/// The growth of deviations along the scenario's motion, in linearisedIntervals().
Amplification linearised(const Scenario& scenario, const Deadline& deadline = {});

/// Divides the motion into windows that restart on the commanded state, each as long as its limit stays useful. If even
/// the shortest exceeds it, the shortest is used.
std::vector<GrowthWindow> planWindows(const Amplification& amplification, const ReplayPlan& plan);

/// The bound at the end of `window`, m, that planWindows compared with the useful limit.
double plannedBound(const ReplayPlan& plan, const GrowthWindow& window);

/// The settings for a replay of `window` at `tolerance_factor` times the plan's tolerance.
ReplaySettings settingsOf(const Scenario& scenario, const ReplayPlan& plan, const GrowthWindow& window,
                          double tolerance_factor);

/// Returns one replay per window.
std::vector<WindowedReplay> replayInWindows(const Scenario& scenario, const ReplayPlan& plan,
                                            const std::vector<GrowthWindow>& windows);

/// Sets the integration error of each of `windows`, replays under the right torques, by another replay with `coarser`
/// times the tolerance. If that hardly has longer steps, as in a window of one step, it says nothing about their error.
/// A replay with halved steps then takes its place.
void measureIntegration(const Scenario& scenario, const ReplayPlan& plan, std::vector<WindowedReplay>& windows);
constexpr double coarser = 100;

/// The effect of steps and rounding on a replay of `window` under the plan's torques: the largest change of `here` at
/// halved steps and with every number of the machine changed by one rounding, three times.
IntegrationError closerLook(const Scenario& scenario, const ReplayPlan& plan, const GrowthWindow& window,
                            const Replay& here);

/// Plans windows and replays in them. It repeats this with shorter windows if more steps than planned left one
/// undecidable.
std::vector<WindowedReplay> replayInWindows(const Scenario& scenario, const Amplification& amplification,
                                            const ReplayPlan& plan);

/// The scenario's tolerance, or a larger one if the loop's derivatives are too noisy. Four stages round in Fehlberg's
/// error estimate, each with 41/840: together a tenth of the noise. RadauStep's estimate, for a `stiff` replay, is more
/// sensitive (noiseInError). If bodies of very different mass are connected, this is far above eps.
double reachableTolerance(const Scenario& scenario, double step_rate, bool stiff = false);

/// Returns the expected steps per second under smooth torques; the verdict uses the actual number.
double plannedStepRate(double duration);

/// Whether friction shortens an explicit integrator's steps so much that implicit steps cost less.
bool isStiff(const Amplification& amplification, double duration);

/// The limit of evaluations: four times what right torques need, at 13 a step. Wrong torques may destabilise the
/// machine.
long enoughEvaluations(const Scenario& scenario, double step_rate);

/// Rounding of the platform's acceleration along the motion, m/s²: the larger of the two samples beside t. Keeps a
/// reference to `samples`: Conditions or PointwiseSample, as below.
template <class Sample>
class SampledLimit {
 public:
  explicit SampledLimit(const std::vector<Sample>& samples) : samples_(samples) {}
  double operator()(double t) const;

 private:
  const std::vector<Sample>& samples_;
};

/// Sets each window's opening: the gap that rounding of the accelerations may cause by its end.
template <class Sample>
void measureOpening(const std::vector<Sample>& samples, std::vector<WindowedReplay>& windows);

/// The largest forces over the samples.
template <class Sample>
LoopForces loopForces(const std::vector<Sample>& samples);

/// The largest coordinate over the samples, m.
template <class Sample>
double positionScale(const std::vector<Sample>& samples);

}  // namespace ursula

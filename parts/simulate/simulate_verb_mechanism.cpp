#include <fmt/format.h>

#include "apps/mechanism.h"
#include "apps/output.h"
#include "apps/verbs.h"
#include "base/csv.h"
#include "model/instants.h"
#include "parts/simulate/simulate_mechanism.h"
#include "parts/simulate/simulate_verbs.h"

namespace ursula {
namespace {

/// Returns why the motion is incomplete; empty if it is complete.
std::string whatIsMissing(const MechanismSimulation& run, const std::vector<double>& instants, double duration,
                          const std::string& file) {
  if (!run.gave_up.empty())
    return fmt::format("stopped at t = {} s of {} s: {}", run.instants.empty() ? 0 : run.instants.back().motion.t,
                       instants.back(), run.gave_up);
  const double slack = 1e-9 * duration;
  if (instants.front() <= slack && instants.back() >= duration - slack) return "";
  return fmt::format(
      "{}: the efforts reach from t = {} s to {} s of a motion from 0 to {} s; the rest is not simulated", file,
      instants.front(), instants.back(), duration);
}

}  // namespace

int simulateMechanismVerb(const MechanismScenario& scenario, const SimulateOptions& options) {
  return alongLoops(scenario, [&] {
    const Mechanism& mechanism = *scenario.mechanism;
    const double duration = scenario.trajectory->duration();
    const Deadline deadline(options.time_limit);
    const MechanismAlong along(scenario);
    LoopWork work;
    MotorEffortHistory efforts = [&](double t) { return along.motion().inverseDynamics(t, work); };
    std::vector<double> instants = equallySpaced(duration, scenario.simulation.samples);
    if (!options.torques.empty()) {
      const GivenEfforts given = readEffortsAloud(options.torques, options.map, scenario.mapped, scenario);
      efforts = effortSpline(given);
      instants = given.t;
    }
    const MechanismSimulation run =
        simulateMechanism(along, options.engine, efforts, instants, scenario.simulation.tolerance, deadline);
    const TimeSeries series = simulatedSeries(mechanism, run);
    writeOutput(options.out, csvText(series.names, series.columns));
    const std::string missing = whatIsMissing(run, instants, duration, options.torques);
    if (missing.empty()) return exit_passed;
    say("{}\n", missing);
    return exit_failed;
  });
}

}  // namespace ursula

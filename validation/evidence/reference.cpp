#include "validation/evidence/reference.h"

#include "model/instants.h"
#include "validation/replay/observed_order.h"
#include "validation/subject/motion_check.h"

namespace ursula {
namespace {

Presentation checked(const Scenario& given) {
  checkMotion(given);
  return naturalPresentation(given);
}

}  // namespace

std::vector<PointwiseSample> conditionsAt(const Scenario& scenario, const std::vector<double>& instants,
                                          const RoundingProfile& profile) {
  std::vector<PointwiseSample> out(instants.size());
  for (std::size_t k = 0; k < instants.size(); ++k) {
    out[k].motion = scenario.trajectory->at(instants[k]);
    out[k].conditioning = profile.at(out[k].motion);
  }
  return out;
}

Reference::Reference(const Scenario& given)
    : natural(checked(given)),
      relocated(ursula::relocated(given, natural.origin)),
      scenario(natural.of(given)),
      instants(equallySpaced(scenario.trajectory->duration(), scenario.simulation.samples)),
      profile(scenario, profileInstants(scenario.simulation.samples)),
      amplification(linearised(scenario)),
      conditions(conditionsAt(scenario, instants, profile)),
      position_scale(positionScale(conditions)),
      forces(loopForces(conditions)) {
  const double duration = scenario.trajectory->duration();
  const Subject right = nocSubject(*scenario.manipulator, scenario.load);
  const auto trajectory = scenario.trajectory;
  plan.torques = [right, trajectory](double t) { return right.torques(trajectory->at(t)); };
  plan.acceleration = SampledLimit(conditions);
  plan.position_scale = position_scale;
  plan.step_rate = plannedStepRate(duration);
  plan.tolerance = reachableTolerance(scenario, plan.step_rate);
  plan.max_evaluations = enoughEvaluations(scenario, plan.step_rate);
  windows = replayInWindows(scenario, amplification, plan);
  measureIntegration(scenario, plan, windows);
  measureOpening(conditions, windows);
}

const std::vector<double>& Reference::orders() const {
  std::call_once(observed_, [this] { orders_ = observedOrders(scenario); });
  return orders_;
}

const IntegrationError& Reference::closer(std::size_t window) const {
  const std::lock_guard<std::mutex> lock(measuring_);
  const auto known = closer_.find(window);
  if (known != closer_.end()) return known->second;
  const WindowedReplay& here = windows[window];
  return closer_[window] = closerLook(scenario, plan, here.window, here.replay);
}

}  // namespace ursula

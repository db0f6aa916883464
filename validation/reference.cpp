#include "validation/reference.h"

#include "validation/integration_order.h"
#include "validation/motion_check.h"
#include "validation/validate.h"

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

const Check& Reference::order() const {
  std::call_once(judged_, [this] { order_ = judgeOrder(scenario); });
  return order_;
}

const IntegrationError& Reference::closer(std::size_t window) const {
  const std::lock_guard<std::mutex> lock(measuring_);
  const auto known = closer_.find(window);
  if (known != closer_.end()) return known->second;
  const WindowedReplay& here = windows[window];
  return closer_[window] = closerLook(scenario, plan, here.window, here.replay);
}

std::shared_ptr<const Reference> makeReference(const Scenario& scenario) {
  return std::make_shared<const Reference>(scenario);
}

}  // namespace ursula

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

Reference::Reference(const Scenario& given, int threads)
    : natural(checked(given)),
      relocated(ursula::relocated(given, natural.origin)),
      scenario(natural.of(given)),
      instants(equallySpaced(scenario.trajectory->duration(), scenario.simulation.samples)),
      // The longest first.
      ahead_(threads - 1, {[this] { orders(); }, [this] { simbody(); }, [this] { roads(); }}),
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
  plan.stiff = isStiff(amplification, duration);
  plan.tolerance = reachableTolerance(scenario, plan.step_rate, plan.stiff);
  plan.max_evaluations = enoughEvaluations(scenario, plan.step_rate);
  windows = replayInWindows(scenario, amplification, plan);
  measureIntegration(scenario, plan, windows);
  measureOpening(conditions, windows);
}

Reference::~Reference() { ahead_.finish(); }  // before what its tasks work with

void Reference::prepare(bool direct_dynamics, bool ladder) const {
  if (direct_dynamics) ahead_.add([this] { beside().ends(); });
  ahead_.add([this] { stabilised(); });
  if (direct_dynamics) ahead_.add([this] { direct(); });
  if (ladder) ahead_.add([this] { this->ladder(); });
}

const std::vector<double>& Reference::orders() const {
  return orders_.get([this] { return observedOrders(scenario); });
}

const IntegrationError& Reference::closer(std::size_t window) const {
  const std::lock_guard<std::mutex> lock(measuring_);
  const auto known = closer_.find(window);
  if (known != closer_.end()) return known->second;
  const WindowedReplay& here = windows[window];
  return closer_[window] = closerLook(scenario, plan, here.window, here.replay);
}

std::vector<PointwiseSample> Reference::rightSamples() const {
  std::vector<PointwiseSample> out = conditions;
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k].torques_simbody = simbody()[k].torques;
    out[k].torque.limit = out[k].conditioning.rounding(Rounded::torque);
  }
  return out;
}

const std::vector<SimbodyAnswer>& Reference::simbody() const {
  return simbody_.get([this] { return simbodyAnswers(scenario, instants); });
}

const std::vector<RoadTorques>& Reference::roads() const {
  return roads_.get([this] { return roadTorques(scenario, instants); });
}

const std::vector<ReactionSample>& Reference::reactions() const {
  return reactions_.get([this] { return runReactions(scenario, conditions, simbody()); });
}

const std::vector<DirectSample>& Reference::direct() const {
  return direct_.get([this] { return runDirect(scenario, rightSamples()); });
}

const BesidePath& Reference::beside() const {
  return beside_.get([this] {
    return BesidePath(scenario, plan.torques, amplification, plan.acceleration, 10 * coarser * plan.tolerance);
  });
}

const Ladder& Reference::ladder() const {
  return ladder_.get([this] { return climb(scenario, plan.torques, windows.front()); });
}

const StabilisedReplay& Reference::stabilised() const {
  return stabilised_.get([this] {
    const Subject right = nocSubject(*scenario.manipulator, scenario.load);
    return stabilisedReplay(scenario, right, amplification, rightSamples());
  });
}

}  // namespace ursula

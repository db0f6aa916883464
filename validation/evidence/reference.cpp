#include "validation/evidence/reference.h"

#include <algorithm>
#include <iterator>

#include "model/instants.h"
#include "validation/replay/observed_order.h"
#include "validation/subject/motion_check.h"

namespace ursula {
namespace {

FrameChange checked(const Scenario& given) {
  checkMotion(given);
  return naturalFrameChange(given);
}

/// The instants and the telling ones; none if the instants alone show the motion.
std::vector<double> denserInstants(const PreparedScenario& of, const std::vector<Conditions>& conditions,
                                   const MotionSizes& sizes) {
  constexpr double may_miss = 0.5;  // of a size: limits have the room
  const auto shown = [&](Rounded quantity) {
    return std::any_of(conditions.begin(), conditions.end(), [&](const Conditions& each) {
      return each.conditioning.size(quantity) >= may_miss * sizes.of(quantity);
    });
  };
  if (of.instants.size() >= instants_along && shown(Rounded::twists) && shown(Rounded::twist_rates) &&
      shown(Rounded::torque))
    return {};
  const std::vector<double> telling = tellingInstants(of.scenario);
  std::vector<double> out;
  std::set_union(of.instants.begin(), of.instants.end(), telling.begin(), telling.end(), std::back_inserter(out));
  return out;
}

}  // namespace

std::vector<Conditions> conditionsAt(const Scenario& scenario, const std::vector<double>& instants,
                                     const RoundingProfile& profile, const Deadline& deadline) {
  std::vector<Conditions> out(instants.size());
  for (std::size_t k = 0; k < instants.size(); ++k) {
    deadline.require();
    out[k].motion = scenario.trajectory->at(instants[k]);
    out[k].conditioning = profile.at(out[k].motion);
  }
  return out;
}

PreparedScenario::PreparedScenario(const Scenario& given)
    : natural(checked(given)),
      relocated(ursula::relocated(given, natural.origin)),
      scenario(natural.transformed(given)),
      instants(equallySpaced(scenario.trajectory->duration(), scenario.simulation.samples)) {}

RoundingAlong::RoundingAlong(const PreparedScenario& of, const Deadline& deadline, const FormulationFaults& faults)
    : profile(of.scenario, profileInstants(of.scenario.simulation.samples), deadline, faults),
      conditions(conditionsAt(of.scenario, of.instants, profile, deadline)),
      denser(conditionsAt(of.scenario, denserInstants(of, conditions, profile.sizes()), profile, deadline)),
      position_scale(positionScale(along())),
      forces(loopForces(along())) {}

Reference::Reference(const Scenario& given, int threads, const Deadline& whole, const FormulationFaults& wrong,
                     bool with_replays)
    : PreparedScenario(given), deadline(whole.part()), faults(wrong), in_simbody(wrong.simbody.applied(scenario)) {
  std::vector<BackgroundTasks::Task> first = {[this] { simbody(); }, [this] { engines(); }};
  if (with_replays) first.insert(first.begin(), [this] { orders(); });  // longest first
  background_.start(threads - 1, first);
  rounding();
  if (!whole.isSet() && with_replays) replays();  // with a deadline, work without replays comes first
}

Reference::~Reference() {
  deadline.end();
  background_.finish();
}

void Reference::stop() const {
  background_.finish();
  deadline.remove();
}

RightReplays Reference::rightReplays() const {
  RightReplays out{linearised(scenario, deadline), {}, {}};
  const double duration = scenario.trajectory->duration();
  const Subject right = nocSubject(*scenario.manipulator, scenario.load);
  const auto trajectory = scenario.trajectory;
  ReplayPlan& plan = out.plan;
  plan.torques = [right, trajectory](double t) { return right.torques(trajectory->at(t)); };
  plan.acceleration = SampledLimit(rounding().along());
  plan.deadline = deadline;
  plan.position_scale = rounding().position_scale;
  plan.step_rate = plannedStepRate(duration);
  plan.max_evaluations = enoughEvaluations(scenario, plan.step_rate);
  const auto replayAs = [&](bool stiff) {
    plan.stiff = stiff;
    plan.tolerance = reachableTolerance(scenario, plan.step_rate, stiff);
    out.windows = replayInWindows(scenario, out.amplification, plan);
  };
  replayAs(isStiff(out.amplification, duration));
  // The variational equations do not show everything that shortens an explicit step.
  const auto took_too_long = [](const WindowedReplay& each) { return each.replay.too_long; };
  if (!plan.stiff && std::any_of(out.windows.begin(), out.windows.end(), took_too_long)) replayAs(true);
  measureIntegration(scenario, plan, out.windows);
  measureOpening(rounding().along(), out.windows);
  return out;
}

const RoundingAlong& Reference::rounding() const {
  return rounding_.get([this] { return RoundingAlong(*this, deadline, faults); });
}

const RightReplays& Reference::replays() const {
  return replays_.get([this] { return rightReplays(); });
}

void Reference::prepare(bool direct_dynamics, bool ladder) const {
  background_.add([this] { stabilised(); });
  if (direct_dynamics) background_.add([this] { direct(); });
  if (ladder) background_.add([this] { this->ladder(); });
}

const std::vector<double>& Reference::orders() const {
  return orders_.get([this] { return observedOrders(scenario, false, deadline); });
}

const IntegrationError& Reference::closer(std::size_t window) const {
  const std::lock_guard<std::mutex> lock(measuring_);
  const auto known = closer_.find(window);
  if (known != closer_.end()) return known->second;
  const WindowedReplay& here = replays().windows[window];
  return closer_[window] = closerLook(scenario, replays().plan, here.window, here.replay);
}

const std::vector<SimbodyAnswer>& Reference::simbody() const {
  return simbody_.get([this] { return simbodyAnswers(scenario, instants, deadline, faults.simbody); });
}

const std::vector<EngineTorques>& Reference::engines() const {
  return engines_.get([this] { return engineTorques(scenario, instants, deadline, faults.further); });
}

const std::vector<ReactionSample>& Reference::reactions() const {
  return reactions_.get([this] {
    Subject right = nocSubject(*scenario.manipulator, scenario.load);
    right.torques = [this, torques = right.torques](const Motion<double>& motion) {
      deadline.require();
      return torques(motion);
    };
    return runReactions(in_simbody, right, rounding().conditions);
  });
}

const std::vector<DirectSample>& Reference::direct() const {
  return direct_.get([this] { return runDirect(in_simbody, rounding().conditions, simbody()); });
}

const Ladder& Reference::ladder() const {
  return ladder_.get(
      [this] { return replayLadder(scenario, replays().plan.torques, replays().windows.front(), nullptr, deadline); });
}

const StabilisedReplay& Reference::stabilised() const {
  return stabilised_.get([this] {
    const Subject right = nocSubject(*scenario.manipulator, scenario.load);
    return stabilisedReplay(scenario, right, replays().amplification, rounding().along(), nullptr, deadline);
  });
}

}  // namespace ursula

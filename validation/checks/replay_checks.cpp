#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>

#include "validation/checks/judges.h"
#include "validation/limits/conditioning.h"
#include "validation/replay/observed_order.h"
#include "validation/replay/replay.h"

namespace ursula {
namespace {

/// A value at one step with its limit.
struct Measure {
  std::string name, unit, what;
  std::function<double(const ReplayStep&)> value;
  std::function<double(const WindowedReplay&, const ReplayStep&)> limit;
  std::string basis;
  double size = 0;  ///< size of the measured quantity
};

WorstShare worstOf(const std::vector<WindowedReplay>& windows, const Measure& measure) {
  WorstShare worst;
  for (const WindowedReplay& window : windows)
    for (const ReplayStep& step : window.replay.steps)
      worst.add(measure.value(step), measure.limit(window, step), step.t);
  return worst;
}

std::size_t stepsOf(const std::vector<WindowedReplay>& windows) {
  std::size_t steps = 0;
  for (const WindowedReplay& window : windows) steps += window.replay.steps.size();
  return steps;
}

/// Smaller growth of deviations within a window does not explain a large limit.
constexpr double notable_growth = 100;

/// Returns which part makes a limit large at t.
std::string causeOf(const std::vector<WindowedReplay>& windows, double t, const std::string& of_rounding) {
  for (const WindowedReplay& each : windows) {
    if (t > each.window.end()) continue;
    const double integration = each.integration.measured() ? each.integration.at(t).position : 0;
    const double bound = each.window.bound(t, 0, 0);
    if (integration_safety * integration > bound) return "the integration does not converge to that";
    const double growth = each.window.from_start.back();
    if (growth < notable_growth && !of_rounding.empty()) return of_rounding;
    return fmt::format("deviations grow {:.2g} times within the window", growth);
  }
  return "";
}

Check judgeMeasure(const std::vector<WindowedReplay>& windows, const Measure& measure, const Units& units,
                   const std::string& cause) {
  std::string unfinished;
  for (const WindowedReplay& window : windows) {
    if (window.replay.gave_up.empty()) continue;
    unfinished =
        fmt::format("the replay from t = {:.6g} s gave up at t = {:.6g} s: {}", window.window.start() * units.time,
                    window.replay.stopped_at * units.time, window.replay.gave_up);
    if (!window.replay.too_long) return notMade(measure.name, measure.unit, unfinished);
  }
  const WorstShare worst = worstOf(windows, measure);
  if (!worst.any) return notMade(measure.name, measure.unit, "no step was compared");
  const CheckedQuantity quantity{measure.name, measure.unit, measure.size};
  const JudgedValue shown = worst.shown(quantity.useful());
  const std::string where =
      windows.size() == 1 ? "open loop over the whole motion" : fmt::format("open loop in {} windows", windows.size());
  const std::string why =
      fmt::format("{}, {}, at {} steps; shown for t = {:.6g} s{}{}", measure.what, where, stepsOf(windows),
                  shown.t * units.time, unfinished.empty() ? "" : "; ", unfinished);
  Check check = judgedIfUseful(quantity, worst, measure.basis, why, causeOf(windows, worst.widest_t, cause));
  if (!unfinished.empty() && !shown.beyond)
    check = notJudgeable(Reason::unfinished, measure.name, shown.value, shown.limit, measure.unit, measure.basis, why);
  check.largest = {worst.largest, worst.largest_t * units.time, ""};
  return check;
}

/// The largest energy of all steps.
double energyOf(const std::vector<WindowedReplay>& windows) {
  double largest = 0;
  for (const WindowedReplay& window : windows) largest = std::max(largest, window.replay.energy_scale);
  return largest;
}

double stepCount(const WindowedReplay& window) { return static_cast<double>(window.replay.steps.size()); }

double span(const WindowedReplay& window) { return window.window.end() - window.window.start(); }

}  // namespace

std::vector<Check> judgeReplay(const std::vector<WindowedReplay>& windows, double position_scale, double length,
                               const LoopForces& forces, const Units& units, const std::string& cause) {
  if (windows.empty()) return {notMade("replay.position", "m", "there was no replay")};
  const auto per_step = [position_scale](const WindowedReplay& window) {
    return errorPerStep(window.integration.measured() ? 0 : window.replay.tolerance, position_scale);
  };
  const auto carried = [per_step](const WindowedReplay& window) {
    return per_step(window) * stepCount(window) * (1 + span(window));
  };
  const auto measured = [](const WindowedReplay& window, const ReplayStep& step, double IntegrationError::At::*part) {
    return measuredError(window, step.t, part);
  };
  using At = IntegrationError::At;
  const auto drift = [position_scale](const WindowedReplay& window, const ReplayStep& step) {
    return replayLimit(window, position_scale, step.t);
  };
  const auto turn = [=](const WindowedReplay& window, const ReplayStep& step) {
    return driftWithoutMeasured(window, position_scale, step.t) / length + measured(window, step, &At::rotation);
  };
  const auto opening = [=](const WindowedReplay& window, const ReplayStep& step) {
    return carried(window) + window.opening.position + measured(window, step, &At::gap);
  };
  const auto rate = [=](const WindowedReplay& window, const ReplayStep& step) {
    return carried(window) + window.opening.velocity + measured(window, step, &At::gap_rate);
  };
  const auto energy = [=](const WindowedReplay& window, const ReplayStep& step) {
    return per_step(window) / (1 + position_scale) * stepCount(window) * window.replay.energy_scale +
           forces.size * opening(window, step) + measured(window, step, &At::energy);
  };
  const std::string integration =
      windows.front().integration.measured()
          ? fmt::format("eps a step and {:g} times what a hundredfold tolerance changes", integration_safety)
          : fmt::format("tolerance {:.1g} and eps a step", windows.front().replay.tolerance);
  const std::string drift_basis =
      "rounding of the accelerations, carried by the variational equations and aligned for the worst; " + integration;
  const std::string opening_basis = "rounding of the accelerations at which gaps open, all one way; " + integration;
  const std::vector<Measure> measures = {
      {"replay.position", "m", "P against the commanded path",
       [](const ReplayStep& step) { return step.position_error.norm(); }, drift, drift_basis, length},
      {"replay.orientation", "rad", "orientation against the commanded one",
       [](const ReplayStep& step) { return step.rotation_error.norm(); }, turn, drift_basis, 1},
      {"closure.position", "m", "the loops' gaps", [](const ReplayStep& step) { return step.closure.position; },
       opening, opening_basis, length},
      {"closure.velocity", "m/s", "the rates of the gaps", [](const ReplayStep& step) { return step.closure.velocity; },
       rate, opening_basis, length},
      {"energy.balance", "J", "kinetic and potential energy against the work of torques, friction and load",
       [](const ReplayStep& step) { return std::abs(step.energy_error); }, energy,
       fmt::format("rounding of the energy, and the work of the {:.3g} N that hold the loops on gaps as wide as "
                   "closure.position allows; {}",
                   forces.size * units.force(), integration),
       energyOf(windows)},
  };
  std::vector<Check> checks;
  checks.reserve(measures.size());
  for (const Measure& measure : measures) checks.push_back(judgeMeasure(windows, measure, units, cause));
  return checks;
}

Check judgeOrder(const std::vector<double>& orders) {
  static constexpr const char* check = "integration.order";
  const std::string basis = fmt::format(
      "as far as steps that have not vanished leave it open; it fails where the shortest {} stretches agree to {:g}",
      settled_over, settled);
  if (orders.empty())
    return notJudgeable(Reason::not_covered, check, std::nan(""), largest_shortfall, "", basis,
                        "no stretch of the motion is between rounding and steps too long to show an order");
  const double order = bestOrder(orders), shortfall = std::max(0.0, nominal_order - order);
  const std::string why = fmt::format(
      "observed order {:.3g}, of {:g}, by halving fixed steps twice: the best over the shorter half of {} stretches, "
      "without friction and load",
      order, nominal_order, orders.size());
  if (shortfall > largest_shortfall && !haveSettled(orders))
    return notJudgeable(Reason::limit_useless, check, shortfall, largest_shortfall, "", basis,
                        why + "; the orders have not settled: rounding is met before the steps are short enough");
  return judged(check, shortfall, largest_shortfall, "", basis, why);
}

namespace {

/// Above this share of the largest torque, a limit proves nothing if the replay gave up. Rounding alone may then
/// destabilise the machine.
constexpr double telling_limit = 1e-4;

}  // namespace

Check judgeStabilised(const StabilisedReplay& found, double largest, const Units& units) {
  static constexpr const char* check = "feedback.torque";
  const std::string stopped =
      found.stopped.empty() ? "" : fmt::format("; {} at t = {:.6g} s", found.stopped, found.stopped_at * units.time);
  const std::string cause = found.noisiest ? causeOfRounding(*found.noisiest) : "";
  if (found.gave_up && found.torque <= found.limit) {
    const std::string why = "the stabilised replay gave up" + stopped;
    if (found.limit <= telling_limit * largest) return notMade(check, units.efforts.unit, why);
    return notJudgeable(Reason::limit_useless, check, found.torque, found.limit, units.efforts.unit, "",
                        fmt::format("{}; the limit exceeds {:g} of the largest torque: {}", why, telling_limit, cause));
  }
  const std::string basis = fmt::format(
      "{:.3g} {}, twice the torque's largest rounding and the loops' as torque, answered with {:.3g} of it, and half "
      "of it again from a step",
      found.rounding * units.effort(), units.efforts.unit, found.answer);
  const std::string why = fmt::format(
      "torque that a weak stabilising term added over the whole motion, {:.3g} of the largest torque; shown for t = "
      "{:.6g} s of {} steps, {} derivative evaluations{}",
      largest > 0 ? found.torque / largest : found.torque, found.t * units.time, found.steps, found.evaluations,
      stopped);
  WorstShare worst;
  worst.add(found.torque, found.limit, found.t);
  Check out = judgedIfUseful({check, units.efforts.unit, largest, 0, largest, largest}, worst, basis, why, cause);
  if (found.torque <= found.limit && found.too_long)
    out = notJudgeable(Reason::unfinished, check, found.torque, found.limit, units.efforts.unit, basis, why);
  out.largest = {found.torque, found.t * units.time, ""};
  return out;
}

}  // namespace ursula

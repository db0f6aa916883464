#include "validation/checks/judges.h"
#include "validation/replay/windowed_replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace ursula {
namespace {

constexpr const char* second_check = "integration.second";

/// The second integrator's accuracy applies per step and enters the error with a power between 4/5 and 1. So ten times
/// the accuracy reduces the error at least five times.
constexpr double second_safety = 10;
/// A hundred times the tolerance gives a hundred times the error at any order; less than this factor means no
/// convergence. If knots instead of the tolerance set the steps, the error need only fall with the steps, by half the
/// order.
constexpr double least_gain = 4;

/// An error below this share of the largest useful limit decides nothing, even without convergence.
constexpr double harmless = 0.01;

/// Returns an inconclusive ladder if this proves nothing, otherwise a failure. The second integrator has nothing to be
/// compared with.
std::vector<Check> notClimbed(bool proves_nothing, const std::string& why) {
  static constexpr const char* check = "integration.ladder";
  return {proves_nothing ? notJudgeable(Reason::unfinished, check, std::nan(""), std::nan(""), "m", "", why)
                         : notMade(check, "m", why),
          notApplicable(second_check, "m", why)};
}

/// The error at the window's end that rounding alone may cause, m.
double roundingBound(const WindowedReplay& finest, double position_scale, double t) {
  const double measured = finest.closer.measured() ? integration_safety * finest.closer.at(t).position : 0;
  return driftLimit(finest.window, 0, static_cast<double>(finest.replay.steps.size()), position_scale, t) + measured;
}

const Rung* firstThat(const std::vector<Rung>& rungs, const std::function<bool(const Rung&)>& holds) {
  const auto found = std::find_if(rungs.begin(), rungs.end(), holds);
  return found == rungs.end() ? nullptr : &*found;
}

Check judgeConvergence(const Ladder& ladder, const WindowedReplay& finest, double position_scale, const Units& units) {
  const Rung& coarse = ladder.rungs[ladder.rungs.size() - 2];
  const Rung& fine = ladder.rungs.back();
  std::string orders;
  for (double p : ladder.observed_orders)
    if (std::isfinite(p)) orders += fmt::format("{}{:.3g}", orders.empty() ? "" : ", ", p);
  const double steps = static_cast<double>(fine.steps) / static_cast<double>(std::max(coarse.steps, 1L));
  // The rungs take as many steps as each other, but the judged replay takes more, so knots do not set the steps.
  const bool ignores_tolerance =
      steps <= 1 && static_cast<double>(finest.replay.accepted) > 1.5 * static_cast<double>(fine.steps);
  const bool same_run = !ignores_tolerance && steps == 1 && fine.distance == coarse.distance;  // it says nothing
  const double share = same_run            ? 0
                       : ignores_tolerance ? 1 / least_gain
                                           : std::max(1 / least_gain, 2 * std::pow(steps, -nominal_order / 2));
  WorstShare worst;
  worst.add(fine.distance,
            std::max({coarse.distance * share, roundingBound(finest, position_scale, finest.window.end()),
                      harmless * useful_replay_limit * finest.window.length}),
            finest.window.end() * units.time);
  Check check = judgedIfUseful(
      {"integration.ladder", "m", finest.window.length}, worst,
      fmt::format("{:.3g} of what it is at a tolerance of {:g}, which takes {} steps of {}; or what rounding may make "
                  "of it; or {:g} of what a replay's limit may be",
                  share, coarse.tolerance, coarse.steps, fine.steps, harmless),
      fmt::format("ends of the replay at tolerances {:g} and {:g}; observed orders {} of {}, {}", fine.tolerance,
                  finest.replay.tolerance, orders.empty() ? "none" : orders, nominal_order,
                  ladder.asymptotic ? "asymptotic" : "not asymptotic"),
      "a coarser tolerance, or rounding, moves the end by as much");
  if (check.verdict == Verdict::fail && (ladder.passes_knots || same_run))
    check =
        notJudgeable(Reason::limit_useless, check.name, check.value, check.limit, "m", check.basis,
                     check.why + (same_run ? "; both tolerances take the same steps, which shows no convergence"
                                           : "; the motion has more knots than can be stepped to, so that it need not "
                                             "converge"));
  return check;
}

/// Ten times the accuracy costs a fourth-order integrator 1.8 times the steps. Many more steps mean that it follows
/// noise.
bool followsTheMotion(const std::vector<Rung>& second) {
  constexpr long most_times = 4;
  return second.size() < 2 || second.back().evaluations <= most_times * second[second.size() - 2].evaluations;
}

Check judgeSecondEnd(const Ladder& ladder, const WindowedReplay& finest, double position_scale, const Units& units) {
  const Rung& second = ladder.second.back();
  for (const Rung& rung : ladder.second)
    if (!rung.gave_up.empty() || rung.left_path)
      return notJudgeable(Reason::unfinished, second_check, std::nan(""), std::nan(""), "m", "",
                          "Simbody's integrator did not get there: " + rung.gave_up);
  WorstShare worst;
  worst.add(second.distance,
            second_safety * ladder.second_difference + replayLimit(finest, position_scale, ladder.second_end),
            ladder.second_end * units.time);
  return judgedIfUseful(
      {second_check, "m", finest.window.length}, worst,
      fmt::format("{:g} times what longer steps, at ten times the accuracy, change of it, and the limit of "
                  "replay.position there",
                  second_safety),
      fmt::format("the replay by Simbody's RungeKuttaMerson to t = {:.6g} s, accuracy {:g}, {} derivative evaluations, "
                  "against {}",
                  ladder.second_end * units.time, second.tolerance, second.evaluations, name(finest.replay.integrator)),
      "longer steps of that integrator move its end by as much");
}

Check judgeSecond(const Ladder& ladder, const WindowedReplay& finest, double position_scale, const Units& units) {
  if (std::isnan(ladder.second_contradiction))
    return notApplicable(second_check, "m",
                         "Simbody's own forward dynamics has no answer: links are massless or nearly massless");
  if (ladder.second_contradiction > second_accuracy)
    return notApplicable(
        second_check, "m",
        fmt::format("Simbody's integrator takes accelerations of Simbody's own forward dynamics, which are off by "
                    "{:.2g} m/s^2 from what its constraints and inverse dynamics ask: links are nearly massless",
                    ladder.second_contradiction * units.acceleration()));
  if (ladder.second.empty()) return notMade(second_check, "m", "there was no second integrator");
  const Check out = judgeSecondEnd(ladder, finest, position_scale, units);
  if (out.verdict == Verdict::pass || followsTheMotion(ladder.second)) return out;
  return notApplicable(
      second_check, "m",
      fmt::format("Simbody's integrator takes {} evaluations of the derivatives and more, for {} at a tenth of the "
                  "accuracy: its steps follow noise of its forward dynamics",
                  ladder.second.back().evaluations, ladder.second[ladder.second.size() - 2].evaluations));
}

}  // namespace

std::vector<Check> judgeLadder(const Ladder& ladder, const WindowedReplay& finest, double position_scale,
                               const Units& units) {
  if (ladder.rungs.empty()) return {notMade("integration.ladder", "m", "no ladder was climbed")};
  if (!finest.replay.gave_up.empty())
    return notClimbed(finest.replay.too_long, "the judged replay gave up: " + finest.replay.gave_up);
  if (finest.replay.left_path) return notClimbed(false, "the judged replay left the path");
  if (const Rung* rung = firstThat(ladder.rungs, [](const Rung& each) { return each.left_path; }))
    return notClimbed(true, fmt::format("{} at {:g} left the path", name(rung->integrator), rung->tolerance));
  if (const Rung* rung = firstThat(ladder.rungs, [](const Rung& each) { return !each.gave_up.empty(); }))
    return notClimbed(rung->too_long,
                      fmt::format("{} at {:g} gave up: {}", name(rung->integrator), rung->tolerance, rung->gave_up));
  const Check convergence =
      ladder.rungs.size() > 1
          ? judgeConvergence(ladder, finest, position_scale, units)
          : notJudgeable(
                Reason::not_covered, "integration.ladder", std::nan(""), std::nan(""), "m", "",
                fmt::format("a tolerance of {:g} leaves room for one coarser tolerance, {:g}, and two are needed",
                            finest.replay.tolerance, ladder.rungs.front().tolerance));
  return {convergence, judgeSecond(ladder, finest, position_scale, units)};
}

}  // namespace ursula

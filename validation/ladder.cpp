#include "validation/ladder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "validation/windows.h"

namespace ursula {
namespace {

constexpr double nominal_order = 8;
/// Of Simbody's integrator: error control of fourth order takes too many steps beyond.
constexpr double second_accuracy = 1e-9;
/// Its accuracy is of a step, and goes into an error with a power between 4/5 and 1: ten times the accuracy changes at
/// least five times what is left.
constexpr double second_safety = 10;
/// A hundred times the tolerance makes an error a hundred times as large, whatever the order; where it does not make it
/// this many times as large, the integration does not converge. Where knots, not the tolerance, decide the steps, the
/// error may only be asked to fall with them, by half the order.
constexpr double least_gain = 4;

/// Of the tolerance, at a further rung, where one may have met a kink of the friction by bad luck.
constexpr double last_rung = 10;

/// An error below this share of the largest useful limit decides nothing, whether or not it converges.
constexpr double harmless = 0.01;

using SpoilSettings = std::function<void(ReplaySettings&)>;

ReplaySettings settingsOf(const WindowedReplay& finest, Integrator integrator, double tolerance) {
  ReplaySettings settings;
  settings.integrator = integrator;
  settings.tolerance = tolerance;
  settings.start = finest.window.start();
  settings.end = finest.window.end();
  settings.instants = 2;
  settings.max_evaluations = std::max(settings.max_evaluations, 4 * finest.replay.evaluations);
  return settings;
}

Rung rungOf(const ReplaySettings& settings, const Replay& run, const Replay& finest) {
  Rung rung;
  rung.integrator = settings.integrator;
  rung.tolerance = settings.tolerance;
  rung.evaluations = run.evaluations;
  rung.steps = run.accepted;
  rung.gave_up = run.gave_up;
  rung.too_long = run.too_long;
  rung.left_path = run.left_path;
  rung.distance =
      run.steps.empty() || finest.steps.empty()
          ? std::nan("")
          : (run.steps.back().position_error - interpolated(finest, run.steps.back().t).position_error).norm();
  return rung;
}

/// One replay beside the judged one.
Replay replayBeside(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, ReplaySettings settings,
                    const SpoilSettings& spoil) {
  if (spoil) spoil(settings);
  return replay(scenario, torques, settings);
}

Rung makeRung(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, const WindowedReplay& finest,
              double tolerance, const SpoilSettings& spoil) {
  const ReplaySettings settings = settingsOf(finest, Integrator::rkf78, tolerance);
  return rungOf(settings, replayBeside(scenario, torques, settings, spoil), finest.replay);
}

/// Over the first steps only, a tenth of them at least: it is another integrator that is wanted, not another replay.
void climbSecond(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, const WindowedReplay& finest,
                 const SpoilSettings& spoil, Ladder& ladder) {
  const std::vector<ReplayStep>& steps = finest.replay.steps;
  if (steps.size() < 2) return;
  const std::size_t last = std::min(steps.size() - 1, std::max<std::size_t>(20, steps.size() / 10));
  ladder.second_end = steps[last].t;
  const auto run = [&](double accuracy) {
    ReplaySettings settings = settingsOf(finest, Integrator::rk_merson, accuracy);
    settings.end = ladder.second_end;
    Replay out = replayBeside(scenario, torques, settings, spoil);
    ladder.second.push_back(rungOf(settings, out, finest.replay));
    return out;
  };
  Replay coarse = run(10 * second_accuracy), fine = run(second_accuracy);
  // Where the accuracy does not decide the steps, both are the same and nothing is learnt of the error.
  for (double accuracy = second_accuracy / 10; accuracy > 1e-14 && fine.evaluations <= coarse.evaluations;
       accuracy /= 10) {
    coarse = std::move(fine);
    fine = run(accuracy);
  }
  const bool both = !coarse.steps.empty() && !fine.steps.empty();
  ladder.second_difference =
      both ? (coarse.steps.back().position_error - fine.steps.back().position_error).norm() : std::nan("");
}

double order(const Rung& coarse, const Rung& fine) {
  return std::log(coarse.distance / fine.distance) /
         std::log(static_cast<double>(fine.steps) / static_cast<double>(coarse.steps));
}

/// Inconclusive where that proves nothing, else a failure.
Check notClimbed(bool proves_nothing, const std::string& why) {
  static constexpr const char* check = "integration.ladder";
  return proves_nothing ? notJudgeable(Reason::unfinished, check, std::nan(""), std::nan(""), "m", "", why)
                        : notMade(check, "m", why);
}

/// What rounding alone may make of the window's end, m.
double roundingBound(const WindowedReplay& finest, double position_scale, double t) {
  const double measured = finest.closer.measured() ? integration_safety * finest.closer.at(t).position : 0;
  return driftLimit(finest.window, 0, static_cast<double>(finest.replay.steps.size()), position_scale, t) + measured;
}

const Rung* firstThat(const std::vector<Rung>& rungs, const std::function<bool(const Rung&)>& holds) {
  const auto found = std::find_if(rungs.begin(), rungs.end(), holds);
  return found == rungs.end() ? nullptr : &*found;
}

Check judgeConvergence(const Ladder& ladder, const WindowedReplay& finest, double position_scale) {
  const Rung& coarse = ladder.rungs[ladder.rungs.size() - 2];
  const Rung& fine = ladder.rungs.back();
  std::string orders;
  for (double p : ladder.observed_orders) orders += fmt::format("{}{:.3g}", orders.empty() ? "" : ", ", p);
  const double steps = static_cast<double>(fine.steps) / static_cast<double>(std::max(coarse.steps, 1L));
  // Rungs alike, and unlike the judged replay: it is not the knots that decide their steps.
  const bool heedless =
      steps <= 1 && static_cast<double>(finest.replay.accepted) > 1.5 * static_cast<double>(fine.steps);
  const double share = heedless ? 1 / least_gain : std::max(1 / least_gain, 2 * std::pow(steps, -nominal_order / 2));
  Check check = judged(
      "integration.ladder", fine.distance,
      std::max({coarse.distance * share, roundingBound(finest, position_scale, finest.window.end()),
                harmless * useful_replay_limit * finest.window.length}),
      "m",
      fmt::format(
          "{:.3g} of what it is at a tolerance of {:g}, which takes {} steps of {}; or what rounding may make of "
          "it; or {:g} of what a replay's limit may be",
          share, coarse.tolerance, coarse.steps, fine.steps, harmless),
      fmt::format("ends of the replay at tolerances {:g} and {:g}; observed orders {} of {}, {}", fine.tolerance,
                  finest.replay.tolerance, orders, nominal_order, ladder.asymptotic ? "asymptotic" : "not asymptotic"));
  if (check.verdict == Verdict::fail && ladder.passes_knots)
    check =
        notJudgeable(Reason::limit_useless, check.name, check.value, check.limit, "m", check.basis,
                     check.why + "; the motion has more knots than can be stepped to, so that it need not converge");
  return check;
}

Check judgeSecond(const Ladder& ladder, const WindowedReplay& finest, double position_scale, const Units& units) {
  static constexpr const char* check = "integration.second";
  if (ladder.second.empty()) return notMade(check, "m", "there was no second integrator");
  const Rung& second = ladder.second.back();
  for (const Rung& rung : ladder.second)
    if (!rung.gave_up.empty() || rung.left_path)
      return notJudgeable(Reason::unfinished, check, std::nan(""), std::nan(""), "m", "",
                          "Simbody's integrator did not get there: " + rung.gave_up);
  return judged(
      check, second.distance,
      second_safety * ladder.second_difference + replayLimit(finest, position_scale, ladder.second_end), "m",
      fmt::format("{:g} times what longer steps, at ten times the accuracy, change of it, and the limit of "
                  "replay.position there",
                  second_safety),
      fmt::format("the replay by Simbody's RungeKuttaMerson to t = {:.6g} s, accuracy {:g}, {} derivative evaluations, "
                  "against {}",
                  ladder.second_end * units.time, second.tolerance, second.evaluations,
                  name(finest.replay.integrator)));
}

}  // namespace

Ladder climb(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, const WindowedReplay& finest,
             bool torques_are_right, const SpoilSettings& spoil) {
  Ladder ladder;
  for (double factor : {1e6, 1e4, coarser}) {
    const double tolerance = std::min(1e-4, factor * finest.replay.tolerance);
    const bool known = torques_are_right && !spoil && finest.coarse && finest.coarse->integrator == Integrator::rkf78 &&
                       finest.coarse->tolerance == tolerance;
    ladder.rungs.push_back(known
                               ? rungOf(settingsOf(finest, Integrator::rkf78, tolerance), *finest.coarse, finest.replay)
                               : makeRung(scenario, torques, finest, tolerance, spoil));
  }
  for (std::size_t k = 0; k + 1 < ladder.rungs.size(); ++k)
    ladder.observed_orders.push_back(order(ladder.rungs[k], ladder.rungs[k + 1]));
  ladder.asymptotic = std::all_of(ladder.observed_orders.begin(), ladder.observed_orders.end(),
                                  [](double p) { return std::abs(p - nominal_order) <= 2; });
  // Richardson with the last observed order, or without an asymptotic range the last difference itself.
  const Rung& last = ladder.rungs.back();
  const double ratio = static_cast<double>(finest.replay.accepted) / static_cast<double>(std::max(last.steps, 1L));
  const double p = ladder.asymptotic ? ladder.observed_orders.back() : 0;
  ladder.extrapolated = last.distance * std::pow(ratio, -p);
  ladder.uncertainty = integration_safety * ladder.extrapolated;
  climbSecond(scenario, torques, finest, spoil, ladder);
  ladder.passes_knots = allKnots(scenario).size() > most_knots;
  return ladder;
}

void climbOn(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, const WindowedReplay& finest,
             const SpoilSettings& spoil, Ladder& ladder) {
  ladder.rungs.push_back(makeRung(scenario, torques, finest, last_rung * finest.replay.tolerance, spoil));
}

std::vector<Check> judgeLadder(const Ladder& ladder, const WindowedReplay& finest, double position_scale,
                               const Units& units) {
  if (ladder.rungs.size() < 2) return {notMade("integration.ladder", "m", "no ladder was climbed")};
  if (!finest.replay.gave_up.empty())
    return {notClimbed(finest.replay.too_long, "the judged replay gave up: " + finest.replay.gave_up)};
  if (finest.replay.left_path) return {notMade("integration.ladder", "m", "the judged replay left the path")};
  if (const Rung* rung = firstThat(ladder.rungs, [](const Rung& each) { return each.left_path; }))
    return {notClimbed(true, fmt::format("{} at {:g} left the path", name(rung->integrator), rung->tolerance))};
  if (const Rung* rung = firstThat(ladder.rungs, [](const Rung& each) { return !each.gave_up.empty(); }))
    return {notClimbed(rung->too_long,
                       fmt::format("{} at {:g} gave up: {}", name(rung->integrator), rung->tolerance, rung->gave_up))};
  return {judgeConvergence(ladder, finest, position_scale), judgeSecond(ladder, finest, position_scale, units)};
}

TimeSeries workPrecision(const Ladder& ladder) {
  TimeSeries series;
  std::vector<double> evaluations, distances;
  for (const Rung& rung : ladder.rungs) {
    evaluations.push_back(static_cast<double>(rung.evaluations));
    distances.push_back(rung.distance);
  }
  series.add("evaluations", std::move(evaluations));
  series.add("rkf78_error_m", std::move(distances));
  return series;
}

}  // namespace ursula

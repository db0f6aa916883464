#include "validation/ladder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ursula {
namespace {

constexpr double nominal_order = 8;

Rung makeRung(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, const WindowedReplay& finest,
              Integrator integrator, double tolerance) {
  ReplaySettings settings;
  settings.integrator = integrator;
  settings.tolerance = tolerance;
  settings.start = finest.window.start();
  settings.end = finest.window.end();
  settings.instants = 2;
  settings.max_evaluations = std::max(settings.max_evaluations, 4 * finest.replay.evaluations);
  const Replay run = replay(scenario, torques, settings);
  Rung rung;
  rung.integrator = integrator;
  rung.tolerance = tolerance;
  rung.evaluations = run.evaluations;
  rung.steps = run.accepted;
  rung.gave_up = run.gave_up;
  rung.too_long = run.too_long;
  rung.left_path = run.left_path;
  rung.distance = run.steps.empty() || finest.replay.steps.empty()
                      ? std::nan("")
                      : (run.steps.back().position_error - finest.replay.steps.back().position_error).norm();
  return rung;
}

double order(const Rung& coarse, const Rung& fine) {
  return std::log(coarse.distance / fine.distance) /
         std::log(static_cast<double>(fine.steps) / static_cast<double>(coarse.steps));
}

/// Inconclusive where that proves nothing, else a failure.
Check notClimbed(bool proves_nothing, const std::string& why) {
  static constexpr const char* check = "integration.ladder";
  return proves_nothing ? notJudgeable(check, std::nan(""), std::nan(""), "m", "", why) : notMade(check, "m", why);
}

double driftBound(const WindowedReplay& finest, const Rung& rung, double position_scale) {
  return driftLimit(finest.window, rung.tolerance, static_cast<double>(rung.steps), position_scale,
                    finest.window.end());
}

}  // namespace

Ladder climb(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, const WindowedReplay& finest) {
  Ladder ladder;
  for (double factor : {1e6, 1e4, 1e2})
    ladder.rungs.push_back(
        makeRung(scenario, torques, finest, Integrator::rkf78, std::min(1e-4, factor * finest.replay.tolerance)));
  for (std::size_t k = 0; k + 1 < ladder.rungs.size(); ++k)
    ladder.observed_orders.push_back(order(ladder.rungs[k], ladder.rungs[k + 1]));
  ladder.asymptotic = std::all_of(ladder.observed_orders.begin(), ladder.observed_orders.end(),
                                  [](double p) { return std::abs(p - nominal_order) <= 2; });
  // Richardson with the last observed order, or without an asymptotic range the last difference itself.
  const Rung& last = ladder.rungs.back();
  const double ratio = static_cast<double>(finest.replay.accepted) / static_cast<double>(std::max(last.steps, 1L));
  const double p = ladder.asymptotic ? ladder.observed_orders.back() : 0;
  ladder.extrapolated = last.distance * std::pow(ratio, -p);
  // Three times, as Roache's grid convergence index takes it for two grids (Verification and Validation, 1998, ch. 5).
  ladder.uncertainty = 3 * ladder.extrapolated;
  ladder.rungs.push_back(
      makeRung(scenario, torques, finest, Integrator::rk_merson, std::min(1e-4, 1e6 * finest.replay.tolerance)));
  return ladder;
}

std::vector<Check> judgeLadder(const Ladder& ladder, const WindowedReplay& finest, double position_scale) {
  if (ladder.rungs.size() < 2) return {notMade("integration.ladder", "m", "no ladder was climbed")};
  if (!finest.replay.gave_up.empty())
    return {notClimbed(finest.replay.too_long, "the judged replay gave up: " + finest.replay.gave_up)};
  if (finest.replay.left_path) return {notMade("integration.ladder", "m", "the judged replay left the path")};
  for (const Rung& rung : ladder.rungs)
    if (rung.left_path)
      return {notClimbed(true, fmt::format("{} at {:g} left the path", name(rung.integrator), rung.tolerance))};
  for (const Rung& rung : ladder.rungs)
    if (!rung.gave_up.empty())
      return {notClimbed(rung.too_long,
                         fmt::format("{} at {:g} gave up: {}", name(rung.integrator), rung.tolerance, rung.gave_up))};
  const Rung& coarse = ladder.rungs[ladder.rungs.size() - 2];
  const Rung& second = ladder.rungs.back();
  std::string orders;
  for (double p : ladder.observed_orders) orders += fmt::format("{}{:.3g}", orders.empty() ? "" : ", ", p);
  return {
      judged("integration.ladder", coarse.distance, driftBound(finest, coarse, position_scale), "m",
             fmt::format("the drift bound of the coarser rung, tolerance {:g}", coarse.tolerance),
             fmt::format("ends of the replay at tolerances {:g} and {:g}; observed orders {} of {}, {}; the finest is "
                         "off by {:.2g} +- {:.2g} m",
                         coarse.tolerance, finest.replay.tolerance, orders, nominal_order,
                         ladder.asymptotic ? "asymptotic" : "not asymptotic", ladder.extrapolated, ladder.uncertainty)),
      judged("integration.second", second.distance, driftBound(finest, second, position_scale), "m",
             fmt::format("the drift bound at its accuracy, {:g}", second.tolerance),
             fmt::format("end of the replay by Simbody's RungeKuttaMerson, {} derivative evaluations, against {}",
                         second.evaluations, name(finest.replay.integrator)))};
}

TimeSeries workPrecision(const Ladder& ladder) {
  TimeSeries series;
  std::vector<double> evaluations, distances;
  for (const Rung& rung : ladder.rungs) {
    if (rung.integrator != Integrator::rkf78) continue;
    evaluations.push_back(static_cast<double>(rung.evaluations));
    distances.push_back(rung.distance);
  }
  series.add("evaluations", std::move(evaluations));
  series.add("rkf78_error_m", std::move(distances));
  return series;
}

}  // namespace ursula

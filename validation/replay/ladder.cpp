#include "validation/replay/ladder.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <limits>
#include <new>
#include <stdexcept>

#include "model/instants.h"
#include "validation/replay/windows.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

/// Factor on the tolerance of an additional rung, for the case that a rung meets a kink of the friction.
constexpr double last_rung = 10;
/// The largest tolerance of a rung.
constexpr double coarsest = 1e-4;

using ChangeSettings = std::function<void(ReplaySettings&)>;

ReplaySettings settingsOf(const WindowedReplay& finest, Integrator integrator, double tolerance) {
  ReplaySettings settings;
  settings.integrator = integrator;
  settings.tolerance = tolerance;
  settings.stiff = finest.replay.stiff && integrator == Integrator::rkf78;
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

/// `change`, which may be empty, and the deadline.
ChangeSettings inTime(const ChangeSettings& change, const Deadline& deadline) {
  return [change, deadline](ReplaySettings& settings) {
    settings.deadline = deadline;
    if (change) change(settings);
  };
}

/// One replay beside the judged one.
Replay replayBeside(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, ReplaySettings settings,
                    const ChangeSettings& change) {
  change(settings);
  return replay(scenario, torques, settings);
}

void addRung(const ReplaySettings& settings, const Replay& run, const Replay& finest, std::vector<Rung>& to,
             AskedTorques& asked) {
  to.push_back(rungOf(settings, run, finest));
  asked.add(run.asked);
}

void makeRung(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, const WindowedReplay& finest,
              double tolerance, const ChangeSettings& change, Ladder& ladder) {
  const ReplaySettings settings = settingsOf(finest, Integrator::rkf78, tolerance);
  addRung(settings, replayBeside(scenario, torques, settings, change), finest.replay, ladder.rungs, ladder.asked);
}

/// Limit of evaluations for one run of Simbody's own integrator: twice what the paper's whole motion needs. With
/// massless links it would run for minutes.
constexpr long most_second_evaluations = 20000;

/// The largest contradiction at some instants of the commanded motion, in natural units, where rotations and
/// translations are comparable.
double contradictionBetween(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, double from,
                            double to) {
  constexpr int instants = 9;
  SimbodyLoop loop(*scenario.manipulator, SimbodyLoop::Topology::ball_per_leg, scenario.load);
  double largest = 0;
  for (const double t : equallySpaced(to - from, instants)) {
    loop.place(scenario.trajectory->at(from + t));
    const Vector6d asked = torques(from + t);
    try {
      largest = larger(largest, loop.ownTwistRateError(asked).norm());
    } catch (const std::exception& error) {
      if (isShortage(error)) throw;
      return std::numeric_limits<double>::infinity();  // Simbody has no accelerations at all
    }
  }
  return largest;
}

/// Runs until `ladder.second_end`, at two accuracies or more.
void replaySecond(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, const WindowedReplay& finest,
                  const ChangeSettings& change, Ladder& ladder) {
  ladder.second.clear();
  ladder.second_difference = std::nan("");
  const auto run = [&](double accuracy) {
    ReplaySettings settings = settingsOf(finest, Integrator::rk_merson, accuracy);
    settings.end = ladder.second_end;
    long left = most_second_evaluations;
    const SimbodyLoop::TorqueHistory counted = [&](double t) {
      if (left-- <= 0) throw std::runtime_error("it takes too many steps");
      return torques(t);
    };
    Replay out = replayBeside(scenario, counted, settings, change);
    addRung(settings, out, finest.replay, ladder.second, ladder.asked);
    return out;
  };
  Replay coarse = run(10 * second_accuracy);
  if (!coarse.gave_up.empty()) return;
  Replay fine = run(second_accuracy);
  // Equal runs say nothing about the error.
  for (double accuracy = second_accuracy / 10; accuracy > 1e-14 && fine.evaluations <= coarse.evaluations;
       accuracy /= 10) {
    coarse = std::move(fine);
    fine = run(accuracy);
  }
  const bool both = !coarse.steps.empty() && !fine.steps.empty();
  ladder.second_difference =
      both ? (coarse.steps.back().position_error - fine.steps.back().position_error).norm() : std::nan("");
}

/// Covers only the first steps, at least a tenth, because it tests the integrator and not the whole replay. It covers
/// fewer if they take too many evaluations.
void replayBySecondIntegrator(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques,
                              const WindowedReplay& finest, const ChangeSettings& change, Ladder& ladder) {
  const std::vector<ReplayStep>& steps = finest.replay.steps;
  if (steps.size() < 2) return;
  // Simbody's integrator is explicit, so stiff friction limits it to a single step of the judged replay.
  const std::size_t wanted = finest.replay.stiff ? 1 : std::max<std::size_t>(20, steps.size() / 10);
  for (std::size_t last = std::min(steps.size() - 1, wanted); last > 0; last /= 4) {
    ladder.second_end = steps[last].t;
    ladder.second_contradiction = contradictionBetween(scenario, torques, finest.window.start(), ladder.second_end);
    if (!(ladder.second_contradiction <= second_accuracy)) return;
    replaySecond(scenario, torques, finest, change, ladder);
    if (ladder.second.back().gave_up.empty()) return;
  }
}

double order(const Rung& coarse, const Rung& fine) {
  return std::log(coarse.distance / fine.distance) /
         std::log(static_cast<double>(fine.steps) / static_cast<double>(coarse.steps));
}

}  // namespace

Ladder replayLadder(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, const WindowedReplay& finest,
                    const ChangeSettings& change, const Deadline& deadline) {
  const ChangeSettings timed = inTime(change, deadline);
  Ladder ladder;
  for (double factor : {1e6, 1e4, coarser}) {
    const double tolerance = std::min(coarsest, factor * finest.replay.tolerance);
    if (!ladder.rungs.empty() && ladder.rungs.back().tolerance == tolerance) continue;  // it would be the same run
    const bool known = !change && finest.coarse && finest.coarse->integrator == Integrator::rkf78 &&
                       finest.coarse->tolerance == tolerance && finest.coarse->asked.sameFrom(torques);
    const ReplaySettings settings = settingsOf(finest, Integrator::rkf78, tolerance);
    if (known)
      addRung(settings, *finest.coarse, finest.replay, ladder.rungs, ladder.asked);
    else
      makeRung(scenario, torques, finest, tolerance, timed, ladder);
  }
  if (ladder.rungs.size() == 1 && last_rung * finest.replay.tolerance < coarsest)
    makeRung(scenario, torques, finest, last_rung * finest.replay.tolerance, timed, ladder);
  for (std::size_t k = 0; k + 1 < ladder.rungs.size(); ++k)
    ladder.observed_orders.push_back(order(ladder.rungs[k], ladder.rungs[k + 1]));
  ladder.asymptotic = std::all_of(ladder.observed_orders.begin(), ladder.observed_orders.end(),
                                  [](double p) { return std::abs(p - nominal_order) <= 2; });
  replayBySecondIntegrator(scenario, torques, finest, timed, ladder);
  ladder.passes_knots = allKnots(scenario).size() > most_knots;
  return ladder;
}

void extendLadder(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, const WindowedReplay& finest,
                  const ChangeSettings& change, const Deadline& deadline, Ladder& ladder) {
  makeRung(scenario, torques, finest, last_rung * finest.replay.tolerance, inTime(change, deadline), ladder);
}

}  // namespace ursula

#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/deadline.h"

namespace ursula {

using OdeState = std::vector<double>;

/// How a run ended.
struct RunEnd {
  long evaluations = 0;  ///< of the derivatives
  std::string gave_up;   ///< why it did not reach the last instant; else empty
};

/// Integrates a system from its state `start` at the first of `instants` with rkf78 at `tolerance`, and stops at each
/// for `record(t, state)`. The system starts, differentiates, finishes each accepted step, and may say why steps
/// shrink.
template <class System, class Start, class Efforts, class Record>
RunEnd stopAtInstants(System& system, const Start& start, const Efforts& efforts, const std::vector<double>& instants,
                      double tolerance, const Deadline& deadline, const Record& record) {
  namespace odeint = boost::numeric::odeint;
  constexpr long patience = 20'000;  // evaluations that must advance by a thousandth of the time
  RunEnd out;
  OdeState x = system.start(start);
  auto stepper = odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_fehlberg78<OdeState>());
  double t = instants.front(), dt = (instants.back() - t) / 128, since = t;
  const double least = 1e-3 * (instants.back() - t);
  const auto derivative = [&](const OdeState& at, OdeState& rate, double now) {
    deadline.require();
    system.derivative(now, at, efforts(now), rate);
    for (const double value : rate)
      if (!std::isfinite(value)) throw std::runtime_error(fmt::format("derivatives not finite at t = {} s", now));
    if (++out.evaluations % patience != 0) return;
    if (now - since <= least) {
      system.requireSteps(now);
      throw std::runtime_error(fmt::format("the steps shrink to nothing at t = {:.9g} s", now));
    }
    since = now;
  };
  try {
    for (const double instant : instants) {
      while (instant - t > std::numeric_limits<double>::epsilon() * std::abs(instant)) {
        double step = std::min(dt, instant - t);
        const bool cut = step < dt;
        const auto outcome = stepper.try_step(derivative, x, t, step);
        dt = cut && outcome == odeint::success ? std::max(dt, step) : step;
        if (outcome == odeint::success) system.finish(t, x);
      }
      record(instant, x);
    }
  } catch (const std::bad_alloc&) {
    throw;  // a lack of memory says nothing about the motion
  } catch (const std::exception& error) {
    out.gave_up = error.what();  // the completed part is still reported
  }
  return out;
}

}  // namespace ursula

#include "validation/integration_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "model/simbody_loop.h"
#include "validation/subject.h"

namespace ursula {
namespace {

namespace odeint = boost::numeric::odeint;
using OdeState = std::vector<double>;

constexpr double nominal_order = 8;
/// What a machine's own scales leave open over steps that are short but not yet vanishing; methods of order 6 and less
/// are farther off.
constexpr double largest_distance = 2;
/// Differences below this, in natural units, may be rounding; above the other, steps are too long to show an order.
constexpr double least_difference = 1e-11, most_difference = 1e-5;
/// Stretches that are tried, in natural units of time: from the longest on, each so much shorter.
constexpr double longest = 4, shorter = 0.75;
constexpr int attempts = 20;

Manipulator frictionless(const Manipulator& manipulator) {
  ManipulatorParameters machine = manipulator.parameters();
  for (Leg& leg : machine.legs) {
    leg.friction = {};
    leg.coulomb = {};
  }
  return Manipulator(machine);
}

/// The loop let go from the commanded state at the start of the motion.
template <class Stepper>
class LetGo {
 public:
  explicit LetGo(const Scenario& scenario)
      : machine_(frictionless(*scenario.manipulator)), loop_(machine_), start_(scenario.trajectory->at(0)) {
    // As if to accelerate by a natural unit or so every way: else a motion from rest would stay there.
    Motion<double> pushed = start_;
    pushed.p_ddot += Vector3d(0.3, -0.4, 0.5);
    pushed.omega_dot += Vector3d(0.4, 0.3, -0.5);
    torques_ = nocSubject(machine_, nullptr).torques(pushed);
  }

  /// Between the ends with 4 and 8 steps, and with 8 and 16; infinite where the machine flies apart.
  std::pair<double, double> differences(double duration) {
    try {
      const OdeState coarse = endOf(duration, 4), middle = endOf(duration, 8), fine = endOf(duration, 16);
      return {distance(coarse, middle), distance(middle, fine)};
    } catch (const std::exception&) {
      constexpr double none = std::numeric_limits<double>::infinity();
      return {none, none};
    }
  }

 private:
  static double distance(const OdeState& a, const OdeState& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return std::sqrt(sum);
  }

  OdeState endOf(double duration, int steps) {
    loop_.place(start_);
    OdeState x = loop_.state();
    Stepper stepper;
    const double h = duration / steps;
    for (int k = 0; k < steps; ++k)
      stepper.do_step([this](const OdeState& at, OdeState& rate,
                             double t) { loop_.derivative(t, at.data(), torques_, rate.data()); },
                      x, k * h, h);
    return x;
  }

  Manipulator machine_;
  SimbodyLoop loop_;
  Motion<double> start_;
  Vector6d torques_;
};

template <class Stepper>
Check judgeOrderOf(const Scenario& scenario) {
  static constexpr const char* check = "integration.order";
  LetGo<Stepper> loop(scenario);
  double nearest = std::nan(""), found_at = 0, duration = longest;
  for (int attempt = 0; attempt < attempts; ++attempt, duration *= shorter) {
    const auto [first, second] = loop.differences(duration);
    if (second < least_difference) break;  // and the more so over less
    if (!(first <= most_difference)) continue;
    const double order = std::log2(first / second);
    if (std::isnan(nearest) || std::abs(order - nominal_order) < std::abs(nearest - nominal_order)) {
      nearest = order;
      found_at = duration;
    }
    if (std::abs(order - nominal_order) <= largest_distance / 4) break;
  }
  if (std::isnan(nearest))
    return notJudgeable(Reason::limit_useless, check, nearest, largest_distance, "",
                        "as far as steps that have not vanished leave it open",
                        "no stretch of the motion is between rounding and steps too long to show an order");
  return judged(check, std::abs(nearest - nominal_order), largest_distance, "",
                "as far as steps that have not vanished leave it open; of order 6 and less is farther",
                fmt::format("observed order {:.3g}, of {:g}, by halving fixed steps twice over {:.3g} natural units of "
                            "time, without friction and load",
                            nearest, nominal_order, found_at));
}

}  // namespace

Check judgeOrder(const Scenario& scenario, bool lower) {
  return lower ? judgeOrderOf<odeint::runge_kutta_dopri5<OdeState>>(scenario)
               : judgeOrderOf<odeint::runge_kutta_fehlberg78<OdeState>>(scenario);
}

}  // namespace ursula

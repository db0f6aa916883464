#include "validation/replay/observed_order.h"

#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <new>
#include <optional>
#include <vector>

#include "model/manipulator.h"
#include "simbody/simbody_loop.h"
#include "validation/replay/replay.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

namespace odeint = boost::numeric::odeint;
using OdeState = std::vector<double>;

/// Larger differences, in natural units, mean that steps are too long for an order.
constexpr double most_difference = 1e-3;
/// Differences below this multiple of the start's propagated rounding may be rounding.
constexpr double above_noise = 3;
/// Stretches to try, in natural units of time: the longest, and the ratio of successive ones.
constexpr double longest_stretch = 8, shorter = 0.9;
constexpr int attempts = 90;
/// Number of stretches that give an order; twice as many if these leave it open.
constexpr std::size_t most_stretches = 12;

/// The loop released from the commanded state at the start of the motion.
template <class Stepper>
class LetGo {
 public:
  LetGo(const Scenario& scenario, const Deadline& deadline)
      : deadline_(deadline),
        machine_(frictionless(*scenario.manipulator)),
        loop_(machine_),
        start_(scenario.trajectory->at(0)) {
    // These torques give about a natural unit of acceleration in every direction; otherwise a motion from rest would
    // stay there.
    Motion<double> pushed = start_;
    pushed.p_ddot += Vector3d(0.3, -0.4, 0.5);
    pushed.omega_dot += Vector3d(0.4, 0.3, -0.5);
    torques_ = nocSubject(machine_, nullptr).torques(pushed);
  }

  /// The change of the end due to rounding of the start's coordinates.
  double noise(double duration) {
    double out = 0;
    const std::optional<OdeState>& end = reached(duration, 16);
    if (!end) return std::numeric_limits<double>::infinity();
    for (unsigned pattern = 1; pattern <= 3; ++pattern) out = larger(out, distance(*end, endOf(duration, 16, pattern)));
    return out;
  }

  /// The end after `steps` steps; nullopt if the machine flies apart.
  const std::optional<OdeState>& reached(double duration, int steps) {
    const auto [known, is_new] = reached_.try_emplace({duration, steps});
    if (is_new) try {
        known->second = endOf(duration, steps);
      } catch (const std::exception& error) {
        if (!isShortage(error)) return known->second;
        reached_.erase(known);
        throw;
      }
    return known->second;
  }

  /// The distance of two ends; infinite if one is missing.
  static double difference(const std::optional<OdeState>& a, const std::optional<OdeState>& b) {
    return a && b ? distance(*a, *b) : std::numeric_limits<double>::infinity();
  }

 private:
  static double distance(const OdeState& a, const OdeState& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return std::sqrt(sum);
  }

  /// The end; a `pattern` selects another rounding of the start.
  OdeState endOf(double duration, int steps, unsigned pattern = 0) {
    loop_.place(start_);
    OdeState x = loop_.state();
    for (std::size_t k = 0; k < x.size() && pattern > 0; ++k)
      x[k] *= 1 + ((k >> pattern) % 2 == 0 ? 1 : -1) * std::numeric_limits<double>::epsilon();
    Stepper stepper;
    const double h = duration / steps;
    for (int k = 0; k < steps; ++k) {
      deadline_.require();
      stepper.do_step([this](const OdeState& at, OdeState& rate,
                             double t) { loop_.derivative(t, at.data(), torques_, rate.data()); },
                      x, k * h, h);
    }
    return x;
  }

  Deadline deadline_;
  Manipulator machine_;
  SimbodyLoop loop_;
  Motion<double> start_;
  Vector6d torques_;
  std::map<std::pair<double, int>, std::optional<OdeState>> reached_;  ///< ends that are needed twice
};

/// The first stretch that is short enough; differences fall with its ninth power.
template <class Stepper>
int firstStretch(LetGo<Stepper>& loop) {
  int too_long = -1, short_enough = attempts;
  while (short_enough - too_long > 1) {
    const int k = (too_long + short_enough) / 2;
    const double duration = longest_stretch * std::pow(shorter, k);
    const double difference = loop.difference(loop.reached(duration, 4), loop.reached(duration, 8));
    (difference <= most_difference ? short_enough : too_long) = k;
  }
  return short_enough;
}

bool leaveItOpen(const std::vector<double>& orders) {
  return nominal_order - bestOrder(orders) > largest_shortfall && !haveSettled(orders);
}

/// The observed order of each stretch, the longest first.
template <class Stepper>
std::vector<double> ordersOf(const Scenario& scenario, const Deadline& deadline) {
  LetGo<Stepper> loop(scenario, deadline);
  std::vector<double> orders;
  double duration = longest_stretch * std::pow(shorter, firstStretch(loop));
  const double noise = above_noise * loop.noise(duration);  // longer stretches have more noise
  for (; orders.size() < most_stretches || (orders.size() < 2 * most_stretches && leaveItOpen(orders));
       duration *= shorter) {
    const auto &four = loop.reached(duration, 4), &eight = loop.reached(duration, 8),
               &more = loop.reached(duration, 16);
    const double first = loop.difference(four, eight), second = loop.difference(eight, more);
    if (!(second >= noise)) break;  // shorter stretches have even less
    if (first <= most_difference) orders.push_back(std::log2(first / second));
  }
  return orders;
}

}  // namespace

double bestOrder(const std::vector<double>& orders) {
  return *std::max_element(orders.begin() + static_cast<std::ptrdiff_t>(orders.size() / 2), orders.end());
}

bool haveSettled(const std::vector<double>& orders) {
  if (orders.size() < settled_over) return false;
  const auto [least, most] = std::minmax_element(orders.end() - settled_over, orders.end());
  return *most - *least <= settled;
}

std::vector<double> observedOrders(const Scenario& scenario, bool lower, const Deadline& deadline) {
  return lower ? ordersOf<odeint::runge_kutta_dopri5<OdeState>>(scenario, deadline)
               : ordersOf<odeint::runge_kutta_fehlberg78<OdeState>>(scenario, deadline);
}

}  // namespace ursula

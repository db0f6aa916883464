#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <memory>

#include "parts/causes/tried_causes.h"
#include "validation/limits/conditioning.h"

namespace ursula {
namespace {

template <int size>
using Series = std::vector<Eigen::Matrix<double, size, 1>>;

/// How a derivative is made of neighbours. Central differences are one-sided at the ends, or of second order there too.
enum class Scheme { central, central_of_second_order, forward, backward };
constexpr std::pair<Scheme, const char*> schemes[] = {{Scheme::central, "central ones, one-sided at the ends"},
                                                      {Scheme::central_of_second_order, "of second order"},
                                                      {Scheme::forward, "to the next instant"},
                                                      {Scheme::backward, "from the instant before"}};

/// The slope at t[at] of the parabola through the instants k − 1, k, k + 1.
template <int size>
Eigen::Matrix<double, size, 1> parabolaSlope(const std::vector<double>& t, const Series<size>& f, std::size_t k,
                                             std::size_t at) {
  const double a = t[k - 1], b = t[k], c = t[k + 1], x = t[at];
  return f[k - 1] * ((2 * x - b - c) / ((a - b) * (a - c))) + f[k] * ((2 * x - a - c) / ((b - a) * (b - c))) +
         f[k + 1] * ((2 * x - a - b) / ((c - a) * (c - b)));
}

template <int size>
Series<size> derivative(const std::vector<double>& t, const Series<size>& f, Scheme scheme) {
  Series<size> out;
  const std::size_t last = t.size() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    const bool inside = k > 0 && k < last;
    if (scheme == Scheme::central_of_second_order || (scheme == Scheme::central && inside)) {
      out.push_back(parabolaSlope<size>(t, f, std::clamp<std::size_t>(k, 1, last - 1), k));
      continue;
    }
    const bool back = k == last || (scheme == Scheme::backward && k > 0);
    const std::size_t i = back ? k - 1 : k;
    out.push_back((f[i + 1] - f[i]) / (t[i + 1] - t[i]));
  }
  return out;
}

/// The motion at all instants.
struct Table {
  std::vector<double> t;
  Series<3> p, v, w, a, alpha;
  Series<4> q;  ///< w, x, y, z without jumps of the sign

  Table(const Scenario& scenario, const std::vector<double>& instants) : t(instants) {
    for (const double instant : t) {
      const Motion<double> motion = scenario.trajectory->at(instant);
      const Eigen::Quaterniond turn(motion.Q);
      Eigen::Vector4d next(turn.w(), turn.x(), turn.y(), turn.z());
      if (!q.empty() && next.dot(q.back()) < 0) next = -next;
      p.push_back(motion.p), q.push_back(next);
      v.push_back(motion.p_dot), w.push_back(motion.omega);
      a.push_back(motion.p_ddot), alpha.push_back(motion.omega_dot);
    }
  }

  /// ω = 2 q̇ q*.
  Series<3> turning(Scheme scheme) const {
    Series<3> out;
    const Series<4> rates = derivative<4>(t, q, scheme);
    for (std::size_t k = 0; k < q.size(); ++k) {
      const Vector3d of = q[k].tail<3>(), rate = rates[k].tail<3>();
      out.push_back(2 * (q[k](0) * rate - rates[k](0) * of + of.cross(rate)));
    }
    return out;
  }

  void put(Motion<double>& motion) const {
    const std::size_t k = std::lower_bound(t.begin(), t.end(), motion.t) - t.begin();
    motion.p_dot = v[k], motion.omega = w[k];
    motion.p_ddot = a[k], motion.omega_dot = alpha[k];
  }

  double shortest() const {
    double out = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k + 1 < t.size(); ++k) out = std::min(out, t[k + 1] - t[k]);
    return out;
  }
};

/// What is differentiated.
struct Taken {
  const char* words;
  bool velocity, turning, acceleration, turning_rate;
};
constexpr Taken all_taken[] = {
    {"accelerations taken from differences of the velocities", false, false, true, true},
    {"the acceleration of P taken from differences of its velocity", false, false, true, false},
    {"the angular acceleration taken from differences of omega", false, false, false, true},
    {"velocity and accelerations taken from differences of P and omega", true, false, true, true},
    {"velocities and accelerations taken from differences of the poses", true, true, true, true}};

Table differenced(Table table, const Taken& taken, Scheme scheme) {
  if (taken.velocity) table.v = derivative<3>(table.t, table.p, scheme);
  if (taken.turning) table.w = table.turning(scheme);
  if (taken.acceleration) table.a = derivative<3>(table.t, table.v, scheme);
  if (taken.turning_rate) table.alpha = derivative<3>(table.t, table.w, scheme);
  return table;
}

/// Rounding of the efforts, N·m, from that of differences over `step`: of a pose twice, of a velocity, of an instant.
double roundingOf(const Scenario& scenario, const Motion<double>& motion, const Taken& taken, double step) {
  constexpr double units = 8 * std::numeric_limits<double>::epsilon();
  const Manipulator machine = withoutStroke(*scenario.manipulator);
  const Subject noc = nocSubject(machine, scenario.load);
  const double velocity = motion.p_dot.norm() + motion.omega.norm();
  const double acceleration = motion.p_ddot.norm() + motion.omega_dot.norm();
  double little = units * (velocity + acceleration * motion.t) / step;
  if (taken.velocity) little += units * (1 + motion.p.norm() + velocity * motion.t) / (step * step);
  const Vector6d right = noc.torques(motion);
  double out = ConditioningProbe(machine, scenario.load).at(motion).torqueRounding();
  for (int k = 0; k < 3; ++k)
    for (Vector3d Motion<double>::*of : {&Motion<double>::p_ddot, &Motion<double>::omega_dot}) {
      Motion<double> near = motion;
      (near.*of)(k) += little;
      out += (noc.torques(near) - right).cwiseAbs().maxCoeff();
    }
  return out;
}

}  // namespace

void addDifferenceCauses(const std::vector<double>& instants, TriedCauses& out) {
  constexpr std::size_t fewest = 5, most = 20000;
  if (instants.size() < fewest || instants.size() > most) return;
  const Table right(out.scenario, instants);
  const double step = right.shortest();
  if (!(step > 0)) return;
  for (const Taken& taken : all_taken)
    for (const auto& [scheme, words] : schemes) {
      const auto table = std::make_shared<const Table>(differenced(right, taken, scheme));
      Cause& cause = out.addReading(CauseName(fmt::format("{} between the given instants, {}", taken.words, words)),
                                    [table](Motion<double>& motion) { table->put(motion); });
      cause.rounding = [&scenario = out.scenario, &taken, step](const Motion<double>& motion) {
        return roundingOf(scenario, motion, taken, step);
      };
    }
}

}  // namespace ursula

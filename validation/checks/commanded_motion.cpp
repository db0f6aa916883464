#include "validation/checks/judges.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/real50.h"
#include "nocsolver/noc/noc.h"
#include "validation/limits/conditioning.h"

namespace ursula {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr int highest = 5;  ///< highest derivative: motions are quintics, or functions of one

using Real = Vector3<Real50>;
using RealMatrix = Matrix3<Real50>;

/// The way in which a trajectory's poses are differentiated: in 50 digits if it has them, else in doubles. The step in
/// doubles makes (1/512)⁶ of a seventh derivative smaller than eps; the remaining error is measured.
struct Differences {
  bool exact;
  Real50 share;   ///< step as a share of a piece; a power of two for instants in doubles
  double digits;  ///< rounding error of a pose
  explicit Differences(const Trajectory& trajectory)
      : exact(trajectory.exact() != nullptr),
        share(exact ? Real50("1e-7") : Real50(1) / 512),
        digits(exact ? static_cast<double>(std::numeric_limits<Real50>::epsilon()) : eps) {}
};

Motion<Real50> widest(const Trajectory& trajectory, const Real50& t) {
  if (trajectory.exact() != nullptr) return trajectory.at(t);
  const Motion<double> motion = trajectory.at(static_cast<double>(t));
  Motion<Real50> out;
  out.p = motion.p.cast<Real50>();
  out.Q = motion.Q.cast<Real50>();
  return out;
}

/// Seven poses of a trajectory around one instant, `step` apart.
struct Stencil {
  Real50 step;
  std::array<Real, 7> p;
  std::array<RealMatrix, 7> Q;

  Stencil(const Trajectory& trajectory, const Real50& t, const Real50& step_) : step(step_) {
    for (int j = -3; j <= 3; ++j) {
      const Motion<Real50> motion = widest(trajectory, Real50(t + j * step));
      p[j + 3] = motion.p;
      Q[j + 3] = motion.Q;
    }
  }

  /// Central differences, of order h⁶ for the first two derivatives and h⁴ or h² for the others.
  template <class V>
  V derivative(const std::array<V, 7>& values, int order) const {
    constexpr int weights[highest][7] = {{-1, 9, -45, 0, 45, -9, 1},
                                         {2, -27, 270, -490, 270, -27, 2},
                                         {1, -8, 13, 0, -13, 8, -1},
                                         {-1, 12, -39, 56, -39, 12, -1},
                                         {-1, 4, -5, 0, 5, -4, 1}};
    constexpr int divisors[highest] = {60, 180, 8, 6, 2};
    V sum = V::Zero();
    Real50 divisor(divisors[order - 1]);
    for (std::size_t j = 0; j < 7; ++j)
      if (weights[order - 1][j] != 0) sum += weights[order - 1][j] * values[j];
    for (int k = 0; k < order; ++k) divisor *= step;
    return sum / divisor;
  }
};

double sizeOf(const Real& v) { return static_cast<double>(v.norm()); }
/// The size of the rotation: [ω]Q has the norm √2 |ω|.
double sizeOf(const RealMatrix& m) { return static_cast<double>(m.norm()) / std::sqrt(2.0); }

Real axis(const RealMatrix& m) { return Real(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)) / Real50(2); }

/// Sizes of the derivatives at the start of a piece: the terms that a double evaluation adds.
struct PieceSizes {
  std::array<double, highest + 1> p{}, Q{};

  explicit PieceSizes(const Stencil& start) {
    p[0] = sizeOf(start.p[3]);
    for (int k = 1; k <= highest; ++k) {
      p[k] = sizeOf(start.derivative(start.p, k));
      Q[k] = sizeOf(start.derivative(start.Q, k));
    }
  }
};

/// Σ |f⁽ᵏ⁾(start)| τ^(k−m) / (k−m)!: the m-th derivative at τ after the start, with magnitudes added.
double terms(const std::array<double, highest + 1>& sizes, std::size_t m, double tau) {
  double sum = 0, factor = 1;
  for (std::size_t k = m; k <= highest; ++k) {
    sum += sizes[k] * factor;
    factor *= tau / static_cast<double>(k - m + 1);
  }
  return sum;
}

/// Derivatives of the 50-digit pose: Q̇ Qᵀ = [ω], and Q̈ Qᵀ = [ω̇] + [ω]², where the second term is symmetric.
struct ExactPieces {
  Real p, v, a, omega, alpha;
  RealMatrix Q;

  explicit ExactPieces(const Stencil& stencil)
      : p(stencil.p[3]),
        v(stencil.derivative(stencil.p, 1)),
        a(stencil.derivative(stencil.p, 2)),
        omega(axis(stencil.derivative(stencil.Q, 1) * stencil.Q[3].transpose())),
        alpha(axis(stencil.derivative(stencil.Q, 2) * stencil.Q[3].transpose())),
        Q(stencil.Q[3]) {}
};

/// The rounding of a double evaluation. A motion is a quintic of s = (t − start)/h by Horner's rule, or a few more
/// operations on one (sine and cosine of a helix's angle, a quaternion over its norm). One term of the quintic suffers
/// these roundings of eps/2: 1 of its coefficient, 2 of factors k(k − 1), 10 of Horner's rule, 15 of s, which is off by
/// 3 and enters five times, 3 of the division by h². At most 19 follow in either kernel (ω of a quaternion: 7 for the
/// product, 8 for |r|², 2 more). In all 50, thus 25 eps. Let Pₘ, Aₘ be the sums `terms` for p and Q, and A = 1 + A₀ +
/// the hidden angle, to which a helix's angle is rounded:
///   p: |p| + P₀ + hidden length    Q: A
///   v: P₁ + |v| A                  ω: A₁ + |ω| A
///   a: P₂ + 2 |v| A₁ + 2 |a| A     α: A₂ + 2 |ω| A₁ + |α| A
/// These terms appear because an angle off by δ turns v by δ, and because n β̇², m β̈ and (r·ṙ) ω are products of two
/// rounded factors. Differences in 50 digits add the rounding of seven poses over step^m, with weights that sum to less
/// than 10. Their truncation, (1e-7)⁶ of a seventh derivative, is far below eps. For differences of doubles see
/// widenedBy.
struct Limits {
  double p, Q, v, omega, a, alpha;
};

Limits limitsAt(const ExactPieces& exact, const PieceSizes& sizes, double tau, const HiddenTerms& hidden, double step,
                double rounding) {
  const double P_1 = terms(sizes.p, 1, tau), P_2 = terms(sizes.p, 2, tau);
  const double A_1 = terms(sizes.Q, 1, tau), A_2 = terms(sizes.Q, 2, tau);
  const double A = 1 + terms(sizes.Q, 0, tau) + hidden.angle;
  const double v = sizeOf(exact.v), a = sizeOf(exact.a), p = sizeOf(exact.p) + terms(sizes.p, 0, tau);
  const double omega = sizeOf(exact.omega), alpha = sizeOf(exact.alpha);
  const double unit = rounding_depth * eps;
  const double digits = 10 * rounding_depth * rounding;
  const double first = digits / step, second = first / step;
  return {unit * (p + hidden.length),
          unit * A,
          unit * (P_1 + v * A) + first * (p + hidden.length),
          unit * (A_1 + omega * A) + first * A,
          unit * (P_2 + 2 * v * A_1 + 2 * a * A) + second * (p + hidden.length),
          unit * (A_2 + 2 * omega * A_1 + alpha * A) + second * A};
}

/// Differences of doubles also have a truncation error: twice the change from halving the step. Their instants are
/// rounded by t eps, which moves the poses by |v| t eps.
Limits widenedBy(const ExactPieces& exact, const ExactPieces& halved, Limits limits, double t, double step) {
  const double moved = 10 * eps * t / step;
  limits.v += 2 * sizeOf(Real(exact.v - halved.v)) + moved * sizeOf(exact.v);
  limits.omega += 2 * sizeOf(Real(exact.omega - halved.omega)) + moved * sizeOf(exact.omega);
  limits.a += 2 * sizeOf(Real(exact.a - halved.a)) + moved / step * sizeOf(exact.v);
  limits.alpha += 2 * sizeOf(Real(exact.alpha - halved.alpha)) + moved / step * sizeOf(exact.omega);
  return limits;
}

/// The deviations nearest to their limits; `where` is 0 for the point, 1 for the orientation, 2 for orthonormality.
struct Deviations {
  WorstShare pose, twist, twist_rate;
  int instants = 0;
};

template <class Read, class Exact>
double distance(const Read& read, const Exact& exact) {
  return static_cast<double>((read.template cast<Real50>() - exact).norm());
}

void compare(const Motion<double>& motion, const ExactPieces& exact, const Limits& limits, double length,
             Deviations& out) {
  const double t = motion.t;
  out.pose.add(distance(motion.p, exact.p), limits.p, t, 0);
  out.pose.add(length * distance(motion.Q, exact.Q) / std::sqrt(2.0), length * limits.Q, t, 1);
  const Matrix3d product = motion.Q.transpose() * motion.Q - Matrix3d::Identity();
  const double turned = motion.Q.determinant() > 0 ? product.norm() : 2;
  out.pose.add(length * turned, length * rounding_depth * eps, t, 2);
  out.twist.add(distance(motion.p_dot, exact.v), limits.v, t, 0);
  out.twist.add(length * distance(motion.omega, exact.omega), length * limits.omega, t, 1);
  out.twist_rate.add(distance(motion.p_ddot, exact.a), limits.a, t, 0);
  out.twist_rate.add(length * distance(motion.omega_dot, exact.alpha), length * limits.alpha, t, 1);
  ++out.instants;
}

/// Uses some 60 stencils for any number of pieces, because 50 digits are expensive. Each lies within a piece, because a
/// higher derivative jumps at knots.
Deviations deviationsOf(const Trajectory& trajectory, double length, const HiddenTerms& hidden) {
  std::vector<double> ends = trajectory.knots();
  if (ends.size() < 2) ends = {0, trajectory.duration()};
  constexpr std::size_t most_pieces = 30, stencils = 60;
  const std::size_t pieces = ends.size() - 1, looked_at = std::min(pieces, most_pieces);
  const Differences differences(trajectory);
  const double margin = differences.exact ? 0 : 3 * static_cast<double>(differences.share);
  Deviations out;
  for (std::size_t j = 0; j < looked_at; ++j) {
    const std::size_t i = looked_at == 1 ? 0 : j * (pieces - 1) / (looked_at - 1);
    const double start = ends[i], h = ends[i + 1] - ends[i];
    const Real50 step = Real50(h) * differences.share;
    const PieceSizes sizes(Stencil(trajectory, start + 3 * step, step));
    for (std::size_t k = 0; k + 1 < stencils / looked_at; ++k) {
      // Multiples of the golden ratio spread over the pieces and differ in each.
      const double spread = std::fmod(0.381966 + 0.618034 * out.instants, 1.0);
      const double share = margin + (1 - 2 * margin) * spread, t = start + h * share;
      const ExactPieces exact(Stencil(trajectory, t, step));
      Limits limits = limitsAt(exact, sizes, h * share, hidden, static_cast<double>(step), differences.digits);
      if (!differences.exact) {
        const ExactPieces halved(Stencil(trajectory, t, Real50(step / 2)));
        limits = widenedBy(exact, halved, limits, t, static_cast<double>(step));
      }
      compare(trajectory.at(t), exact, limits, length, out);
    }
  }
  return out;
}

Check judgedAs(const std::string& name, const WorstShare& shown, const std::string& unit, const std::string& what,
               int instants, bool exact) {
  static constexpr std::array<const char*, 3> parts{"point P", "orientation, times the machine's length",
                                                    "Q'Q - 1, times the machine's length"};
  if (!shown.any) return notMade(name, unit, "no instant was compared");
  const std::string doubles =
      exact ? "" : "; 250 eps over the step, to the order of the derivative, and twice what halving the step changes";
  const auto part = [](int where) { return parts[where]; };
  Check check = judged(
      name, shown.value, shown.limit, unit,
      "25 eps x the sum of its terms in powers of (t - start)/h, and the effect of an angle's rounding" + doubles,
      fmt::format("{}, at {} instants; shown for t = {:.6g} s, {}", what, instants, shown.t, part(shown.where)));
  check.largest = {shown.largest, shown.largest_t, part(shown.largest_where)};
  return check;
}

}  // namespace

std::vector<Check> judgeTrajectory(const Trajectory& trajectory, double length, const HiddenTerms& hidden) {
  const Deviations found = deviationsOf(trajectory, length, hidden);
  const bool exact = trajectory.exact() != nullptr;
  const std::string digits = exact ? "the 50-digit pose" : "the pose in doubles";
  const std::string pose =
      exact ? "the pose in doubles against the pose in 50 digits" : "Q'Q = 1; no 50 digits are known";
  return {judgedAs("motion.pose", found.pose, "m", pose, found.instants, exact),
          judgedAs("motion.twist", found.twist, "m/s", "v and omega against differences of " + digits, found.instants,
                   exact),
          judgedAs("motion.twist_rate", found.twist_rate, "m/s^2",
                   "a and alpha against second differences of " + digits, found.instants, exact)};
}

std::vector<Check> judgeCommandedMotion(const Scenario& scenario) {
  const ExactTrajectory* exact = scenario.isAsRead() ? scenario.trajectory->exact() : nullptr;
  const double length = MachineParameters<double>(*scenario.manipulator).length;
  std::vector<Check> checks =
      judgeTrajectory(*scenario.trajectory, length, exact == nullptr ? HiddenTerms() : exact->hiddenTerms());
  if (scenario.load) checks.push_back(judgeLoad(*scenario.load, scenario.trajectory->duration()));
  return checks;
}

}  // namespace ursula

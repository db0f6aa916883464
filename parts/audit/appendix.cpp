// (49)–(55) and ω of the Appendix, for a helix that starts and ends in motion, unlike the example.

#include <Eigen/Geometry>
#include <limits>

#include "parts/audit/formula.h"

namespace ursula::audit {
namespace {

/// Data of the helix: the example's, but with rates at both ends and both phases.
struct Helix {
  S a{"0.2"}, b{"1.2"}, omega{"0.3"}, omega_bar{"2.2"}, t_f{3};
  S beta_0{"-1.57"}, rate_0{"0.4"}, acceleration_0{"-0.7"};
  S beta_f{"-1.05"}, rate_f{"-0.6"}, acceleration_f{"0.9"};

  /// (51)
  std::array<S, 6> coefficients() const {
    const S T = t_f, T2 = T * T;
    return {
        beta_0,
        rate_0,
        acceleration_0 / 2,
        (20 * beta_f - 20 * beta_0 - (8 * rate_f + 12 * rate_0) * T - (3 * acceleration_0 - acceleration_f) * T2) /
            (2 * T2 * T),
        (30 * beta_0 - 30 * beta_f + (14 * rate_f + 16 * rate_0) * T + (3 * acceleration_0 - 2 * acceleration_f) * T2) /
            (2 * T2 * T2),
        (12 * beta_f - 12 * beta_0 - (6 * rate_f + 6 * rate_0) * T - (acceleration_0 - acceleration_f) * T2) /
            (2 * T2 * T2 * T)};
  }
  /// β of (50), and its rates (53) from their first non-zero terms.
  S beta(const S& t) const {
    return sum(
        t, [](int) { return 1; }, 0);
  }
  S rate(const S& t) const {
    return sum(
        t, [](int k) { return k; }, 1);
  }
  S acceleration(const S& t) const {
    return sum(
        t, [](int k) { return k * (k - 1); }, 2);
  }

  /// (49)
  V p(const S& at) const { return V(a * cos(at + omega), a * sin(at + omega), b * (at + omega_bar)); }
  V m(const S& at) const { return V(-a * sin(at + omega), a * cos(at + omega), b); }
  V n(const S& at) const { return V(-a * cos(at + omega), -a * sin(at + omega), S(0)); }
  /// (54), (55)
  M Q(const S& at) const {
    const V e_t = m(at) / sqrt(a * a + b * b), e_n = n(at) / a;
    M frame;
    frame << -e_t.cross(e_n), e_n, e_t;
    return frame;
  }

 private:
  template <class Factor>
  S sum(const S& t, Factor factor, int first) const {
    S total(0), power(1);
    const std::array<S, 6> c = coefficients();
    for (int k = first; k <= 5; ++k, power *= t) total += factor(k) * c[static_cast<std::size_t>(k)] * power;
    return total;
  }
};

using Scalar = Eigen::Matrix<S, 1, 1>;

Derivatives<Scalar> betaByDifferences(const S& t) {
  const Helix helix;
  return differentiated([&](const S& dt) { return Scalar(helix.beta(t + dt)); }, S("1e-5"));
}

using Flat = Eigen::Matrix<S, 9, 1>;

/// ω and ω̇ of the helix's frame, by differences.
Values spin(At at) {
  const auto d = differentiated(
      [&](const S& dt) {
        const M Q = Helix().Q(Helix().beta(at.t + dt));
        return Flat(Eigen::Map<const Flat>(Q.data()));
      },
      S("1e-5"));
  const M Q = Eigen::Map<const M>(d.value.data()), Q_dot = Eigen::Map<const M>(d.first.data());
  const M Q_ddot = Eigen::Map<const M>(d.second.data());
  return values(vect(Q_dot * Q.transpose()), vect(Q_ddot * Q.transpose() + Q_dot * Q_dot.transpose()));
}

/// The rates of p by (52), and by differences.
Values ratesBy52(At at) {
  const Helix h;
  const S beta = h.beta(at.t), rate = h.rate(at.t);
  return values(V(h.m(beta) * rate), V(h.m(beta) * h.acceleration(at.t) + h.n(beta) * (rate * rate)));
}
Values ratesByDifferences(At at) {
  const Helix h;
  const auto d = differentiated([&](const S& dt) { return h.p(h.beta(at.t + dt)); }, S("1e-5"));
  return values(d.first, d.second);
}

/// β with its rates at both ends, by differences.
Values betaAtEnds(At) {
  const auto start = betaByDifferences(S(0)), end = betaByDifferences(Helix().t_f);
  return values(start.value, start.first, start.second, end.value, end.first, end.second);
}

Values orthonormality(At at) {
  const M Q = Helix().Q(Helix().beta(at.t));
  return values(M(Q.transpose() * Q), S(Q.col(0).cross(Q.col(1)).dot(Q.col(2))));
}

/// β̇ at t = 0 if the sum of (53) begins at k = 0, where the term is 0 · t⁻¹.
Values rateFromZero(At) {
  S total(0);
  for (int k = 0; k <= 5; ++k) total += k * Helix().coefficients()[static_cast<std::size_t>(k)] * pow(S(0), k - 1);
  return values(total);
}

}  // namespace

std::vector<Formula> appendixFormulas() {
  return {{"(49), (52)", "m/s, m/s²", {"p; ṗ = m β̇, p̈ = m β̈ + n β̇²", ratesBy52}, {}, ratesByDifferences},
          {"(50), (51)",
           "rad, rad/s, rad/s²",
           {"β = Σ a_k t^k with a_0 … a_5", betaAtEnds},
           {},
           [](At) {
             const Helix h;
             return values(h.beta_0, h.rate_0, h.acceleration_0, h.beta_f, h.rate_f, h.acceleration_f);
           },
           "Angle, rate and acceleration at both ends, none of them zero."},
          {"(53)",
           "rad/s, rad/s²",
           {"β̇ = Σ k a_k t^(k−1), β̈ = Σ k(k−1) a_k t^(k−2)",
            [](At at) { return values(Helix().rate(at.t), Helix().acceleration(at.t)); }},
           {},
           [](At at) {
             const auto d = betaByDifferences(at.t);
             return values(d.first, d.second);
           }},
          {"(54), (55)",
           "",
           {"Q = [−e_b, e_n, e_t]", orthonormality},
           {},
           [](At) { return values(M(M::Identity()), S(1)); }},
          {"Appendix ω",
           "rad/s, rad/s²",
           {"ω = β̇ e_z, ω̇ = β̈ e_z",
            [](At at) { return values(V(S(0), S(0), Helix().rate(at.t)), V(S(0), S(0), Helix().acceleration(at.t))); }},
           {},
           spin},
          {"(53) k = 0",
           "rad/s",
           {"sums from k = 0: the first terms are 0·a_0 t⁻¹, 0·a_0 t⁻²", rateFromZero},
           {"sums from k = 1 and k = 2", [](At) { return values(Helix().rate(S(0))); }},
           [](At) { return values(Helix().rate_0); },
           "Taken to the letter in floating point, β̇ at t = 0 is not a number.",
           {},
           false,
           true},
          misprint("(54) e_i", "e_i = m/(a² + b²)^½", "e_t = m/(a² + b²)^½",
                   "The subscript; e_t is used beside it and in (55).")};
}

}  // namespace ursula::audit

// (39)–(44): the motion of the bodies.

#include <Eigen/Geometry>

#include "parts/audit/formula.h"

namespace ursula::audit {
namespace {

/// [e] and [s] of (39) from the angles of (9), with their derivatives (42).
struct Direction {
  V value, rate, acceleration;
};

Direction direction(const S& angle, const S& rate, const S& acceleration) {
  const S c = cos(angle), s = sin(angle);
  return {V(S(0), c, s), V(S(0), -s, c) * rate, V(S(0), -s, c) * acceleration - V(S(0), c, s) * (rate * rate)};
}

Direction e(Of leg) { return direction(leg.at.psi(), leg.dot.psi(), leg.ddot.psi()); }

Direction s(Of leg) {
  const Direction s =
      direction(leg.at.psi() + leg.at.theta(), leg.dot.psi() + leg.dot.theta(), leg.ddot.psi() + leg.ddot.theta());
  return {-s.value, -s.rate, -s.acceleration};
}

/// l[e] + σ[s], or the same of one of their derivatives.
V toDistal(Of leg, V Direction::*of) { return leg.l * e(leg).*of + leg.sigma * s(leg).*of; }

/// [x, axis × x, axis] as its product with its transpose, and its determinant.
Values orthonormality(const V& x, const V& axis) {
  M G;
  G << x, axis.cross(x), axis;
  return values(M(G.transpose() * G), S(G.col(0).cross(G.col(1)).dot(G.col(2))));
}

V proximalAcceleration(Of leg) {
  const M Omega = leg.Omega_i(), Q = leg.Q_i();
  return leg.rho * (leg.Q_hat * V((leg.Omega_i_dot() + Omega * Omega) * Q * e(leg).value + 2 * Omega * Q * e(leg).rate +
                                  Q * e(leg).acceleration));
}

/// (43b) with any of its three errors.
struct ReadingOf43b {
  bool omega_dot_squared, sigma_added, last_term_twice;
};

V distalAcceleration(Of leg, const ReadingOf43b& reading) {
  const M Omega = leg.Omega_i(), Omega_dot = leg.Omega_i_dot(), Q = leg.Q_i();
  const M squared = reading.omega_dot_squared ? M(Omega_dot * Omega_dot) : M(Omega * Omega);
  const V arm = reading.sigma_added ? V(leg.l * e(leg).value + V(V::Constant(leg.sigma) + s(leg).value))
                                    : toDistal(leg, &Direction::value);
  const V last = Q * toDistal(leg, &Direction::acceleration);
  return leg.Q_hat * V((Omega_dot + squared) * Q * arm + 2 * Omega * Q * toDistal(leg, &Direction::rate) +
                       (reading.last_term_twice ? 2 : 1) * last);
}

Formula distalFormula(const char* equation, const char* printed, const ReadingOf43b& reading, const char* note = "") {
  Formula f = {equation,
               "m/s²",
               {printed, legs([reading](Of leg) { return distalAcceleration(leg, reading); })},
               {"d̈ = Q̂((Ω̇ + Ω²)Q(l[e] + σ[s]) + 2ΩQ(l[ė] + σ[ṡ]) + Q(l[ë] + σ[s̈]))", legs([](Of leg) {
                  return distalAcceleration(leg, {false, false, false});
                })},
               legs([](Of leg) { return leg.ddot.d(); }),
               note};
  if (reading.omega_dot_squared) f.errors.push_back(FormulaError::eq43b_omega_dot);
  if (reading.sigma_added) f.errors.push_back(FormulaError::eq43b_sigma);
  if (reading.last_term_twice) f.errors.push_back(FormulaError::eq43b_doubled);
  return f;
}

Values platformCenter(At at) {
  const ReferencePlatform& m = at.platform;
  const M Omega = crossMatrix(m.omega);
  return values(V(m.p_dot + Omega * m.Q * m.rho),
                V(m.p_ddot + (crossMatrix(m.omega_dot) + Omega * Omega) * m.Q * m.rho));
}

std::vector<Formula> positionsAndVelocities() {
  return {
      {"(39a)",
       "m",
       {"c = a + ρ Q̂Q[e]", legs([](Of leg) { return V(leg.a + leg.rho * (leg.Q_hat * leg.Q_i() * e(leg).value)); })},
       {},
       legs([](Of leg) { return leg.at.c(); })},
      {"(39b)",
       "m",
       {"d = a + Q̂Q(l[e] + σ[s])",
        legs([](Of leg) { return V(leg.a + leg.Q_hat * leg.Q_i() * toDistal(leg, &Direction::value)); })},
       {},
       legs([](Of leg) { return leg.at.d(); })},
      {"(40)",
       "",
       {"G = [x, e × x, e], H = [x, s × x, s]", legs([](Of leg) {
          const M F = leg.Q_hat * leg.Q_i();
          return orthonormality(F.col(0), F * e(leg).value);
        })},
       {},
       legs([](Of) { return values(M(M::Identity()), S(1)); }),
       "Orthonormal and right-handed."},
      {"(41a)",
       "m/s",
       {"ċ = ρ Q̂(ΩQ[e] + Q[ė])", legs([](Of leg) {
          return V(leg.rho * (leg.Q_hat * V(leg.Omega_i() * leg.Q_i() * e(leg).value + leg.Q_i() * e(leg).rate)));
        })},
       {},
       legs([](Of leg) { return leg.dot.c(); })},
      {"(41b)",
       "m/s",
       {"ḋ = Q̂ΩQ(l[e] + σ[s]) + Q̂Q(l[ė] + σ[ṡ])", legs([](Of leg) {
          return V(leg.Q_hat * leg.Omega_i() * leg.Q_i() * toDistal(leg, &Direction::value) +
                   leg.Q_hat * leg.Q_i() * toDistal(leg, &Direction::rate));
        })},
       {},
       legs([](Of leg) { return leg.dot.d(); })},
      {"(42a)", "1/s", {"[ė] = [0, −sin ψ, cos ψ]ᵀ ψ̇", legs([](Of leg) { return e(leg).rate; })}, {}, legs([](Of leg) {
         return leg.dot.e_i();
       })},
      {"(42b)",
       "1/s",
       {"[ṡ] = [0, sin(ψ+θ), −cos(ψ+θ)]ᵀ (ψ̇ + θ̇)", legs([](Of leg) { return s(leg).rate; })},
       {},
       legs([](Of leg) { return leg.dot.s_i(); })}};
}

}  // namespace

std::vector<Formula> bodyFormulas() {
  std::vector<Formula> all = positionsAndVelocities();
  for (
      Formula& f : std::vector<Formula>{
          {"(41c), (43c)",
           "m/s, m/s²",
           {"ċ = ṗ + ΩQρ, c̈ = p̈ + (Ω̇ + Ω²)Qρ", platformCenter},
           {},
           [](At at) { return values(at.platform.c_dot, at.platform.c_ddot); }},
          {"(43a)", "m/s²", {"c̈ = ρ Q̂((Ω̇ + Ω²)Q[e] + 2ΩQ[ė] + Q[ë])", legs(proximalAcceleration)}, {}, legs([](Of leg) {
             return leg.ddot.c();
           })},
          distalFormula(
              "(43b)", "d̈ = Q̂((Ω̇ + Ω̇²)Q(l[e] + σ + [s]) + 2ΩQ(l[ė] + σ[ṡ]) + 2Q(l[ë] + σ[s̈]))", {true, true, true},
              "Three errors; σ + [s] adds a number to a vector, read as added to every component. Each alone follows."),
          distalFormula("(43b) Ω̇²", "… (Ω̇ + Ω̇²)Q …", {true, false, false}),
          distalFormula("(43b) σ + [s]", "… (l[e] + σ + [s]) …", {false, true, false}),
          distalFormula("(43b) twice", "… + Q(l[ë] + σ[s̈]) + Q(l[ë] + σ[s̈])", {false, false, true}),
          {"(44)",
           "rad/s²",
           {"ω̇ = [0, −φ̈, 0]ᵀ = vect(Ω̇)", legs([](Of leg) { return vect(leg.Omega_i_dot()); })},
           {},
           legs([](Of leg) {
             const LegPose &at = leg.at, &dot = leg.dot, &ddot = leg.ddot;
             return V(leg.Q_hat.transpose() * vect(ddot.F() * at.F().transpose() + dot.F() * dot.F().transpose()));
           })}})
    all.push_back(std::move(f));
  return all;
}

}  // namespace ursula::audit

// (1)–(14), (27) at position level.

#include <Eigen/Geometry>

#include "parts/audit/formula.h"

namespace ursula::audit {
namespace {

V withPlusA(At at, Of leg) { return leg.a + at.platform.p + at.platform.Q * leg.b; }
V withMinusA(At at, Of leg) { return -leg.a + at.platform.p + at.platform.Q * leg.b; }

V k(At at, Of leg) { return leg.Q_hat.transpose() * withMinusA(at, leg); }

V ARByAngles(Of leg) { return V(S(0), leg.l * cos(leg.at.psi()), leg.l * sin(leg.at.psi())); }

V RBByAngles(Of leg) {
  const S sum = leg.at.psi() + leg.at.theta();
  return V(S(0), -leg.s * cos(sum), -leg.s * sin(sum));
}

/// The frame of (2) as printed, for an axis u in the base plane.
M frameWithoutTilt(Of leg) {
  M Q_hat;
  Q_hat << leg.u.y(), leg.u.x(), S(0), -leg.u.x(), leg.u.y(), S(0), S(0), S(0), S(1);
  return Q_hat.transpose() * Q_hat;
}

S principalAngle(At at, Of leg) {
  const V of = k(at, leg);
  const S angle = -atan(of.x() / of.z());
  return angle < 0 ? S(angle + acos(S(-1))) : angle;
}

/// (14b) with either sign of k_y, within half a turn of the true angle.
S universalAngle(At at, Of leg, int sign) {
  const S k_y = k(at, leg).y(), theta = leg.at.theta();
  const S psi = atan2(S(leg.s * sin(theta)), S(leg.l - leg.s * cos(theta))) +
                atan2(S(sqrt(leg.at.q() * leg.at.q() - k_y * k_y)), S(sign * k_y));
  const S turn = 2 * acos(S(-1));
  return psi - turn * round((psi - leg.at.psi()) / turn);
}

S kneeAngle(Of leg) {
  const S theta = acos((leg.l * leg.l + leg.s * leg.s - leg.at.q() * leg.at.q()) / (2 * leg.l * leg.s));
  return leg.at.theta() < 0 ? S(-theta) : theta;
}

V legByK(At at, Of leg) {
  const V of = k(at, leg);
  const S c = cos(leg.at.phi()), s = sin(leg.at.phi());
  return V(of.x() * c + of.z() * s, of.y(), -of.x() * s + of.z() * c);
}

}  // namespace

std::vector<Formula> displacementFormulas() {
  const Side identity = legs([](Of) { return M(M::Identity()); });
  const Side plus_a = legs([](At at, Of leg) { return withPlusA(at, leg).squaredNorm(); });
  const Side minus_a = legs([](At at, Of leg) { return withMinusA(at, leg).squaredNorm(); });
  return {
      {"(1)",
       "",
       {"Q: turn by φ about −ŷ", legs([](Of leg) { return M(leg.Q_hat * leg.Q_i()); })},
       {},
       legs([](Of leg) { return leg.at.F(); })},
      {"(2a,b)",
       "",
       {"u = [u, v, 0]ᵀ, ẑ = [0, 0, 1]ᵀ, x̂ = ŷ × ẑ", legs(frameWithoutTilt)},
       {"x̂ = (u × e_z)/‖u × e_z‖, ŷ = u, ẑ = x̂ × u", legs([](Of leg) { return M(leg.Q_hat.transpose() * leg.Q_hat); })},
       identity,
       "Residual: Q̂ᵀQ̂ − 1. Table I's axes leave the base plane by 20°. An axis along e_z takes another seed vector.",
       {FormulaError::eq2}},
      {"(3)", "m", {"AR + RB = −a + p + Qb", legs(withMinusA)}, {}, legs([](Of leg) {
         return V(leg.at.F() * V(leg.l * leg.at.e_i() + leg.s * leg.at.s_i()));
       })},
      {"(4a)",
       "rad",
       {"θ = cos⁻¹((l² + s² − q²)/(2ls))", legs(kneeAngle)},
       {},
       legs([](Of leg) { return leg.at.theta(); }),
       "One bend of the knee; the other is −θ."},
      {"(5)",
       "m²",
       {"q² = (a + p + Qb)ᵀ(a + p + Qb)", plus_a},
       {"q² = (−a + p + Qb)ᵀ(−a + p + Qb), as (3)", minus_a},
       legs([](Of leg) { return S(leg.at.q() * leg.at.q()); }),
       "",
       {FormulaError::eq5}},
      {"(9)",
       "m",
       {"[AR], [RB] by ψ, θ", legs([](Of leg) { return values(ARByAngles(leg), RBByAngles(leg)); })},
       {},
       legs([](Of leg) { return values(V(leg.l * leg.at.e_i()), V(leg.s * leg.at.s_i())); })},
      {"(10)",
       "m",
       {"Q̂Q[AB] = −a + p + Qb",
        legs([](Of leg) { return V(leg.Q_hat * leg.Q_i() * V(ARByAngles(leg) + RBByAngles(leg))); })},
       {},
       legs(withMinusA)},
      {"(13)", "m", {"[AB] by ψ, θ and by k, φ", legs(legByK)}, {}, legs([](Of leg) {
         return V(ARByAngles(leg) + RBByAngles(leg));
       })},
      {"(14a)",
       "rad",
       {"φ = −tan⁻¹(k_x/k_z), 0 ≤ φ ≤ π", legs(principalAngle)},
       {"φ = atan2(−k_x, k_z) ∈ (−π, π]",
        legs([](At at, Of leg) { return S(atan2(S(-k(at, leg).x()), k(at, leg).z())); })},
       legs([](Of leg) { return leg.at.phi(); }),
       "The range assumed in the text fails. The principal value without it is right as long as k_z > 0.",
       {FormulaError::eq14a}},
      {"(14b)",
       "rad",
       {"ψ = atan(s sin θ, l − s cos θ) + atan(√(q² − k_y²), −k_y)",
        legs([](At at, Of leg) { return universalAngle(at, leg, -1); })},
       {"ψ = atan2(s sin θ, l − s cos θ) + atan2(√(q² − k_y²), k_y)",
        legs([](At at, Of leg) { return universalAngle(at, leg, 1); })},
       legs([](Of leg) { return leg.at.psi(); }),
       "",
       {FormulaError::eq14b}},
      {"(27)",
       "m²",
       {"l² + s² − 2ls cos θ = (a + p + Qb)ᵀ(a + p + Qb)", plus_a},
       {"l² + s² − 2ls cos θ = (−a + p + Qb)ᵀ(−a + p + Qb)", minus_a},
       legs([](Of leg) { return S(leg.l * leg.l + leg.s * leg.s - 2 * leg.l * leg.s * cos(leg.at.theta())); }),
       "(5) put into (4a). Direct kinematics; no part of (37)."}};
}

}  // namespace ursula::audit

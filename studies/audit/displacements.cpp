// (1)–(14), (27) at position level.

#include <Eigen/Geometry>

#include "studies/audit/formula.h"

namespace ursula::audit {
namespace {

V k(const ReferenceState& at, const ReferenceLeg& leg) {
  return leg.Q_hat.transpose() * V(-leg.a + at.platform.p + at.platform.Q * leg.b);
}

V ARByAngles(const ReferenceLeg& leg) { return V(S(0), leg.l * cos(leg.at.psi()), leg.l * sin(leg.at.psi())); }

V RBByAngles(const ReferenceLeg& leg) {
  const S sum = leg.at.psi() + leg.at.theta();
  return V(S(0), -leg.s * cos(sum), -leg.s * sin(sum));
}

V withPlusA(const ReferenceState& at, const ReferenceLeg& leg) { return leg.a + at.platform.p + at.platform.Q * leg.b; }
V withMinusA(const ReferenceState& at, const ReferenceLeg& leg) {
  return -leg.a + at.platform.p + at.platform.Q * leg.b;
}

Formula frames() {
  Formula f;
  f.equation = "(2a,b)";
  f.printed = "u = [u, v, 0]ᵀ, ẑ = [0, 0, 1]ᵀ, x̂ = ŷ × ẑ";
  f.holds = "x̂ = (u × e_z)/‖u × e_z‖, ŷ = u, ẑ = x̂ × u";
  f.as_printed = overLegs([](const ReferenceState&, const ReferenceLeg& leg) {
    M Q_hat;
    Q_hat << leg.u.y(), leg.u.x(), S(0), -leg.u.x(), leg.u.y(), S(0), S(0), S(0), S(1);
    return values(M(Q_hat.transpose() * Q_hat));
  });
  f.that_holds = overLegs(
      [](const ReferenceState&, const ReferenceLeg& leg) { return values(M(leg.Q_hat.transpose() * leg.Q_hat)); });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg&) { return values(M(M::Identity())); });
  f.note =
      "Residual: Q̂ᵀQ̂ − 1. Table I's axes leave the base plane by 20°. An axis along e_z takes another seed vector.";
  f.formula_errors = {FormulaError::eq2};
  return f;
}

Formula squaredDistance() {
  Formula f;
  f.equation = "(5)";
  f.printed = "q² = (a + p + Qb)ᵀ(a + p + Qb)";
  f.holds = "q² = (−a + p + Qb)ᵀ(−a + p + Qb), as (3)";
  f.unit = "m²";
  f.as_printed = overLegs(
      [](const ReferenceState& at, const ReferenceLeg& leg) { return values(S(withPlusA(at, leg).squaredNorm())); });
  f.that_holds = overLegs(
      [](const ReferenceState& at, const ReferenceLeg& leg) { return values(S(withMinusA(at, leg).squaredNorm())); });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(S(leg.at.q() * leg.at.q())); });
  f.formula_errors = {FormulaError::eq5};
  return f;
}

Formula directKinematics() {
  Formula f = squaredDistance();
  f.equation = "(27)";
  f.printed = "l² + s² − 2ls cos θ = (a + p + Qb)ᵀ(a + p + Qb)";
  f.holds = "l² + s² − 2ls cos θ = (−a + p + Qb)ᵀ(−a + p + Qb)";
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) {
    return values(S(leg.l * leg.l + leg.s * leg.s - 2 * leg.l * leg.s * cos(leg.at.theta())));
  });
  f.note = "(5) put into (4a). Direct kinematics; no part of (37).";
  f.formula_errors = {};
  return f;
}

Formula angleOfMotor() {
  Formula f;
  f.equation = "(14a)";
  f.printed = "φ = −tan⁻¹(k_x/k_z), 0 ≤ φ ≤ π";
  f.holds = "φ = atan2(−k_x, k_z) ∈ (−π, π]";
  f.unit = "rad";
  f.as_printed = overLegs([](const ReferenceState& at, const ReferenceLeg& leg) {
    const V of = k(at, leg);
    const S angle = -atan(of.x() / of.z());
    return values(angle < 0 ? S(angle + acos(S(-1))) : angle);
  });
  f.that_holds = overLegs([](const ReferenceState& at, const ReferenceLeg& leg) {
    const V of = k(at, leg);
    return values(S(atan2(S(-of.x()), of.z())));
  });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(leg.at.phi()); });
  f.note = "The range assumed in the text fails. The principal value without it is right as long as k_z > 0.";
  f.formula_errors = {FormulaError::eq14a};
  return f;
}

Formula angleOfUniversalJoint() {
  Formula f;
  f.equation = "(14b)";
  f.printed = "ψ = atan(s sin θ, l − s cos θ) + atan(√(q² − k_y²), −k_y)";
  f.holds = "ψ = atan2(s sin θ, l − s cos θ) + atan2(√(q² − k_y²), k_y)";
  f.unit = "rad";
  const auto reading = [](int sign) {
    return overLegs([sign](const ReferenceState& at, const ReferenceLeg& leg) {
      const S k_y = k(at, leg).y(), theta = leg.at.theta();
      const S psi = atan2(S(leg.s * sin(theta)), S(leg.l - leg.s * cos(theta))) +
                    atan2(S(sqrt(leg.at.q() * leg.at.q() - k_y * k_y)), S(sign * k_y));
      const S turn = 2 * acos(S(-1));
      return values(S(psi - turn * round((psi - leg.at.psi()) / turn)));
    });
  };
  f.as_printed = reading(-1);
  f.that_holds = reading(1);
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(leg.at.psi()); });
  f.formula_errors = {FormulaError::eq14b};
  return f;
}

Formula rotation() {
  Formula f;
  f.equation = "(1)";
  f.printed = "Q: turn by φ about −ŷ";
  f.as_printed =
      overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(M(leg.Q_hat * leg.Q_i())); });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(leg.at.F()); });
  return f;
}

Formula closure() {
  Formula f;
  f.equation = "(3)";
  f.printed = "AR + RB = −a + p + Qb";
  f.unit = "m";
  f.as_printed =
      overLegs([](const ReferenceState& at, const ReferenceLeg& leg) { return values(V(withMinusA(at, leg))); });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) {
    return values(V(leg.at.F() * V(leg.l * leg.at.e_i() + leg.s * leg.at.s_i())));
  });
  return f;
}

Formula kneeAngle() {
  Formula f;
  f.equation = "(4a)";
  f.printed = "θ = cos⁻¹((l² + s² − q²)/(2ls))";
  f.unit = "rad";
  f.as_printed = overLegs([](const ReferenceState&, const ReferenceLeg& leg) {
    const S theta = acos((leg.l * leg.l + leg.s * leg.s - leg.at.q() * leg.at.q()) / (2 * leg.l * leg.s));
    return values(leg.at.theta() < 0 ? S(-theta) : theta);
  });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(leg.at.theta()); });
  f.note = "One bend of the knee; the other is −θ.";
  return f;
}

Formula linksByAngles() {
  Formula f;
  f.equation = "(9)";
  f.printed = "[AR], [RB] by ψ, θ";
  f.unit = "m";
  f.as_printed =
      overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(ARByAngles(leg), RBByAngles(leg)); });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) {
    return values(V(leg.l * leg.at.e_i()), V(leg.s * leg.at.s_i()));
  });
  return f;
}

Formula legInBase() {
  Formula f;
  f.equation = "(10)";
  f.printed = "Q̂Q[AB] = −a + p + Qb";
  f.unit = "m";
  f.as_printed = overLegs([](const ReferenceState&, const ReferenceLeg& leg) {
    return values(V(leg.Q_hat * leg.Q_i() * V(ARByAngles(leg) + RBByAngles(leg))));
  });
  f.truth = overLegs([](const ReferenceState& at, const ReferenceLeg& leg) { return values(V(withMinusA(at, leg))); });
  return f;
}

Formula legByK() {
  Formula f;
  f.equation = "(13)";
  f.printed = "[AB] by ψ, θ and by k, φ";
  f.unit = "m";
  f.as_printed = overLegs([](const ReferenceState& at, const ReferenceLeg& leg) {
    const V of = k(at, leg);
    const S c = cos(leg.at.phi()), s = sin(leg.at.phi());
    return values(S(of.x() * c + of.z() * s), of.y(), S(-of.x() * s + of.z() * c));
  });
  f.truth = overLegs(
      [](const ReferenceState&, const ReferenceLeg& leg) { return values(V(ARByAngles(leg) + RBByAngles(leg))); });
  return f;
}

}  // namespace

std::vector<Formula> displacementFormulas() {
  return {rotation(),        frames(),    closure(), kneeAngle(),    squaredDistance(),
          linksByAngles(),   legInBase(), legByK(),  angleOfMotor(), angleOfUniversalJoint(),
          directKinematics()};
}

}  // namespace ursula::audit

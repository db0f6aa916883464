// (39)–(44): the motion of the bodies.

#include <Eigen/Geometry>

#include "studies/audit/formula.h"

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

Direction e(const ReferenceLeg& leg) { return direction(leg.at.psi(), leg.dot.psi(), leg.ddot.psi()); }

Direction s(const ReferenceLeg& leg) {
  Direction s =
      direction(leg.at.psi() + leg.at.theta(), leg.dot.psi() + leg.dot.theta(), leg.ddot.psi() + leg.ddot.theta());
  return {-s.value, -s.rate, -s.acceleration};
}

/// Returns a formula for a vector of a leg, as there is one for the proximal link and one for the distal link.
Formula legVector(const char* equation, const char* printed, const char* unit, V (*formula)(const ReferenceLeg&),
                  V (*truth)(const ReferenceLeg&)) {
  Formula f;
  f.equation = equation;
  f.printed = printed;
  f.unit = unit;
  f.as_printed = overLegs([formula](const ReferenceState&, const ReferenceLeg& leg) { return values(formula(leg)); });
  f.truth = overLegs([truth](const ReferenceState&, const ReferenceLeg& leg) { return values(truth(leg)); });
  return f;
}

std::vector<Formula> positions() {
  return {legVector(
              "(39a)", "c = a + ρ Q̂Q[e]", "m",
              [](const ReferenceLeg& leg) { return V(leg.a + leg.rho * (leg.Q_hat * leg.Q_i() * e(leg).value)); },
              [](const ReferenceLeg& leg) { return leg.at.c(); }),
          legVector(
              "(39b)", "d = a + Q̂Q(l[e] + σ[s])", "m",
              [](const ReferenceLeg& leg) {
                return V(leg.a + leg.Q_hat * leg.Q_i() * V(leg.l * e(leg).value + leg.sigma * s(leg).value));
              },
              [](const ReferenceLeg& leg) { return leg.at.d(); })};
}

Formula linkFrames() {
  Formula f;
  f.equation = "(40)";
  f.printed = "G = [x, e × x, e], H = [x, s × x, s]";
  const auto frame = [](const V& x, const V& axis) {
    M G;
    G << x, axis.cross(x), axis;
    return values(M(G.transpose() * G), S(G.col(0).cross(G.col(1)).dot(G.col(2))));
  };
  f.as_printed = overLegs([frame](const ReferenceState&, const ReferenceLeg& leg) {
    const M F = leg.Q_hat * leg.Q_i();
    return frame(V(F.col(0)), V(F * e(leg).value));
  });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg&) { return values(M(M::Identity()), S(1)); });
  f.note = "Orthonormal and right-handed.";
  return f;
}

std::vector<Formula> velocities() {
  return {
      legVector(
          "(41a)", "ċ = ρ Q̂(ΩQ[e] + Q[ė])", "m/s",
          [](const ReferenceLeg& leg) {
            return V(leg.rho * (leg.Q_hat * V(leg.Omega_i() * leg.Q_i() * e(leg).value + leg.Q_i() * e(leg).rate)));
          },
          [](const ReferenceLeg& leg) { return leg.dot.c(); }),
      legVector(
          "(41b)", "ḋ = Q̂ΩQ(l[e] + σ[s]) + Q̂Q(l[ė] + σ[ṡ])", "m/s",
          [](const ReferenceLeg& leg) {
            return V(leg.Q_hat * leg.Omega_i() * leg.Q_i() * V(leg.l * e(leg).value + leg.sigma * s(leg).value) +
                     leg.Q_hat * leg.Q_i() * V(leg.l * e(leg).rate + leg.sigma * s(leg).rate));
          },
          [](const ReferenceLeg& leg) { return leg.dot.d(); }),
      legVector(
          "(42a)", "[ė] = [0, −sin ψ, cos ψ]ᵀ ψ̇", "1/s", [](const ReferenceLeg& leg) { return e(leg).rate; },
          [](const ReferenceLeg& leg) { return leg.dot.e_i(); }),
      legVector(
          "(42b)", "[ṡ] = [0, sin(ψ+θ), −cos(ψ+θ)]ᵀ (ψ̇ + θ̇)", "1/s",
          [](const ReferenceLeg& leg) { return s(leg).rate; }, [](const ReferenceLeg& leg) { return leg.dot.s_i(); })};
}

Formula proximalAcceleration() {
  return legVector(
      "(43a)", "c̈ = ρ Q̂((Ω̇ + Ω²)Q[e] + 2ΩQ[ė] + Q[ë])", "m/s²",
      [](const ReferenceLeg& leg) {
        const M Omega = leg.Omega_i(), Q = leg.Q_i();
        return V(leg.rho * (leg.Q_hat * V((leg.Omega_i_dot() + Omega * Omega) * Q * e(leg).value +
                                          2 * Omega * Q * e(leg).rate + Q * e(leg).acceleration)));
      },
      [](const ReferenceLeg& leg) { return leg.ddot.c(); });
}

/// (43b) with any of its three errors.
struct ReadingOf43b {
  bool omega_dot_squared, sigma_added, last_term_twice;
};

V distalAcceleration(const ReferenceLeg& leg, const ReadingOf43b& reading) {
  const M Omega = leg.Omega_i(), Omega_dot = leg.Omega_i_dot(), Q = leg.Q_i();
  const M squared = reading.omega_dot_squared ? M(Omega_dot * Omega_dot) : M(Omega * Omega);
  const V arm = leg.l * e(leg).value +
                (reading.sigma_added ? V(V::Constant(leg.sigma) + s(leg).value) : V(leg.sigma * s(leg).value));
  const V last = Q * V(leg.l * e(leg).acceleration + leg.sigma * s(leg).acceleration);
  return leg.Q_hat *
         V((Omega_dot + squared) * Q * arm + 2 * Omega * Q * V(leg.l * e(leg).rate + leg.sigma * s(leg).rate) +
           (reading.last_term_twice ? 2 : 1) * last);
}

Formula distalFormula(const char* equation, const char* printed, const ReadingOf43b& reading) {
  Formula f;
  f.equation = equation;
  f.printed = printed;
  f.holds = "d̈ = Q̂((Ω̇ + Ω²)Q(l[e] + σ[s]) + 2ΩQ(l[ė] + σ[ṡ]) + Q(l[ë] + σ[s̈]))";
  f.unit = "m/s²";
  f.as_printed = overLegs(
      [reading](const ReferenceState&, const ReferenceLeg& leg) { return values(distalAcceleration(leg, reading)); });
  f.that_holds = overLegs([](const ReferenceState&, const ReferenceLeg& leg) {
    return values(distalAcceleration(leg, {false, false, false}));
  });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(leg.ddot.d()); });
  if (reading.omega_dot_squared) f.formula_errors.push_back(FormulaError::eq43b_omega_dot);
  if (reading.sigma_added) f.formula_errors.push_back(FormulaError::eq43b_sigma);
  if (reading.last_term_twice) f.formula_errors.push_back(FormulaError::eq43b_doubled);
  return f;
}

std::vector<Formula> distalAccelerations() {
  std::vector<Formula> all = {
      distalFormula("(43b)", "d̈ = Q̂((Ω̇ + Ω̇²)Q(l[e] + σ + [s]) + 2ΩQ(l[ė] + σ[ṡ]) + 2Q(l[ë] + σ[s̈]))",
                    {true, true, true}),
      distalFormula("(43b) Ω̇²", "… (Ω̇ + Ω̇²)Q …", {true, false, false}),
      distalFormula("(43b) σ + [s]", "… (l[e] + σ + [s]) …", {false, true, false}),
      distalFormula("(43b) twice", "… + Q(l[ë] + σ[s̈]) + Q(l[ë] + σ[s̈])", {false, false, true})};
  all[0].note =
      "Three errors; σ + [s] adds a number to a vector, read as added to every component. Each alone follows.";
  return all;
}

Formula platformCenter() {
  Formula f;
  f.equation = "(41c), (43c)";
  f.printed = "ċ = ṗ + ΩQρ, c̈ = p̈ + (Ω̇ + Ω²)Qρ";
  f.unit = "m/s, m/s²";
  f.as_printed = [](const ReferenceState& at) {
    const ReferencePlatform& m = at.platform;
    const M Omega = crossMatrix(m.omega);
    return values(V(m.p_dot + Omega * m.Q * m.rho),
                  V(m.p_ddot + (crossMatrix(m.omega_dot) + Omega * Omega) * m.Q * m.rho));
  };
  f.truth = [](const ReferenceState& at) { return values(at.platform.c_dot, at.platform.c_ddot); };
  return f;
}

Formula frameSpinRate() {
  Formula f;
  f.equation = "(44)";
  f.printed = "ω̇ = [0, −φ̈, 0]ᵀ = vect(Ω̇)";
  f.unit = "rad/s²";
  f.as_printed =
      overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(V(vect(leg.Omega_i_dot()))); });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) {
    const LegPose &at = leg.at, &dot = leg.dot, &ddot = leg.ddot;
    return values(V(leg.Q_hat.transpose() * vect(ddot.F() * at.F().transpose() + dot.F() * dot.F().transpose())));
  });
  return f;
}

}  // namespace

std::vector<Formula> bodyFormulas() {
  std::vector<Formula> all = positions();
  all.push_back(linkFrames());
  for (Formula& f : velocities()) all.push_back(std::move(f));
  all.push_back(platformCenter());
  all.push_back(proximalAcceleration());
  for (Formula& f : distalAccelerations()) all.push_back(std::move(f));
  all.push_back(frameSpinRate());
  return all;
}

}  // namespace ursula::audit

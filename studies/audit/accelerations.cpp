// (4c), (8), (17)–(19): accelerations.

#include <Eigen/Geometry>

#include "studies/audit/formula.h"

namespace ursula::audit {
namespace {

S eta(const ReferenceLeg& leg) {
  return leg.s * (leg.dot.psi() + leg.dot.theta()) * cos(leg.at.psi() + leg.at.theta());
}

Formula kneeAcceleration() {
  Formula f;
  f.equation = "(4c)";
  f.printed = "θ̈ = (q² + q q̈ − ls θ̇² cos θ)/(ls sin θ)";
  f.holds = "θ̈ = (q̇² + q q̈ − ls θ̇² cos θ)/(ls sin θ)";
  f.unit = "rad/s²";
  const auto reading = [](bool dotted) {
    return overLegs([dotted](const ReferenceState&, const ReferenceLeg& leg) {
      const S ls = leg.l * leg.s, first = dotted ? leg.dot.q() : leg.at.q(), theta = leg.at.theta();
      return values(
          S((first * first + leg.at.q() * leg.ddot.q() - ls * leg.dot.theta() * leg.dot.theta() * cos(theta)) /
            (ls * sin(theta))));
    });
  };
  f.as_printed = reading(false);
  f.that_holds = reading(true);
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(leg.ddot.theta()); });
  f.note = "A dot is missing.";
  f.formula_errors = {FormulaError::eq4c};
  return f;
}

Formula distanceAcceleration() {
  Formula f;
  f.equation = "(8)";
  f.printed = "q̈ = (‖ṗ + ΩQb‖² + (p̈ + (Ω̇ + Ω²)Qb)ᵀ AB − q̇²)/q";
  f.unit = "m/s²";
  f.as_printed = overLegs([](const ReferenceState& at, const ReferenceLeg& leg) {
    return values(
        S((velocityOfB(at, leg).squaredNorm() + accelerationOfB(at, leg).dot(leg.at.AB()) - leg.dot.q() * leg.dot.q()) /
          leg.at.q()));
  });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(leg.ddot.q()); });
  return f;
}

/// (17a) for the proximal link, (17b) for the distal one.
Formula angularAcceleration(bool proximal) {
  Formula f;
  f.equation = proximal ? "(17a)" : "(17b)";
  f.printed = proximal ? "ν̇ = Q̂(ΩQ[ν] + Q[ν̇] − ω̇)" : "ξ̇ = Q̂(ΩQ[ξ] + Q[ξ̇] − ω̇)";
  f.holds = proximal ? "ν̇ = Q̂(ΩQ[ν] + Q[ν̇] + ω̇)" : "ξ̇ = Q̂(ΩQ[ξ] + Q[ξ̇] + ω̇)";
  f.unit = "rad/s²";
  const auto reading = [proximal](int sign) {
    return overLegs([proximal, sign](const ReferenceState&, const ReferenceLeg& leg) {
      const S rate = leg.dot.psi() + (proximal ? S(0) : leg.dot.theta());
      const S acceleration = leg.ddot.psi() + (proximal ? S(0) : leg.ddot.theta());
      const V omega_dot(S(0), -leg.ddot.phi(), S(0));
      return values(V(leg.Q_hat * V(leg.Omega_i() * leg.Q_i() * V(rate, S(0), S(0)) +
                                    leg.Q_i() * V(acceleration, S(0), S(0)) + sign * omega_dot)));
    });
  };
  f.as_printed = reading(-1);
  f.that_holds = reading(1);
  f.truth = overLegs([proximal](const ReferenceState&, const ReferenceLeg& leg) {
    const M R = proximal ? leg.at.G() : leg.at.H(), R_dot = proximal ? leg.dot.G() : leg.dot.H();
    const M R_ddot = proximal ? leg.ddot.G() : leg.ddot.H();
    return values(V(vect(R_ddot * R.transpose() + R_dot * R_dot.transpose())));
  });
  f.note = "Follows (16). The solver's error is that of (17a) and (17b) together.";
  f.formula_errors = {FormulaError::eq17};
  return f;
}

Formula velocityInLegRate() {
  Formula f;
  f.equation = "(18)";
  f.printed = "ḣ = QᵀQ̂ᵀ(p̈ + (Ω̇ + Ω²)Qb) + (Q̂ΩQ)ᵀ(ṗ + ΩQb)";
  f.unit = "m/s²";
  f.as_printed = overLegs([](const ReferenceState& at, const ReferenceLeg& leg) {
    return values(V(leg.Q_i().transpose() * leg.Q_hat.transpose() * accelerationOfB(at, leg) +
                    (leg.Q_hat * leg.Omega_i() * leg.Q_i()).transpose() * velocityOfB(at, leg)));
  });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(leg.h_dot()); });
  return f;
}

Formula motorAcceleration() {
  Formula f;
  f.equation = "(19a)";
  f.printed = "φ̈ = (ḣ_x − ηφ)/(s sin(ψ+θ))";
  f.holds = "φ̈ = (ḣ_x − (η − lψ̇ cos ψ)φ̇)/(s sin(ψ+θ) − l sin ψ)";
  f.unit = "rad/s²";
  f.as_printed = overLegs([](const ReferenceState&, const ReferenceLeg& leg) {
    return values(S((leg.h_dot().x() - eta(leg) * leg.at.phi()) / (leg.s * sin(leg.at.psi() + leg.at.theta()))));
  });
  f.that_holds = overLegs([](const ReferenceState&, const ReferenceLeg& leg) {
    const S distance_dot = eta(leg) - leg.l * leg.dot.psi() * cos(leg.at.psi());
    return values(S((leg.h_dot().x() - distance_dot * leg.dot.phi()) / distanceFromAxis(leg)));
  });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(leg.ddot.phi()); });
  f.note = "(15a) differentiated, and a dot is missing.";
  f.formula_errors = {FormulaError::eq19a};
  return f;
}

Formula universalAcceleration() {
  Formula f;
  f.equation = "(19b)";
  f.printed = "ψ̈ = (ḣ_y − ηθ̇ − sθ̈ sin(ψ+θ) − (η − lψ̇ cos ψ))/(−l sin ψ + s sin(ψ+θ))";
  f.holds = "ψ̈ = (ḣ_y − ηθ̇ − sθ̈ sin(ψ+θ) − (η − lψ̇ cos ψ)ψ̇)/(−l sin ψ + s sin(ψ+θ))";
  f.unit = "rad/s²";
  const auto reading = [](bool with_factor) {
    return overLegs([with_factor](const ReferenceState&, const ReferenceLeg& leg) {
      const S psi = leg.at.psi(), sum = psi + leg.at.theta();
      const S last = (eta(leg) - leg.l * leg.dot.psi() * cos(psi)) * (with_factor ? leg.dot.psi() : S(1));
      return values(S((leg.h_dot().y() - eta(leg) * leg.dot.theta() - leg.s * leg.ddot.theta() * sin(sum) - last) /
                      distanceFromAxis(leg)));
    });
  };
  f.as_printed = reading(false);
  f.that_holds = reading(true);
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(leg.ddot.psi()); });
  f.formula_errors = {FormulaError::eq19b};
  return f;
}

}  // namespace

std::vector<Formula> accelerationFormulas() {
  return {kneeAcceleration(),  distanceAcceleration(), angularAcceleration(true), angularAcceleration(false),
          velocityInLegRate(), motorAcceleration(),    universalAcceleration()};
}

}  // namespace ursula::audit

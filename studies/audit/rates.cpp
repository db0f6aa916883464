// (4b), (6), (7), (11), (12), (15), (16): rates.

#include <Eigen/Geometry>

#include "studies/audit/formula.h"

namespace ursula::audit {
namespace {

Side spins() {
  return overLegs([](const ReferenceState&, const ReferenceLeg& leg) {
    return values(V(vect(leg.dot.G() * leg.at.G().transpose())), V(vect(leg.dot.H() * leg.at.H().transpose())));
  });
}

Formula motorRate() {
  Formula f;
  f.equation = "(15a)";
  f.printed = "φ̇ = h_x/(s sin(ψ+θ))";
  f.holds = "φ̇ = h_x/(s sin(ψ+θ) − l sin ψ)";
  f.unit = "rad/s";
  f.as_printed = overLegs([](const ReferenceState&, const ReferenceLeg& leg) {
    return values(S(leg.h().x() / (leg.s * sin(leg.at.psi() + leg.at.theta()))));
  });
  f.that_holds = overLegs(
      [](const ReferenceState&, const ReferenceLeg& leg) { return values(S(leg.h().x() / distanceFromAxis(leg))); });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(leg.dot.phi()); });
  f.note =
      "The denominator that holds is the distance of B from the motor's axis, negated. The printed one can vanish, see "
      "below.";
  f.formula_errors = {FormulaError::eq15a};
  return f;
}

Formula universalRate() {
  Formula f;
  f.equation = "(15b)";
  f.printed = "ψ̇ = (h_y − s θ sin(ψ+θ))/(−l sin ψ + s sin(ψ+θ))";
  f.holds = "ψ̇ = (h_y − s θ̇ sin(ψ+θ))/(−l sin ψ + s sin(ψ+θ))";
  f.unit = "rad/s";
  const auto reading = [](bool dotted) {
    return overLegs([dotted](const ReferenceState&, const ReferenceLeg& leg) {
      const S theta = dotted ? leg.dot.theta() : leg.at.theta();
      return values(S((leg.h().y() - leg.s * theta * sin(leg.at.psi() + leg.at.theta())) / distanceFromAxis(leg)));
    });
  };
  f.as_printed = reading(false);
  f.that_holds = reading(true);
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(leg.dot.psi()); });
  f.note = "The dot over θ is missing in our source; with it the formula holds.";
  f.formula_errors = {FormulaError::eq15b};
  return f;
}

Formula angularVelocities() {
  Formula f;
  f.equation = "(16)";
  f.printed = "ν = Q̂(Q[ν] − ω), ξ = Q̂(Q[ξ] − ω)";
  f.holds = "ν = Q̂(Q[ν] + ω), ξ = Q̂(Q[ξ] + ω), ω = [0, −φ̇, 0]ᵀ of (12)";
  f.unit = "rad/s";
  const auto reading = [](int sign) {
    return overLegs([sign](const ReferenceState&, const ReferenceLeg& leg) {
      const V omega(S(0), -leg.dot.phi(), S(0));
      const V nu(leg.dot.psi(), S(0), S(0)), xi(leg.dot.psi() + leg.dot.theta(), S(0), S(0));
      return values(V(leg.Q_hat * V(leg.Q_i() * nu + sign * omega)), V(leg.Q_hat * V(leg.Q_i() * xi + sign * omega)));
    });
  };
  f.as_printed = reading(-1);
  f.that_holds = reading(1);
  f.truth = spins();
  f.note = "The column of T follows it by (48).";
  f.formula_errors = {FormulaError::eq16};
  return f;
}

Formula kneeRate() {
  Formula f;
  f.equation = "(4b)";
  f.printed = "θ̇ = q̇ q/(ls sin θ)";
  f.unit = "rad/s";
  f.as_printed = overLegs([](const ReferenceState&, const ReferenceLeg& leg) {
    return values(S(leg.dot.q() * leg.at.q() / (leg.l * leg.s * sin(leg.at.theta()))));
  });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(leg.dot.theta()); });
  return f;
}

Formula distanceRate() {
  Formula f;
  f.equation = "(6)";
  f.printed = "q̇ = (ṗ + ΩQb)ᵀ AB/q";
  f.unit = "m/s";
  f.as_printed = overLegs([](const ReferenceState& at, const ReferenceLeg& leg) {
    return values(S(velocityOfB(at, leg).dot(leg.at.AB()) / leg.at.q()));
  });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(leg.dot.q()); });
  return f;
}

Formula platformSpin() {
  Formula f;
  f.equation = "(7)";
  f.printed = "ω = vect(Ω)";
  f.unit = "rad/s";
  f.as_printed = [](const ReferenceState& at) { return values(vect(at.platform.Q_dot * at.platform.Q.transpose())); };
  f.truth = [](const ReferenceState& at) { return values(at.motion.omega); };
  return f;
}

Formula legRate() {
  Formula f;
  f.equation = "(11a)";
  f.printed = "d[AB]/dt = h − Ω[AB]";
  f.unit = "m/s";
  f.as_printed = overLegs([](const ReferenceState&, const ReferenceLeg& leg) {
    return values(V(leg.h() - leg.Omega_i() * leg.at.AB_i()));
  });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(leg.dot.AB_i()); });
  return f;
}

Formula velocityInLeg() {
  Formula f;
  f.equation = "(11b)";
  f.printed = "h = QᵀQ̂ᵀ(ṗ + ΩQb)";
  f.unit = "m/s";
  f.as_printed = overLegs([](const ReferenceState& at, const ReferenceLeg& leg) {
    return values(V(leg.Q_i().transpose() * leg.Q_hat.transpose() * velocityOfB(at, leg)));
  });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(leg.h()); });
  return f;
}

Formula frameSpin() {
  Formula f;
  f.equation = "(12)";
  f.printed = "ω = [0, −φ̇, 0]ᵀ";
  f.unit = "rad/s";
  f.as_printed =
      overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(V(vect(leg.Omega_i()))); });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) {
    return values(V(leg.Q_hat.transpose() * vect(leg.dot.F() * leg.at.F().transpose())));
  });
  return f;
}

}  // namespace

std::vector<Formula> rateFormulas() {
  return {kneeRate(),  distanceRate(), platformSpin(),  legRate(),          velocityInLeg(),
          frameSpin(), motorRate(),    universalRate(), angularVelocities()};
}

}  // namespace ursula::audit

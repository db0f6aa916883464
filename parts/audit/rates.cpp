// (4b), (6), (7), (11), (12), (15), (16): rates.

#include <Eigen/Geometry>

#include "parts/audit/formula.h"

namespace ursula::audit {
namespace {

/// (15b) with the dot over θ or without.
S universalRate(Of leg, const S& theta) {
  return (leg.h().y() - leg.s * theta * sin(leg.at.psi() + leg.at.theta())) / distanceFromAxis(leg);
}

/// (16) with either sign of ω.
Values angularVelocities(Of leg, int sign) {
  const V omega(S(0), -leg.dot.phi(), S(0));
  const V nu(leg.dot.psi(), S(0), S(0)), xi(leg.dot.psi() + leg.dot.theta(), S(0), S(0));
  return values(V(leg.Q_hat * V(leg.Q_i() * nu + sign * omega)), V(leg.Q_hat * V(leg.Q_i() * xi + sign * omega)));
}

}  // namespace

std::vector<Formula> rateFormulas() {
  return {{"(4b)",
           "rad/s",
           {"θ̇ = q̇ q/(ls sin θ)",
            legs([](Of leg) { return S(leg.dot.q() * leg.at.q() / (leg.l * leg.s * sin(leg.at.theta()))); })},
           {},
           legs([](Of leg) { return leg.dot.theta(); })},
          {"(6)",
           "m/s",
           {"q̇ = (ṗ + ΩQb)ᵀ AB/q",
            legs([](At at, Of leg) { return S(velocityOfB(at, leg).dot(leg.at.AB()) / leg.at.q()); })},
           {},
           legs([](Of leg) { return leg.dot.q(); })},
          {"(7)",
           "rad/s",
           {"ω = vect(Ω)", [](At at) { return values(vect(at.platform.Q_dot * at.platform.Q.transpose())); }},
           {},
           [](At at) { return values(at.motion.omega); }},
          {"(11a)",
           "m/s",
           {"d[AB]/dt = h − Ω[AB]", legs([](Of leg) { return V(leg.h() - leg.Omega_i() * leg.at.AB_i()); })},
           {},
           legs([](Of leg) { return leg.dot.AB_i(); })},
          {"(11b)",
           "m/s",
           {"h = QᵀQ̂ᵀ(ṗ + ΩQb)", legs([](At at, Of leg) {
              return V(leg.Q_i().transpose() * leg.Q_hat.transpose() * velocityOfB(at, leg));
            })},
           {},
           legs([](Of leg) { return leg.h(); })},
          {"(12)", "rad/s", {"ω = [0, −φ̇, 0]ᵀ", legs([](Of leg) { return vect(leg.Omega_i()); })}, {}, legs([](Of leg) {
             return V(leg.Q_hat.transpose() * vect(leg.dot.F() * leg.at.F().transpose()));
           })},
          {"(15a)",
           "rad/s",
           {"φ̇ = h_x/(s sin(ψ+θ))",
            legs([](Of leg) { return S(leg.h().x() / (leg.s * sin(leg.at.psi() + leg.at.theta()))); })},
           {"φ̇ = h_x/(s sin(ψ+θ) − l sin ψ)", legs([](Of leg) { return S(leg.h().x() / distanceFromAxis(leg)); })},
           legs([](Of leg) { return leg.dot.phi(); }),
           "The denominator that holds is the distance of B from the motor's axis, negated. The printed one can "
           "vanish, see below.",
           {FormulaError::eq15a}},
          {"(15b)",
           "rad/s",
           {"ψ̇ = (h_y − s θ sin(ψ+θ))/(−l sin ψ + s sin(ψ+θ))",
            legs([](Of leg) { return universalRate(leg, leg.at.theta()); })},
           {"ψ̇ = (h_y − s θ̇ sin(ψ+θ))/(−l sin ψ + s sin(ψ+θ))",
            legs([](Of leg) { return universalRate(leg, leg.dot.theta()); })},
           legs([](Of leg) { return leg.dot.psi(); }),
           "The dot over θ is missing in our source; with it the formula holds.",
           {FormulaError::eq15b}},
          {"(16)",
           "rad/s",
           {"ν = Q̂(Q[ν] − ω), ξ = Q̂(Q[ξ] − ω)", legs([](Of leg) { return angularVelocities(leg, -1); })},
           {"ν = Q̂(Q[ν] + ω), ξ = Q̂(Q[ξ] + ω), ω = [0, −φ̇, 0]ᵀ of (12)",
            legs([](Of leg) { return angularVelocities(leg, 1); })},
           legs([](Of leg) {
             return values(vect(leg.dot.G() * leg.at.G().transpose()), vect(leg.dot.H() * leg.at.H().transpose()));
           }),
           "The column of T follows it by (48).",
           {FormulaError::eq16}}};
}

}  // namespace ursula::audit

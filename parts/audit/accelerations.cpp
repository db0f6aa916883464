// (4c), (8), (17)–(19): accelerations.

#include <Eigen/Geometry>

#include "parts/audit/formula.h"

namespace ursula::audit {
namespace {

S eta(Of leg) { return leg.s * (leg.dot.psi() + leg.dot.theta()) * cos(leg.at.psi() + leg.at.theta()); }

/// The rate of distanceFromAxis().
S distanceRate(Of leg) { return eta(leg) - leg.l * leg.dot.psi() * cos(leg.at.psi()); }

/// (4c) with q̇ or q as the first term's root.
S kneeAcceleration(Of leg, const S& first) {
  const S ls = leg.l * leg.s, theta = leg.at.theta();
  return (first * first + leg.at.q() * leg.ddot.q() - ls * leg.dot.theta() * leg.dot.theta() * cos(theta)) /
         (ls * sin(theta));
}

/// (19b) with ψ̇ or 1 as the last term's factor.
S universalAcceleration(Of leg, const S& factor) {
  const S sum = leg.at.psi() + leg.at.theta(), last = distanceRate(leg) * factor;
  return (leg.h_dot().y() - eta(leg) * leg.dot.theta() - leg.s * leg.ddot.theta() * sin(sum) - last) /
         distanceFromAxis(leg);
}

/// (17a) for the proximal link, (17b) for the distal one, with either sign of ω̇.
V angularAcceleration(Of leg, bool proximal, int sign) {
  const S rate = leg.dot.psi() + (proximal ? S(0) : leg.dot.theta());
  const S acceleration = leg.ddot.psi() + (proximal ? S(0) : leg.ddot.theta());
  const V omega_dot(S(0), -leg.ddot.phi(), S(0));
  return leg.Q_hat * V(leg.Omega_i() * leg.Q_i() * V(rate, S(0), S(0)) + leg.Q_i() * V(acceleration, S(0), S(0)) +
                       sign * omega_dot);
}

Formula ofLink(const char* equation, const char* printed, const char* holds, bool proximal) {
  return {equation,
          "rad/s²",
          {printed, legs([proximal](Of leg) { return angularAcceleration(leg, proximal, -1); })},
          {holds, legs([proximal](Of leg) { return angularAcceleration(leg, proximal, 1); })},
          legs([proximal](Of leg) {
            const auto frame = [proximal](const LegPose& of) { return proximal ? of.G() : of.H(); };
            const M R_dot = frame(leg.dot);
            return vect(frame(leg.ddot) * frame(leg.at).transpose() + R_dot * R_dot.transpose());
          }),
          "Follows (16). The solver's error is that of (17a) and (17b) together.",
          {FormulaError::eq17}};
}

}  // namespace

std::vector<Formula> accelerationFormulas() {
  return {{"(4c)",
           "rad/s²",
           {"θ̈ = (q² + q q̈ − ls θ̇² cos θ)/(ls sin θ)", legs([](Of leg) { return kneeAcceleration(leg, leg.at.q()); })},
           {"θ̈ = (q̇² + q q̈ − ls θ̇² cos θ)/(ls sin θ)", legs([](Of leg) { return kneeAcceleration(leg, leg.dot.q()); })},
           legs([](Of leg) { return leg.ddot.theta(); }),
           "A dot is missing.",
           {FormulaError::eq4c}},
          {"(8)",
           "m/s²",
           {"q̈ = (‖ṗ + ΩQb‖² + (p̈ + (Ω̇ + Ω²)Qb)ᵀ AB − q̇²)/q", legs([](At at, Of leg) {
              return S((velocityOfB(at, leg).squaredNorm() + accelerationOfB(at, leg).dot(leg.at.AB()) -
                        leg.dot.q() * leg.dot.q()) /
                       leg.at.q());
            })},
           {},
           legs([](Of leg) { return leg.ddot.q(); })},
          ofLink("(17a)", "ν̇ = Q̂(ΩQ[ν] + Q[ν̇] − ω̇)", "ν̇ = Q̂(ΩQ[ν] + Q[ν̇] + ω̇)", true),
          ofLink("(17b)", "ξ̇ = Q̂(ΩQ[ξ] + Q[ξ̇] − ω̇)", "ξ̇ = Q̂(ΩQ[ξ] + Q[ξ̇] + ω̇)", false),
          {"(18)",
           "m/s²",
           {"ḣ = QᵀQ̂ᵀ(p̈ + (Ω̇ + Ω²)Qb) + (Q̂ΩQ)ᵀ(ṗ + ΩQb)", legs([](At at, Of leg) {
              return V(leg.Q_i().transpose() * leg.Q_hat.transpose() * accelerationOfB(at, leg) +
                       (leg.Q_hat * leg.Omega_i() * leg.Q_i()).transpose() * velocityOfB(at, leg));
            })},
           {},
           legs([](Of leg) { return leg.h_dot(); })},
          {"(19a)",
           "rad/s²",
           {"φ̈ = (ḣ_x − ηφ)/(s sin(ψ+θ))", legs([](Of leg) {
              return S((leg.h_dot().x() - eta(leg) * leg.at.phi()) / (leg.s * sin(leg.at.psi() + leg.at.theta())));
            })},
           {"φ̈ = (ḣ_x − (η − lψ̇ cos ψ)φ̇)/(s sin(ψ+θ) − l sin ψ)", legs([](Of leg) {
              return S((leg.h_dot().x() - distanceRate(leg) * leg.dot.phi()) / distanceFromAxis(leg));
            })},
           legs([](Of leg) { return leg.ddot.phi(); }),
           "(15a) differentiated, and a dot is missing.",
           {FormulaError::eq19a}},
          {"(19b)",
           "rad/s²",
           {"ψ̈ = (ḣ_y − ηθ̇ − sθ̈ sin(ψ+θ) − (η − lψ̇ cos ψ))/(−l sin ψ + s sin(ψ+θ))",
            legs([](Of leg) { return universalAcceleration(leg, S(1)); })},
           {"ψ̈ = (ḣ_y − ηθ̇ − sθ̈ sin(ψ+θ) − (η − lψ̇ cos ψ)ψ̇)/(−l sin ψ + s sin(ψ+θ))",
            legs([](Of leg) { return universalAcceleration(leg, leg.dot.psi()); })},
           legs([](Of leg) { return leg.ddot.psi(); }),
           "",
           {FormulaError::eq19b}}};
}

}  // namespace ursula::audit

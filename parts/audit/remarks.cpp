#include "parts/audit/remarks.h"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace ursula::audit {

std::string number(double value) {
  if (std::isnan(value)) return "—";
  const double size = std::abs(value);
  if (size == 0) return "0";
  if (size < 1e-9) return fmt::format("{:.0e}", value);
  if (size < 999.5 || size >= 1e6) return fmt::format("{:.3g}", value);
  const double unit = size < 9995 ? 10 : size < 99950 ? 100 : 1000;  // three digits, written out
  return fmt::format("{:.0f}", std::round(value / unit) * unit);
}

std::string residualOf(double residual, const AuditRow& row) {
  if (std::isnan(residual)) return "—";
  const std::string unit = row.unit.empty() ? "" : " " + row.unit;
  if (row.size == 0) return number(residual) + unit;
  return fmt::format("{} of {}{}", number(residual), number(row.size), unit);
}

std::string instant(double t) { return t < 0 ? "never" : fmt::format("{:.3f} s", t); }

std::string ending(const AuditEffect& effect, double duration) {
  if (effect.replay_end < duration) return fmt::format("lost at {:.1f} s", effect.replay_end);
  return fmt::format("{:.2g} m", effect.end_deviation);
}

namespace {

AuditRemark ranges(const std::vector<ReferenceState>& states) {
  double low[2] = {10, 10}, high[2] = {-10, -10}, k_z = 1e9;
  for (const ReferenceState& reference : states)
    for (const ReferenceLeg& leg : reference.legs) {
      k_z = std::min(k_z, leg.Q_hat.col(2).dot(leg.at.AB()).convert_to<double>());
      for (int k = 0; k < 2; ++k) {
        const double angle = leg.at.v(k).convert_to<double>();
        low[k] = std::min(low[k], angle);
        high[k] = std::max(high[k], angle);
      }
    }
  return {"text by (14)", "0 ≤ φ, ψ ≤ π is assumed.",
          fmt::format("At the instants of the residuals φ is between {:.3f} and {:.3f} rad, ψ between {:.3f} and "
                      "{:.3f} rad. k_z is at least {:.3g} m{}.",
                      low[0], high[0], low[1], high[1], k_z,
                      k_z > 0 ? ": without the range, (14a) as a principal value would do here" : "")};
}

/// Finds where the printed denominator of (15a), (19a) changes its sign, so that the printed formulas divide by zero.
AuditRemark vanishingDenominator(const Scenario& scenario, const ReferenceMechanism& mechanism) {
  constexpr int grid = 300;
  std::string legs;
  for (int i = 0; i < leg_count; ++i) {
    bool positive = false, negative = false;
    for (int k = 0; k <= grid; ++k) {
      const Motion<S> motion = scenario.trajectory->at(S(scenario.trajectory->duration() * k / grid));
      const LegPose pose = mechanism.legPose(i, motion.p, motion.Q);
      (sin(S(pose.psi() + pose.theta())) > 0 ? positive : negative) = true;
    }
    if (positive && negative) legs += fmt::format("{}{}", legs.empty() ? "" : ", ", i + 1);
  }
  return {"(15a), (19a), (21)", "The denominator is s sin(ψ+θ).",
          legs.empty() ? "It does not vanish on this motion."
                       : "It passes through zero on this motion, at legs " + legs +
                             ": there φ̇ and the torques as printed have no bound, and the errors given are those of "
                             "the instants sampled. The distance of B from the axis does not vanish."};
}

/// Measures (27) and the first two rows of (13) with (−ψ, −θ) instead of (ψ, θ) on every leg.
AuditRemark mirroredLegs(const std::vector<ReferenceState>& states) {
  S worst(0), third(0);
  for (const ReferenceState& reference : states)
    for (const ReferenceLeg& leg : reference.legs) {
      const S psi = -leg.at.psi(), theta = -leg.at.theta(), q = leg.at.q();
      const V AB = leg.at.AB_i();
      const S by_27 = leg.l * leg.l + leg.s * leg.s - 2 * leg.l * leg.s * cos(theta) - q * q;
      const S by_13 = leg.l * cos(psi) - leg.s * cos(psi + theta) - AB.y();
      worst = std::max({worst, S(abs(by_27)), S(abs(by_13))});
      third = std::max(third, S(abs(leg.l * sin(psi) - leg.s * sin(psi + theta) - AB.z())));
    }
  return {
      "text by (27)", "(27) and the first two rows of (13) determine pose, θ and ψ: 18 equations in 18 unknowns.",
      fmt::format("Each leg's pair (−ψ, −θ) satisfies them as well as (ψ, θ) does (residual {:.0e} m²), and misses the "
                  "third row of (13) by up to {:.3g} m. That row decides; without it every pose counts 2⁶ times.",
                  worst.convert_to<double>(), third.convert_to<double>())};
}

/// Compares inertias with m ρ², which is the least transverse moment of a link about its joint.
AuditRemark inertiaPoints(const Scenario& scenario) {
  const auto left = [](const Link& link) {
    return link.inertia(0, 0) - link.mass * link.center_of_mass * link.center_of_mass;
  };
  const Leg& leg = scenario.manipulator->leg(0);
  const bool impossible = left(leg.proximal) < 0 || left(leg.distal) < 0;
  return {"text by (40)", "The frames 𝒢, ℋ of the links' inertias have their origins at A and R.",
          fmt::format("Taken about A and R, the inertias of leg 1 would leave {:.3g} and {:.3g} kg m² about the mass "
                      "centres, {}. They are about the mass centres, as (29) says.",
                      left(leg.proximal), left(leg.distal),
                      impossible ? "which no body can have" : "which is possible here")};
}

}  // namespace

std::vector<AuditRemark> remarks(const Scenario& scenario, const ReferenceMechanism& mechanism,
                                 const std::vector<ReferenceState>& states) {
  return {ranges(states),
          vanishingDenominator(scenario, mechanism),
          mirroredLegs(states),
          inertiaPoints(scenario),
          {"Table I",
           "a₃ has 0.9018 for its second entry, a₆ 0.9016; entries of a₄, a₅ and a₆ are lost or damaged in our source.",
           "The 120° symmetry of the two families of legs gives 0.9016 and restores the rest. The points b of legs 1, "
           "3 and 4 lie 0.0070 m off the symmetric places; taken as meant."},
          {"text of 4.1", "The duration t_f of the helix is not given in our source.",
           fmt::format("Here t_f = {} s.", scenario.trajectory->duration())}};
}

}  // namespace ursula::audit

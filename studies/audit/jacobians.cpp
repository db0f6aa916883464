// (20)–(26): Jacobians and their rates.

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "studies/audit/formula.h"

namespace ursula::audit {
namespace {

Matrix6<S> stacked(const ReferenceState& at, Vector6<S> (*row)(const ReferenceLeg&)) {
  Matrix6<S> B;
  for (int i = 0; i < leg_count; ++i) B.row(i) = row(at.legs[static_cast<std::size_t>(i)]).transpose();
  return B;
}

Vector6<S> rowOf(const LegPose& pose) { return pose.rowOfB(); }

/// Compares the six entries of Ḃ's first row, which our source prints without Q.
Formula forwardJacobianRate() {
  Formula f;
  f.equation = "(26) Ḃ";
  f.printed = "first row: (Ωb × x + Qb × ẋ)ᵀ, ẋᵀ";
  f.holds = "every row: ((ΩQb) × x + Qb × ẋ)ᵀ, ẋᵀ";
  f.unit = "m/s, 1/s";
  const auto reading = [](bool with_Q) {
    return [with_Q](const ReferenceState& at) {
      const ReferenceLeg& leg = at.legs.front();
      const V Qb = at.platform.Q * leg.b;
      const V b_dot = crossMatrix(at.platform.omega) * (with_Q ? Qb : leg.b);
      const V x_dot = leg.Q_hat * leg.Omega_i() * leg.Q_hat.transpose() * leg.at.x();
      return values(V(b_dot.cross(leg.at.x()) + Qb.cross(x_dot)), x_dot);
    };
  };
  f.as_printed = reading(false);
  f.that_holds = reading(true);
  f.truth = [](const ReferenceState& at) { return values(at.legs.front().dot.rowOfB()); };
  f.note = "The other rows are printed right; the solver's error is in all six. Enters Ṫ alone, so (36) and not (37).";
  f.formula_errors = {FormulaError::eq26_b_dot};
  f.through_36 = true;
  return f;
}

Formula inverseJacobianRate() {
  Formula f;
  f.equation = "(26) ȧ";
  f.printed = "ȧ = s(ψ̇ + θ̇) cos(ψ+θ)";
  f.holds = "ȧ = s(ψ̇ + θ̇) cos(ψ+θ) − lψ̇ cos ψ";
  f.unit = "m/s";
  const auto reading = [](bool whole) {
    return overLegs([whole](const ReferenceState&, const ReferenceLeg& leg) {
      const S eta = leg.s * (leg.dot.psi() + leg.dot.theta()) * cos(leg.at.psi() + leg.at.theta());
      return values(whole ? S(eta - leg.l * leg.dot.psi() * cos(leg.at.psi())) : eta);
    });
  };
  f.as_printed = reading(false);
  f.that_holds = reading(true);
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(leg.dot.a_ii()); });
  f.note = "(23) differentiated. Read with the dot that is missing over ψ. Enters Ṫ alone, so (36) and not (37).";
  f.formula_errors = {FormulaError::eq26_a_dot};
  f.through_36 = true;
  return f;
}

Formula inverseJacobianRateAsDotted() {
  Formula f = inverseJacobianRate();
  f.equation = "(26) ȧ, ψ";
  f.printed = "ȧ = s(ψ + θ̇) cos(ψ+θ)";
  f.as_printed = overLegs([](const ReferenceState&, const ReferenceLeg& leg) {
    return values(S(leg.s * (leg.at.psi() + leg.dot.theta()) * cos(leg.at.psi() + leg.at.theta())));
  });
  f.note = "To the letter: the dot over ψ is missing in our source, as those over A and B on the left.";
  f.formula_errors = {};
  return f;
}

Formula inverseJacobian() {
  Formula f;
  f.equation = "(23) a";
  f.printed = "a = s sin(ψ+θ)";
  f.holds = "a = s sin(ψ+θ) − l sin ψ";
  f.unit = "m";
  const auto reading = [](bool whole) {
    return overLegs([whole](const ReferenceState&, const ReferenceLeg& leg) {
      const S a = leg.s * sin(leg.at.psi() + leg.at.theta());
      return values(whole ? S(a - leg.l * sin(leg.at.psi())) : a);
    });
  };
  f.as_printed = reading(false);
  f.that_holds = reading(true);
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(leg.at.a_ii()); });
  f.note = "Follows (15a).";
  f.formula_errors = {FormulaError::eq23};
  return f;
}

Formula rowOfLeg() {
  Formula f;
  f.equation = "(21)";
  f.printed = "s φ̇ sin(ψ+θ) = [(Qb × x)ᵀ xᵀ] t_P";
  f.holds = "(s sin(ψ+θ) − l sin ψ)φ̇ = [(Qb × x)ᵀ xᵀ] t_P";
  f.unit = "m/s";
  const auto reading = [](bool whole) {
    return overLegs([whole](const ReferenceState&, const ReferenceLeg& leg) {
      const S a = leg.s * sin(leg.at.psi() + leg.at.theta());
      return values(S((whole ? S(a - leg.l * sin(leg.at.psi())) : a) * leg.dot.phi()));
    });
  };
  f.as_printed = reading(false);
  f.that_holds = reading(true);
  f.truth = overLegs([](const ReferenceState& at, const ReferenceLeg& leg) {
    return values(S(leg.at.rowOfB().dot(at.platform.twist())));
  });
  f.note = "Is (15a); its torques are those of (23).";
  return f;
}

Formula velocityAcross() {
  Formula f;
  f.equation = "(20a)";
  f.printed = "h_x = xᵀ(ṗ + ω × Qb)";
  f.unit = "m/s";
  f.as_printed = overLegs([](const ReferenceState& at, const ReferenceLeg& leg) {
    const V x = leg.Q_hat * leg.Q_i() * V(V::UnitX());
    return values(S(x.dot(at.platform.p_dot + at.platform.omega.cross(at.platform.Q * leg.b))));
  });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(leg.h().x()); });
  return f;
}

Formula velocityAcrossAsRow() {
  Formula f = velocityAcross();
  f.equation = "(20b)";
  f.printed = "h_x = xᵀṗ + (Qb × x)ᵀω";
  f.as_printed = overLegs([](const ReferenceState& at, const ReferenceLeg& leg) {
    const V x = leg.at.x(), Qb = at.platform.Q * leg.b;
    return values(S(x.dot(at.platform.p_dot) + Qb.cross(x).dot(at.platform.omega)));
  });
  return f;
}

Formula jacobians() {
  Formula f;
  f.equation = "(22)";
  f.printed = "A φ̇ = B t_P";
  f.unit = "m/s";
  f.as_printed =
      overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(S(leg.at.a_ii() * leg.dot.phi())); });
  f.truth = [](const ReferenceState& at) {
    return values(stacked(at, [](const ReferenceLeg& leg) { return rowOf(leg.at); }) * at.platform.twist());
  };
  f.note = "With the a of (23) that holds.";
  return f;
}

Formula shaping() {
  Formula f;
  f.equation = "(24)";
  f.printed = "T φ̇ = t_P, T = B⁻¹A";
  f.as_printed = [](const ReferenceState& at) {
    Vector6<S> A;
    for (int i = 0; i < leg_count; ++i) A(i) = at.legs[static_cast<std::size_t>(i)].at.a_ii();
    const Matrix6<S> B = stacked(at, [](const ReferenceLeg& leg) { return rowOf(leg.at); });
    return values(Matrix6<S>(B.partialPivLu().solve(Matrix6<S>(A.asDiagonal()))));
  };
  f.truth = [](const ReferenceState& at) { return values(at.T_P); };
  f.note = "Every entry of T against ∂(pose)/∂φ. With the a of (23) that holds.";
  return f;
}

Formula shapingRate() {
  Formula f;
  f.equation = "(25)";
  f.printed = "T φ̈ + Ṫ φ̇ = ṫ_P, Ṫ = B⁻¹(Ȧ − ḂB⁻¹A)";
  f.unit = "rad/s², m/s²";
  f.as_printed = [](const ReferenceState& at) {
    Vector6<S> A_dot;
    for (int i = 0; i < leg_count; ++i) A_dot(i) = at.legs[static_cast<std::size_t>(i)].dot.a_ii();
    const Matrix6<S> B = stacked(at, [](const ReferenceLeg& leg) { return rowOf(leg.at); });
    const Matrix6<S> B_dot = stacked(at, [](const ReferenceLeg& leg) { return rowOf(leg.dot); });
    const Matrix6<S> T_dot = B.partialPivLu().solve(Matrix6<S>(Matrix6<S>(A_dot.asDiagonal()) - B_dot * at.T_P));
    return values(Vector6<S>(at.T_P * at.phi_ddot() + T_dot * at.phi_dot()));
  };
  f.truth = [](const ReferenceState& at) { return values(at.platform.twistRate()); };
  return f;
}

Formula axisRate() {
  Formula f;
  f.equation = "(26) ẋ";
  f.printed = "ẋ = Q̂ΩQ̂ᵀx";
  f.unit = "1/s";
  f.as_printed = overLegs([](const ReferenceState&, const ReferenceLeg& leg) {
    return values(V(leg.Q_hat * leg.Omega_i() * leg.Q_hat.transpose() * leg.at.x()));
  });
  f.truth = overLegs([](const ReferenceState&, const ReferenceLeg& leg) { return values(leg.dot.x()); });
  return f;
}

}  // namespace

std::vector<Formula> jacobianFormulas() {
  return {velocityAcross(),
          velocityAcrossAsRow(),
          rowOfLeg(),
          jacobians(),
          inverseJacobian(),
          shaping(),
          shapingRate(),
          inverseJacobianRate(),
          inverseJacobianRateAsDotted(),
          forwardJacobianRate(),
          axisRate()};
}

}  // namespace ursula::audit

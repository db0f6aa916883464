// (20)–(26): Jacobians and their rates.

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "parts/audit/formula.h"

namespace ursula::audit {
namespace {

/// B or its rate, from the legs' poses or their rates.
Matrix6<S> rowsOfB(At at, LegPose ReferenceLeg::*pose) {
  Matrix6<S> B;
  for (int i = 0; i < leg_count; ++i) B.row(i) = (at.legs[static_cast<std::size_t>(i)].*pose).rowOfB().transpose();
  return B;
}

/// The diagonal of A or of its rate.
Matrix6<S> diagonalOfA(At at, LegPose ReferenceLeg::*pose) {
  Vector6<S> A;
  for (int i = 0; i < leg_count; ++i) A(i) = (at.legs[static_cast<std::size_t>(i)].*pose).a_ii();
  return A.asDiagonal();
}

/// a of (23), as printed and as it holds.
S aAsPrinted(Of leg) { return leg.s * sin(leg.at.psi() + leg.at.theta()); }
S aThatHolds(Of leg) { return aAsPrinted(leg) - leg.l * sin(leg.at.psi()); }

/// ȧ of (26) as printed, with ψ̇ or with ψ, whose dot is missing.
S aRateAsPrinted(Of leg, const S& psi) { return leg.s * (psi + leg.dot.theta()) * cos(leg.at.psi() + leg.at.theta()); }

/// The six entries of Ḃ's first row, which our source prints without Q.
Values rowOfBRate(At at, const V& turned) {
  Of leg = at.legs.front();
  const V Qb = at.platform.Q * leg.b, b_dot = crossMatrix(at.platform.omega) * turned;
  const V x_dot = leg.Q_hat * leg.Omega_i() * leg.Q_hat.transpose() * leg.at.x();
  return values(V(b_dot.cross(leg.at.x()) + Qb.cross(x_dot)), x_dot);
}

std::vector<Formula> ofRates() {
  Formula a_rate = {
      "(26) ȧ",
      "m/s",
      {"ȧ = s(ψ̇ + θ̇) cos(ψ+θ)", legs([](Of leg) { return aRateAsPrinted(leg, leg.dot.psi()); })},
      {"ȧ = s(ψ̇ + θ̇) cos(ψ+θ) − lψ̇ cos ψ",
       legs([](Of leg) { return S(aRateAsPrinted(leg, leg.dot.psi()) - leg.l * leg.dot.psi() * cos(leg.at.psi())); })},
      legs([](Of leg) { return leg.dot.a_ii(); }),
      "(23) differentiated. Read with the dot that is missing over ψ. Enters Ṫ alone, so (36) and not (37).",
      {FormulaError::eq26_a_dot},
      true};
  Formula as_dotted = a_rate;
  as_dotted.equation = "(26) ȧ, ψ";
  as_dotted.printed = {"ȧ = s(ψ + θ̇) cos(ψ+θ)", legs([](Of leg) { return aRateAsPrinted(leg, leg.at.psi()); })};
  as_dotted.note = "To the letter: the dot over ψ is missing in our source, as those over A and B on the left.";
  as_dotted.errors = {};
  return {
      {"(25)",
       "rad/s², m/s²",
       {"T φ̈ + Ṫ φ̇ = ṫ_P, Ṫ = B⁻¹(Ȧ − ḂB⁻¹A)",
        [](At at) {
          const Matrix6<S> A_dot = diagonalOfA(at, &ReferenceLeg::dot), B_dot = rowsOfB(at, &ReferenceLeg::dot);
          const Matrix6<S> T_dot =
              rowsOfB(at, &ReferenceLeg::at).partialPivLu().solve(Matrix6<S>(A_dot - B_dot * at.T_P));
          return values(Vector6<S>(at.T_P * at.phi_ddot() + T_dot * at.phi_dot()));
        }},
       {},
       [](At at) { return values(at.platform.twistRate()); }},
      std::move(a_rate),
      std::move(as_dotted),
      {"(26) Ḃ",
       "m/s, 1/s",
       {"first row: (Ωb × x + Qb × ẋ)ᵀ, ẋᵀ", [](At at) { return rowOfBRate(at, at.legs.front().b); }},
       {"every row: ((ΩQb) × x + Qb × ẋ)ᵀ, ẋᵀ",
        [](At at) { return rowOfBRate(at, at.platform.Q * at.legs.front().b); }},
       [](At at) { return values(at.legs.front().dot.rowOfB()); },
       "The other rows are printed right; the solver's error is in all six. Enters Ṫ alone, so (36) and not (37).",
       {FormulaError::eq26_b_dot},
       true},
      {"(26) ẋ",
       "1/s",
       {"ẋ = Q̂ΩQ̂ᵀx", legs([](Of leg) { return V(leg.Q_hat * leg.Omega_i() * leg.Q_hat.transpose() * leg.at.x()); })},
       {},
       legs([](Of leg) { return leg.dot.x(); })}};
}

}  // namespace

std::vector<Formula> jacobianFormulas() {
  const Side h_x = legs([](Of leg) { return S(leg.h().x()); });
  std::vector<Formula> all = {
      {"(20a)",
       "m/s",
       {"h_x = xᵀ(ṗ + ω × Qb)", legs([](At at, Of leg) {
          const V x = leg.Q_hat * leg.Q_i() * V(V::UnitX());
          return S(x.dot(at.platform.p_dot + at.platform.omega.cross(at.platform.Q * leg.b)));
        })},
       {},
       h_x},
      {"(20b)",
       "m/s",
       {"h_x = xᵀṗ + (Qb × x)ᵀω", legs([](At at, Of leg) {
          const V x = leg.at.x(), Qb = at.platform.Q * leg.b;
          return S(x.dot(at.platform.p_dot) + Qb.cross(x).dot(at.platform.omega));
        })},
       {},
       h_x},
      {"(21)",
       "m/s",
       {"s φ̇ sin(ψ+θ) = [(Qb × x)ᵀ xᵀ] t_P", legs([](Of leg) { return S(aAsPrinted(leg) * leg.dot.phi()); })},
       {"(s sin(ψ+θ) − l sin ψ)φ̇ = [(Qb × x)ᵀ xᵀ] t_P",
        legs([](Of leg) { return S(aThatHolds(leg) * leg.dot.phi()); })},
       legs([](At at, Of leg) { return S(leg.at.rowOfB().dot(at.platform.twist())); }),
       "Is (15a); its torques are those of (23)."},
      {"(22)",
       "m/s",
       {"A φ̇ = B t_P", legs([](Of leg) { return S(leg.at.a_ii() * leg.dot.phi()); })},
       {},
       [](At at) { return values(Vector6<S>(rowsOfB(at, &ReferenceLeg::at) * at.platform.twist())); },
       "With the a of (23) that holds."},
      {"(23) a",
       "m",
       {"a = s sin(ψ+θ)", legs(aAsPrinted)},
       {"a = s sin(ψ+θ) − l sin ψ", legs(aThatHolds)},
       legs([](Of leg) { return leg.at.a_ii(); }),
       "Follows (15a).",
       {FormulaError::eq23}},
      {"(24)",
       "",
       {"T φ̇ = t_P, T = B⁻¹A",
        [](At at) {
          return values(
              Matrix6<S>(rowsOfB(at, &ReferenceLeg::at).partialPivLu().solve(diagonalOfA(at, &ReferenceLeg::at))));
        }},
       {},
       [](At at) { return values(at.T_P); },
       "Every entry of T against ∂(pose)/∂φ. With the a of (23) that holds."}};
  for (Formula& f : ofRates()) all.push_back(std::move(f));
  return all;
}

}  // namespace ursula::audit

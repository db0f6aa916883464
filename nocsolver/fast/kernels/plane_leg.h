#pragma once

#include <array>
#include <type_traits>

#include "model/leg_kind.h"
#include "nocsolver/fast/kernels/machine_model.h"

// A leg in the plane that contains B and turns about −u by α (for RUS the rod's plane, turning by φ + ψ). It computes
// displacement and map, with angles only as sines and cosines. Internal. leg_forces.h shows the plane's use. legs/
// computes the same in B from angles, and is the independent reference.
//
// Components are along x, u, z of the plane: from A to B (0, k_y, r), v_B = h. Rows of the map, q̇ⱼ = kⱼ · h:
//   UPS  φ: (−1/r, 0, 0)   ψ: (0, −S, C)/d                  d: (0, C, S)
//   PUS  d: (0, 1, r/p)    ψ: (−1/r, 0, 0)                  θ: (0, 0, 1/p),  p = s cos θ
//   URS  φ: (−1/r, 0, 0)   ψ: −(0, C₂, S₂)/(l sin θ)        θ: (0, k_y, r)/(l s sin θ),  second link along (0, C₂, S₂)
//   RUS  φ: (0, k_y/c, 1)/(l sin ψ)   ψ: −(1, k_y cos ψ/(c sin ψ), cos ψ/sin ψ)/c − that of φ   θ: (0, 1/c, 0),  c = s
//   cos θ

namespace ursula::kernel {

using Urs = std::integral_constant<LegKind, LegKind::URS>;
using Ups = std::integral_constant<LegKind, LegKind::UPS>;
using Rus = std::integral_constant<LegKind, LegKind::RUS>;
using Pus = std::integral_constant<LegKind, LegKind::PUS>;

/// Calls f with the leg's kind as a constant.
template <class F>
auto withKind(LegKind kind, const F& f) {
  switch (kind) {
    case LegKind::UPS:
      return f(Ups{});
    case LegKind::RUS:
      return f(Rus{});
    case LegKind::PUS:
      return f(Pus{});
    case LegKind::URS:
      break;
  }
  return f(Urs{});
}

template <class S>
struct PlaneLeg {
  S cosine, sine;        ///< of α
  S C_1, S_1, C_2, S_2;  ///< directions of the links in the plane; (1, 0) for a carriage, cos ψ, sin ψ for a crank
  S y, z;                ///< from A to B in the plane; for RUS from R
  std::array<Vector3<S>, 3> k;    ///< rows of the map
  std::array<S, 3> lever;         ///< 1/|kⱼ|, or of similar size
  Vector3<S> rate, acceleration;  ///< of the coordinates
  S d;                            ///< for UPS and PUS, m
};

/// Converts components along F̂ to components in the plane.
template <class S>
Vector3<S> toPlane(const PlaneLeg<S>& leg, const Vector3<S>& v) {
  return {leg.cosine * v.x() + leg.sine * v.z(), v.y(), leg.cosine * v.z() - leg.sine * v.x()};
}

/// The non-zero components of a row of the map: 1 for x, 2 for u, 4 for z.
constexpr std::array<int, 3> rowOfMap(Urs) { return {1, 6, 6}; }
constexpr std::array<int, 3> rowOfMap(Ups) { return {1, 6, 6}; }
constexpr std::array<int, 3> rowOfMap(Rus) { return {6, 7, 2}; }
constexpr std::array<int, 3> rowOfMap(Pus) { return {6, 1, 4}; }

template <class S>
void turnToB(const S& k_x, const S& k_z, const S& per_r, PlaneLeg<S>& out) {
  out.sine = -k_x * per_r;
  out.cosine = k_z * per_r;
}

/// `k` is AB along F̂; `guard` checks the requirements (leg_guard.h).
template <class S, class Guard>
void place(Ups, const PlaneModel<S>& leg, const Vector3<S>& k, Guard& guard, PlaneLeg<S>& out) {
  using std::sqrt;
  const S r2 = k.x() * k.x() + k.z() * k.z(), r = sqrt(r2), d = sqrt(r2 + k.y() * k.y());
  guard.stroke(d, leg.s, leg.s + leg.l);
  guard.offAxis(r, leg.l + leg.s);
  const S per_both = S(1) / (r * d), per_r = d * per_both, per_d = r * per_both;  // division is expensive
  turnToB(k.x(), k.z(), per_r, out);
  out.C_1 = out.C_2 = k.y() * per_d;
  out.S_1 = out.S_2 = r * per_d;
  out.y = k.y();
  out.z = r;
  out.d = d;
  out.k = {Vector3<S>(-per_r, S(0), S(0)), Vector3<S>(S(0), -out.S_1 * per_d, out.C_1 * per_d),
           Vector3<S>(S(0), out.C_1, out.S_1)};
  out.lever = {r, d, S(1)};
}

template <class S, class Guard>
void place(Pus, const PlaneModel<S>& leg, const Vector3<S>& k, Guard& guard, PlaneLeg<S>& out) {
  using std::abs;
  using std::sqrt;
  const S r2 = k.x() * k.x() + k.z() * k.z(), r = sqrt(r2), square = (leg.s - r) * (leg.s + r);
  guard.reach(square, r2, leg.s);
  guard.offAxis(r, leg.s);
  const S p = leg.knee * sqrt(square), per_both = S(1) / (r * p), per_r = p * per_both, per_p = r * per_both;
  guard.regular(p * leg.per_s, "has its rod across its rail, |cos theta|");
  turnToB(k.x(), k.z(), per_r, out);
  out.C_1 = S(1);
  out.S_1 = S(0);
  out.C_2 = p * leg.per_s;
  out.S_2 = r * leg.per_s;
  out.y = p;
  out.z = r;
  out.d = k.y() - p;
  out.k = {Vector3<S>(S(0), S(1), r * per_p), Vector3<S>(-per_r, S(0), S(0)), Vector3<S>(S(0), S(0), per_p)};
  out.lever = {abs(out.C_2), r, abs(p)};
}

template <class S, class Guard>
void place(Urs, const PlaneModel<S>& leg, const Vector3<S>& k, Guard& guard, PlaneLeg<S>& out) {
  using std::abs;
  using std::sqrt;
  const S r2 = k.x() * k.x() + k.z() * k.z(), r = sqrt(r2), q2 = r2 + k.y() * k.y();
  // Computes 1 ∓ cos θ without the cancellation of (4a) near a stretched or folded leg.
  const S difference = leg.l - leg.s, sum = leg.l + leg.s, per_ls = leg.per_l * leg.per_s, half = S(0.5) * per_ls;
  const S one_minus = (q2 - difference * difference) * half, one_plus = (sum * sum - q2) * half;
  guard.reach(one_minus, q2, difference);
  guard.reach(one_plus, q2, sum);
  guard.offAxis(r, sum);
  const S cos_theta = S(0.5) * (one_plus - one_minus), sin_theta = leg.knee * sqrt(one_minus * one_plus);
  guard.regular(sin_theta, "is stretched or folded, |sin theta|");
  const S r_sine = r * sin_theta, per_all = S(1) / (r_sine * q2);
  const S per_q2 = r_sine * per_all, per_r = sin_theta * q2 * per_all, per_sine = r * q2 * per_all;
  turnToB(k.x(), k.z(), per_r, out);
  // Turns AB to the first link by the angle with sine s sin θ and cosine l − s cos θ, both over q.
  const S across = leg.s * sin_theta * per_q2, along = (leg.l - leg.s * cos_theta) * per_q2;
  out.C_1 = along * k.y() - across * r;
  out.S_1 = across * k.y() + along * r;
  out.C_2 = -(out.C_1 * cos_theta - out.S_1 * sin_theta);
  out.S_2 = -(out.S_1 * cos_theta + out.C_1 * sin_theta);
  out.y = k.y();
  out.z = r;
  out.d = S(0);
  const S psi = -leg.s * per_ls * per_sine, theta = per_ls * per_sine;
  out.k = {Vector3<S>(-per_r, S(0), S(0)), Vector3<S>(S(0), psi * out.C_2, psi * out.S_2),
           Vector3<S>(S(0), theta * k.y(), theta * r)};
  const S size = abs(leg.l * sin_theta);
  out.lever = {r, size, size * leg.s * (r + abs(k.y())) * per_q2};
}

template <class S, class Guard>
void place(Rus, const PlaneModel<S>& leg, const Vector3<S>& k, Guard& guard, PlaneLeg<S>& out) {
  using std::abs;
  using std::sqrt;
  const S r2 = k.x() * k.x() + k.z() * k.z(), c2 = (leg.s - k.y()) * (leg.s + k.y()), c = sqrt(c2);
  guard.reach(c2, k.y() * k.y(), leg.s);
  const S per_c = S(1) / c, half = S(0.5) * leg.per_l * per_c;
  const S difference = leg.l - c, sum = leg.l + c;
  const S one_plus = (r2 - difference * difference) * half, one_minus = (sum * sum - r2) * half;
  guard.reach(one_minus, r2, sum);
  guard.reach(one_plus, r2, difference);
  const S r = sqrt(r2);
  guard.offAxis(r, leg.l + leg.s);
  const S cos_psi = S(0.5) * (one_plus - one_minus), sin_psi = leg.knee * sqrt(one_minus * one_plus);
  guard.regular(sin_psi, "is stretched or folded, |sin psi|");
  guard.regular(c * leg.per_s, "has its rod along the axis of its crank, cos theta");
  // Turns B's plane to the rod's by the angle with sine l sin ψ and cosine c + l cos ψ, both over r.
  const S per_both = S(1) / (r2 * sin_psi), per_r2 = sin_psi * per_both, per_sine = r2 * per_both;
  const S on_sine = leg.l * sin_psi * per_r2, on_cosine = (c + leg.l * cos_psi) * per_r2;
  out.sine = on_sine * k.z() - on_cosine * k.x();
  out.cosine = on_cosine * k.z() + on_sine * k.x();
  out.C_1 = cos_psi;
  out.S_1 = sin_psi;
  out.C_2 = k.y() * leg.per_s;
  out.S_2 = c * leg.per_s;
  out.y = k.y();
  out.z = c;
  out.d = S(0);
  const S phi = per_sine * leg.per_l, slope = k.y() * per_c;
  const S psi = -per_c * cos_psi * per_sine - phi;
  out.k = {Vector3<S>(S(0), slope * phi, phi), Vector3<S>(-per_c, slope * psi, psi), Vector3<S>(S(0), per_c, S(0))};
  const S size = abs(leg.l * sin_psi) * c * leg.per_s;
  out.lever = {size, c * size * leg.per_sum, c};
}

}  // namespace ursula::kernel

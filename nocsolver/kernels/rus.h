#pragma once

// Crank and rod (Hexa). Internal.
//
//   AB = l z + s⃗,  s⃗ = s (sin θ u + cos θ z₂),  z of F = F̂R(φ), z₂ of F₂ = F̂R(φ + ψ)
//   sin θ = k_y / s;  across u a plane linkage of l and c = s cos θ:
//   cos ψ = (r² − l² − c²)/(2 l c),  φ = atan2(−k_x, k_z) − atan2(c sin ψ, l + c cos ψ)
//   v_B = −φ̇ l x − (φ̇ + ψ̇) c x₂ + θ̇ (c u − k_y z₂)                                        (a)
// (a) times s⃗ leaves φ̇ alone, times u leaves θ̇, times z and θ̇ put in leaves φ̇ + ψ̇.

#include "nocsolver/kernels/chain_frame.h"

namespace ursula::kernel {

template <class S>
void rusDisplacement(const ChainModel<S>& leg, int index, const S& t, ChainState<S>& out) {
  using std::abs;
  using std::sqrt;
  const InAxes<S> B = inAxes(leg, out.AB);
  const S c2 = (leg.s - B.k_y) * (leg.s + B.k_y);
  requireReach(c2 > S(0), index, t, S(abs(B.k_y)), leg.s);
  const S c = sqrt(c2), sin_theta = B.k_y / leg.s, cos_theta = c / leg.s;
  const S two_lc = S(2) * leg.l * c, difference = leg.l - c, sum = leg.l + c;
  const S one_plus = (B.r * B.r - difference * difference) / two_lc, one_minus = (sum * sum - B.r * B.r) / two_lc;
  requireReach(one_minus >= S(0), index, t, B.r, sum);
  requireReach(one_plus >= S(0), index, t, B.r, S(abs(difference)));
  requireOffAxis(B.r, S(leg.l + leg.s), index, t);
  const S cos_psi = (one_plus - one_minus) / S(2), sin_psi = leg.knee * sqrt(one_minus * one_plus);
  const S sin_1 = c * sin_psi / B.r, cos_1 = (leg.l + c * cos_psi) / B.r;
  const S sin_2 = -B.k_x / B.r, cos_2 = B.k_z / B.r;
  const Plane<S> F = planeAt<S>(leg, sin_2 * cos_1 - cos_2 * sin_1, cos_2 * cos_1 + sin_2 * sin_1);
  const Vector3<S> x_2 = cos_psi * F.x + sin_psi * F.z, z_2 = cos_psi * F.z - sin_psi * F.x;
  out.sine = {F.sine, sin_psi, sin_theta};
  out.cosine = {F.cosine, cos_psi, cos_theta};
  out.axis = {-leg.u, -leg.u, -x_2};
  setLinks<S>(F.x, F.z, x_2, sin_theta * leg.u + cos_theta * z_2, out);
  out.margins = {abs(sin_psi), S(1) / cos_theta};
}

template <class S>
void rusMap(const ChainModel<S>& leg, int index, const S& t, ChainState<S>& out) {
  requireRegular(out.margins.sine, "is stretched or folded, |sin psi|", index, t);
  requireRegular(out.cosine[2], "has its rod along the axis of its crank, cos theta", index, t);
  const Vector3<S> z = out.along_1;
  const S c = leg.s * out.cosine[2], k_y = leg.s * out.sine[2], &sin_psi = out.sine[1], &cos_psi = out.cosine[1];
  out.k[0] = (leg.s / (c * leg.l * sin_psi)) * out.along_2;  // (a)
  out.k[2] = leg.u / c;
  out.k[1] = -(z + (k_y * cos_psi / c) * leg.u) / (c * sin_psi) - out.k[0];
}

}  // namespace ursula::kernel

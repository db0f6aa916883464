#pragma once

// The telescopic leg of the paper's Fig. 1. Internal.
//
//   AB = d e,  e = [0, cos ψ, sin ψ] in F = F̂R(φ):  d = ‖k‖,  φ = atan2(−k_x, k_z),  ψ = atan2(r, k_y)
//   v_B = −φ̇ r x + ψ̇ d (x × e) + ḋ e                                                       (a)
// The rod's inner end is d − s from A and stays within the cylinder: s < d < s + l.

#include "nocsolver/kernels/chain_frame.h"

namespace ursula::kernel {

template <class S>
void upsDisplacement(const ChainModel<S>& leg, int index, const S& t, ChainState<S>& out) {
  using std::sqrt;
  const InAxes<S> B = inAxes(leg, out.AB);
  const S d = sqrt(B.r * B.r + B.k_y * B.k_y);
  requireStroke(d > leg.s, index, t, d, leg.s);
  requireStroke(d < leg.s + leg.l, index, t, d, S(leg.s + leg.l));
  requireOffAxis(B.r, S(leg.l + leg.s), index, t);
  const Plane<S> F = planeOf(leg, B);
  const S sin_psi = B.r / d, cos_psi = B.k_y / d;
  const Vector3<S> e = cos_psi * leg.u + sin_psi * F.z;
  out.sine = {F.sine, sin_psi, S(0)};
  out.cosine = {F.cosine, cos_psi, d};
  out.axis = {-leg.u, F.x, e};
  setLinks<S>(F.x, e, F.x, e, out);
  out.margins = {S(1), d / B.r};
}

template <class S>
void upsMap(ChainState<S>& out) {
  const Vector3<S>& x = out.axis[1];
  const S &d = out.cosine[2], &sin_psi = out.sine[1];
  out.k[0] = -x / (d * sin_psi);        // (a)
  out.k[1] = x.cross(out.axis[2]) / d;  // (a)
  out.k[2] = out.axis[2];               // (a)
}

}  // namespace ursula::kernel

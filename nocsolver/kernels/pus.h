#pragma once

// Carriage and rod (Hexaglide). Internal.
//
//   AB = d u + s⃗,  s⃗ = s (cos θ u + sin θ z),  z of F = F̂R(ψ):  ψ = atan2(−k_x, k_z),  s sin θ = r,  d = k_y − s cos θ
//   v_B = ḋ u − ψ̇ r x + θ̇ s (cos θ z − sin θ u)                                            (a)

#include "nocsolver/kernels/chain_frame.h"

namespace ursula::kernel {

template <class S>
void pusDisplacement(const ChainModel<S>& leg, int index, const S& t, ChainState<S>& out) {
  using std::abs;
  using std::sqrt;
  const InAxes<S> B = inAxes(leg, out.AB);
  const S square = (leg.s - B.r) * (leg.s + B.r);
  requireReach(square >= S(0), index, t, B.r, leg.s);
  requireOffAxis(B.r, leg.s, index, t);
  const S along = leg.knee * sqrt(square);  // s cos θ
  const S d = B.k_y - along, sin_theta = B.r / leg.s, cos_theta = along / leg.s;
  const Plane<S> F = planeOf(leg, B);
  out.sine = {S(0), F.sine, sin_theta};
  out.cosine = {d, F.cosine, cos_theta};
  out.axis = {leg.u, -leg.u, F.x};
  setLinks<S>(F.x, leg.u, F.x, cos_theta * leg.u + sin_theta * F.z, out);
  out.margins = {abs(cos_theta), S(1) / sin_theta};
}

template <class S>
void pusMap(const ChainModel<S>& leg, int index, const S& t, ChainState<S>& out) {
  requireRegular(out.margins.sine, "has its rod across its rail, |cos theta|", index, t);
  const Vector3<S>& x = out.axis[2];
  const Vector3<S> z = x.cross(leg.u);
  const S &sin_theta = out.sine[2], &cos_theta = out.cosine[2];
  out.k[0] = leg.u + (sin_theta / cos_theta) * z;  // (a)
  out.k[1] = -x / (leg.s * sin_theta);
  out.k[2] = z / (leg.s * cos_theta);
}

}  // namespace ursula::kernel

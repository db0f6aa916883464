#pragma once

// The paper's leg as a chain, and URS's displacement: (3), (4a), (13), (14) as in leg_kinematics.h, its map to B
// (4b), (15a,b). Internal.
//
//   AB = l e + s,  e = [0, cos ψ, sin ψ],  s = −s [0, cos(ψ+θ), sin(ψ+θ)]  in F = F̂R(φ)

#include "nocsolver/kernels/chain_frame.h"

namespace ursula::kernel {

template <class S>
void ursDisplacement(const ChainModel<S>& leg, int index, const S& t, ChainState<S>& out) {
  using std::abs;
  using std::sqrt;
  const InAxes<S> B = inAxes(leg, out.AB);
  const S q2 = B.r * B.r + B.k_y * B.k_y, q = sqrt(q2);
  // 1 ∓ cos θ without the cancellation of (4a) near a stretched or folded leg.
  const S two_ls = S(2) * leg.l * leg.s, difference = leg.l - leg.s, sum = leg.l + leg.s;
  const S one_minus = (q2 - difference * difference) / two_ls, one_plus = (sum * sum - q2) / two_ls;
  requireReach(one_minus >= S(0), index, t, q, S(abs(difference)));
  requireReach(one_plus >= S(0), index, t, q, sum);
  requireOffAxis(B.r, sum, index, t);
  const S cos_theta = (one_plus - one_minus) / S(2), sin_theta = leg.knee * sqrt(one_minus * one_plus);
  const S sin_1 = leg.s * sin_theta / q, cos_1 = (leg.l - leg.s * cos_theta) / q;
  const S sin_2 = B.r / q, cos_2 = B.k_y / q;
  const S sin_psi = sin_1 * cos_2 + cos_1 * sin_2, cos_psi = cos_1 * cos_2 - sin_1 * sin_2;
  const S sin_sum = sin_psi * cos_theta + cos_psi * sin_theta, cos_sum = cos_psi * cos_theta - sin_psi * sin_theta;

  const Plane<S> F = planeOf(leg, B);
  out.sine = {F.sine, sin_psi, sin_theta};
  out.cosine = {F.cosine, cos_psi, cos_theta};
  out.axis = {-leg.u, F.x, F.x};
  setLinks<S>(F.x, cos_psi * leg.u + sin_psi * F.z, F.x, -cos_sum * leg.u - sin_sum * F.z, out);
  out.margins = {abs(sin_theta), q / B.r};
}

template <class S>
void ursMap(const ChainModel<S>& leg, int index, const S& t, ChainState<S>& out) {
  requireRegular(out.margins.sine, "is stretched or folded, |sin theta|", index, t);
  const Vector3<S>& x = out.axis[1];
  const Vector3<S> z = x.cross(leg.u);
  const S lever = -leg.s * out.along_2.dot(z);  // s sin(ψ+θ)
  const S distance = -out.AB.dot(z);
  const S per_ls = S(1) / (leg.l * leg.s * out.sine[2]);
  const S theta_y = out.AB.dot(leg.u) * per_ls, theta_z = -distance * per_ls;
  out.k[0] = x / distance;
  out.k[1] = ((S(1) - lever * theta_y) / distance) * leg.u - (lever * theta_z / distance) * z;
  out.k[2] = theta_y * leg.u + theta_z * z;
}

}  // namespace ursula::kernel

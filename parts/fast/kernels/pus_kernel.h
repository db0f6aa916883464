#pragma once

// The fast kernel of a PUS leg, carriage and rod, in its plane (plane_leg.h). Internal. Rows of the map, q̇ⱼ = kⱼ · h:
//   d: (0, 1, r/p)   ψ: (−1/r, 0, 0)   θ: (0, 0, 1/p),  p = s cos θ

#include <array>
#include <type_traits>

#include "model/leg_kind.h"
#include "parts/fast/kernels/link_terms.h"
#include "parts/fast/kernels/off_line.h"

namespace ursula::kernel {

using Pus = std::integral_constant<LegKind, LegKind::PUS>;

/// The non-zero components of a row of the map: 1 for x, 2 for u, 4 for z.
constexpr std::array<int, 3> rowOfMap(Pus) { return {6, 1, 4}; }

/// `k` is AB along F̂; `guard` checks the requirements (leg_kernels.h).
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

/// h = [−ψ̇ z, ḋ − z θ̇, y θ̇], y = s cos θ, z = s sin θ.
template <class S>
void setRates(Pus, const PlaneModel<S>&, const Vector3<S>& h, const Vector3<S>& a, PlaneLeg<S>& leg) {
  const S &per_z = leg.k[1].x(), &per_y = leg.k[2].z(), &z = leg.z, &y = leg.y;
  const S psi = h.x() * per_z, theta = h.z() * per_y, d_dot = h.y() + z * theta;
  const S theta_2 = theta * theta;
  const S psi_ddot = (a.x() + S(2) * psi * h.z()) * per_z;
  const S theta_ddot = (a.z() + (psi * psi + theta_2) * z) * per_y;
  const S d_ddot = a.y() + z * theta_ddot + y * theta_2;
  leg.rate = {d_dot, psi, theta};
  leg.acceleration = {d_ddot, psi_ddot, theta_ddot};
}

template <bool principal, class S>
Vector3<S> linkForces(Pus, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  const Vector3<S> carried(base.x(), base.y() + leg.acceleration(0), base.z());
  const LinkTurn<S> turn{leg.C_2, leg.S_2, ratesOf(leg, 2), ratesOf(leg, 1)};
  const LinkMoment<S> rod = linkMoment<principal, S>(model.first_2, model.J_2, turn, carried);
  const S along = (model.mass_1 + model.mass_2) * carried.y() + turning<S>(model.first_2, turn).y();
  return {along, -rod.n_y, rod.n_x};
}

/// A carriage does not turn, so the place of its mass does not matter.
template <class S>
OffLinks<S> offLinks(Pus, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  const Vector3<S> x = Vector3<S>::UnitX(), u = Vector3<S>::UnitY(), s(S(0), leg.C_2, leg.S_2);
  const OffTurn<S> none = offTurn<S>(leg, Vector3<S>::Zero(), Vector3<S>::Zero());
  const OffTurn<S> turn = offTurn<S>(leg, Vector3<S>::UnitY(), Vector3<S>::UnitZ());
  OffEnd<S> carriage{base + leg.acceleration(0) * u, Matrix3<S>::Zero()};
  carriage.V.col(0) = u;
  return {carriage.link(model.mass_1, Vector3<S>::Zero(), x, u, S(0), none),
          carriage.link(model.mass_2, model.off_2, x, s, model.sigma, turn)};
}

/// In d, ψ, θ.
template <class S>
Matrix3<S> massMatrix(Pus, const PlaneModel<S>& model, const PlaneLeg<S>& leg) {
  const auto rod = crossInertia<S>(model.J_2, leg.C_2, leg.S_2);
  return symmetric<S>(model.mass_1 + model.mass_2, S(0), -model.first_2 * leg.S_2, rod.J, -rod.P, rod.x);
}

}  // namespace ursula::kernel

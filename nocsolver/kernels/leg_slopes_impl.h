#pragma once

// Bodies of leg_slopes.h for one instruction set. Internal; included by sources that are compiled for that set. What
// they share with others are plain numbers: no function of doubles may be made here, or the linker might take it for
// all.

#include "nocsolver/kernels/leg_slopes.h"
#include "nocsolver/kernels/plane_dynamics.h"
#include "nocsolver/kernels/tangents.h"

namespace ursula::kernel {

/// Keeps what is refused first; who asked throws it, as LegGuard would have.
template <class S>
struct FaultGuard {
  LegFault fault;

  void reach(const S& inside, const S& square, const S& bound) {
    if (!(inside.v >= 0)) keep(LegFault::out_of_reach, std::sqrt(square.v), std::abs(bound.v), nullptr);
  }
  void stroke(const S& d, const S& least, const S& most) {
    if (!(d.v > least.v)) keep(LegFault::end_of_stroke, d.v, least.v, nullptr);
    if (!(d.v < most.v)) keep(LegFault::end_of_stroke, d.v, most.v, nullptr);
  }
  void offAxis(const S& r, const S& size) {
    if (!(r.v > root_eps * size.v)) keep(LegFault::point_on_axis, r.v, size.v, nullptr);
  }
  void regular(const S& sine, const char* what) {
    if (!(std::abs(sine.v) > root_eps)) keep(LegFault::stretched_leg, std::abs(sine.v), 0, what);
  }

 private:
  static constexpr double root_eps = 0x1p-26;
  void keep(LegFault::Kind kind, double measure, double bound, const char* what) {
    if (fault.kind == LegFault::none) fault = {kind, measure, bound, what};
  }
};

template <class S>
Vector3<S> three(const double* from) {
  return {S(from[0]), S(from[1]), S(from[2])};
}

template <class S>
void setModel(const LegNumbers& from, ChainModel<S>& to) {
  to.kind = from.kind;
  to.motor = from.motor;
  to.x_hat = three<S>(from.axes);
  to.u = three<S>(from.axes + 3);
  to.z_hat = three<S>(from.axes + 6);
  to.l = S(from.l);
  to.s = S(from.s);
  to.knee = S(from.knee);
  to.rho = S(from.rho);
  to.sigma = S(from.sigma);
  to.mass_1 = S(from.mass_1);
  to.mass_2 = S(from.mass_2);
  for (int k = 0; k < 9; ++k) {
    to.I_1.data()[k] = S(from.I_1[k]);
    to.I_2.data()[k] = S(from.I_2[k]);
  }
  for (std::size_t j = 0; j < 3; ++j) {
    to.viscous[j] = S(from.viscous[j]);
    to.coulomb[j] = S(from.smooth[j]);
    to.speed[j] = S(from.speed[j]);
  }
}

/// As moveLeg of plane_dynamics.h, from the motion of B. Vectors along x_hat, u, z_hat.
template <class S, class Guard>
Vector3<S> legLoads(const ChainModel<S>& model, const LegNumbers& leg, const Vector3<S>& AB, const Vector3<S>& v,
                    const Vector3<S>& a, const Vector3<S>& lift, Guard& guard, PlaneLeg<S>& plane) {
  place<S>(model, AB, guard, plane);
  setRates<S>(model, toPlane<S>(plane, v), toPlane<S>(plane, a), plane);
  Vector3<S> Q = linkForces<S>(model, toPlane<S>(plane, lift), plane);
  if (leg.rubs) Q += friction<S>(model, leg.coulomb, plane);
  return Q;
}

template <class S>
S tangent(double value, const double* three_of_them, int first) {
  double lanes[S::T::lanes] = {};
  for (int k = 0; k < 3; ++k) lanes[first + k] = three_of_them[k];
  return {value, S::T::load(lanes)};
}

template <class S>
void put(const Vector3<S>& from, std::array<Slope, 3>& to) {
  for (int k = 0; k < 3; ++k) from(k).d.store(to[static_cast<std::size_t>(k)].data());
}

/// From the plane to B.
template <class S>
Vector3<S> slopesInBase(const LegNumbers& leg, const PlaneLeg<S>& plane, const Vector3<S>& v) {
  const Vector3<S> f = fromPlane<S>(plane, v);
  Vector3<S> out;
  for (int k = 0; k < 3; ++k) {
    out(k).v = leg.axes[k] * f.x().v + leg.axes[3 + k] * f.y().v + leg.axes[6 + k] * f.z().v;
    out(k).d = leg.axes[k] * f.x().d + leg.axes[3 + k] * f.y().d + leg.axes[6 + k] * f.z().d;
  }
  return out;
}

template <class S>
void slopesOfLeg(const LegNumbers& leg, const TipMotion& motion, LegSlopes& out) {
  ChainModel<S> model;
  setModel(leg, model);
  Vector3<S> AB, v;
  for (int k = 0; k < 3; ++k) {
    AB(k) = tangent<S>(motion.AB[k], leg.axes + 3 * k, 0);
    v(k) = tangent<S>(motion.v[k], leg.axes + 3 * k, 3);
  }
  FaultGuard<S> guard;
  PlaneLeg<S> plane;
  const Vector3<S> Q = legLoads<S>(model, leg, AB, v, three<S>(motion.a), three<S>(leg.lift), guard, plane);
  out.fault = guard.fault;
  out.cosine = plane.cosine.v, out.sine = plane.sine.v;
  out.C_1 = plane.C_1.v, out.S_1 = plane.S_1.v, out.C_2 = plane.C_2.v, out.S_2 = plane.S_2.v, out.d = plane.d.v;
  put(Q, out.d_Q);
  Vector3<S> force(S(0), S(0), S(0));
  for (std::size_t j = 0; j < 3; ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    out.Q[j] = Q(at).v;
    for (std::size_t k = 0; k < 3; ++k) out.k[j][k] = plane.k[j](static_cast<Eigen::Index>(k)).v;
    if (leg.motor[j] < 0)
      force += Q(at) * plane.k[j];
    else
      put(slopesInBase<S>(leg, plane, plane.k[j]), out.d_row[j]);
  }
  const Vector3<S> in_base = slopesInBase<S>(leg, plane, force);
  put(in_base, out.d_force);
  for (std::size_t k = 0; k < 3; ++k) out.force[k] = in_base(static_cast<Eigen::Index>(k)).v;
}

template <class Isa>
__attribute__((flatten)) bool legsByState(const LegNumbers* legs, const TipMotion* motions, int count, LegSlopes* out) {
  for (int i = 0; i < count; ++i) {
    slopesOfLeg<Dual<Isa, 6>>(legs[i], motions[i], out[i]);
    if (out[i].fault.kind != LegFault::none) return false;
  }
  return true;
}

template <class Isa>
__attribute__((flatten)) void platformSlopes(const PlatformNumbers& platform, const double* Q, const double* omega,
                                             const double* omega_dot, const double* p_ddot, PlatformSlopes& out) {
  using S = Dual<Isa, 12>;
  MachineModel<S> machine;
  machine.mass = S(platform.mass);
  machine.rho = three<S>(platform.rho);
  machine.gravity = three<S>(platform.gravity);
  for (int k = 0; k < 9; ++k) machine.I_M.data()[k] = S(platform.I_M[k]);
  Motion<S> motion;
  for (int k = 0; k < 3; ++k) {
    const auto seed = [k](double value, int first) {
      double lanes[S::T::lanes] = {};
      lanes[first + k] = 1;
      return S(value, S::T::load(lanes));
    };
    motion.omega(k) = seed(omega[k], 3);
    motion.omega_dot(k) = seed(omega_dot[k], 6);
    motion.p_ddot(k) = seed(p_ddot[k], 9);
    const double *q = Q + 3 * k, turned[3][3] = {{0, q[2], -q[1]}, {-q[2], 0, q[0]}, {q[1], -q[0], 0}};
    for (int row = 0; row < 3; ++row) motion.Q(row, k) = tangent<S>(q[row], turned[row], 0);
  }
  const Vector6<S> wrench = platformLoad<S>(machine, motion, Carried<S>(motion));
  for (std::size_t row = 0; row < 6; ++row) {
    const S& entry = wrench(static_cast<Eigen::Index>(row));
    out.wrench[row] = entry.v;
    entry.d.store(out.d_wrench[row].data());
  }
}

template <class Isa>
constexpr SlopeFunctions slopeFunctions() {
  return {&legsByState<Isa>, &platformSlopes<Isa>};
}

}  // namespace ursula::kernel

#pragma once

// A leg's share of inverse dynamics with derivatives carried along. Internal; included by sources that are compiled for
// one instruction set. What they share with others are plain numbers: no function of doubles may be made here, or the
// linker might take it for all.
//
// At a given μ, the loads that the motors put on the platform's equilibrium, a leg is a force f at B, in B:
//   f = Σ Qⱼ kⱼ of what no motor drives − Σ μₘ kₘ of what motors drive                            (a)

#include "nocsolver/kernels/guard_bounds.h"
#include "nocsolver/kernels/plane_dynamics.h"
#include "nocsolver/kernels/slope_functions.h"
#include "nocsolver/kernels/tangents.h"

namespace ursula::kernel {

/// Keeps what is refused first; who asked throws it, as LegGuard would have.
template <class S>
class RefusalGuard {
 public:
  explicit RefusalGuard(int leg) { refusal_.leg = leg; }

  void reach(const S& inside, const S& square, const S& bound) {
    if (!(inside.v >= 0)) keep(PoseFault::out_of_reach, std::sqrt(square.v), std::abs(bound.v), nullptr);
  }
  void stroke(const S& d, const S& least, const S& most) {
    if (!(d.v > least.v)) keep(PoseFault::end_of_stroke, d.v, least.v, nullptr);
    if (!(d.v < most.v)) keep(PoseFault::end_of_stroke, d.v, most.v, nullptr);
  }
  void offAxis(const S& r, const S& size) {
    if (!(r.v > root_eps * size.v)) keep(PoseFault::point_on_axis, r.v, size.v, nullptr);
  }
  void regular(const S& sine, const char* what) {
    if (!(std::abs(sine.v) > root_eps)) keep(PoseFault::stretched_leg, std::abs(sine.v), 0, what);
  }
  const Refusal& refusal() const { return refusal_; }

 private:
  void keep(PoseFault kind, double measure, double bound, const char* what) {
    if (refusal_.kind == PoseFault::none) refusal_ = {kind, refusal_.leg, measure, bound, what};
  }
  Refusal refusal_;
};

template <class S>
Vector3<S> three(const double* from) {
  return {S(from[0]), S(from[1]), S(from[2])};
}
template <class S>
Matrix3<S> nine(const double* from) {
  Matrix3<S> out;
  for (int k = 0; k < 9; ++k) out.data()[k] = S(from[k]);
  return out;
}

/// A value with the tangents that `lanes` holds.
template <class S>
S tangent(double value, const double* lanes) {
  return {value, S::T::load(lanes)};
}

template <class S>
ChainModel<S> chainOf(const LegNumbers& from) {
  ChainModel<S> to;
  to.kind = from.kind;
  to.motor = from.motor;
  to.x_hat = three<S>(from.x_hat);
  to.u = three<S>(from.u);
  to.z_hat = three<S>(from.z_hat);
  to.a = three<S>(from.a);
  to.b = three<S>(from.b);
  to.l = S(from.l);
  to.s = S(from.s);
  to.knee = S(from.knee);
  to.rho = S(from.rho);
  to.sigma = S(from.sigma);
  to.mass_1 = S(from.mass_1);
  to.mass_2 = S(from.mass_2);
  to.I_1 = nine<S>(from.I_1);
  to.I_2 = nine<S>(from.I_2);
  for (std::size_t j = 0; j < 3; ++j) {
    to.viscous[j] = S(from.viscous[j]);
    to.coulomb[j] = S(from.smooth[j]);
    to.speed[j] = S(from.speed[j]);
  }
  return to;
}

template <class S>
PlaneModel<S> modelOf(const LegNumbers& from, const Vector3<S>& gravity) {
  PlaneModel<S> to = planeModel<S>(chainOf<S>(from), gravity);
  to.rubs = from.rubs;
  to.rubs_dry = from.rubs_dry;
  to.principal = from.principal;
  return to;
}

/// As moveLegs of plane_dynamics.h, from the motion of B, v and a in B: the leg in its plane, and what falls on its
/// coordinates.
template <class S, class Kind, class Guard>
Vector3<S> legLoads(Kind kind, const PlaneModel<S>& model, const Vector3<S>& AB, const Vector3<S>& v,
                    const Vector3<S>& a, Guard& guard, PlaneLeg<S>& plane) {
  place(kind, model, alongAxes<S>(model, AB), guard, plane);
  setRates(kind, model, toPlane<S>(plane, alongAxes<S>(model, v)), toPlane<S>(plane, alongAxes<S>(model, a)), plane);
  const Vector3<S> base = toPlane<S>(plane, model.lift);
  Vector3<S> Q =
      model.principal ? linkForces<true>(kind, model, base, plane) : linkForces<false>(kind, model, base, plane);
  if (model.rubs) Q += friction<S>(model, plane);
  return Q;
}

/// What (a) is made of.
template <class S>
struct LegShare {
  Vector3<S> Q;
  Vector3<S> force;               ///< at B, in B, of the coordinates that no motor drives
  std::array<Vector3<S>, 3> row;  ///< kⱼ in B of those that motors drive
};

template <class S>
LegShare<S> shareOf(const PlaneModel<S>& model, const PlaneLeg<S>& plane, const Vector3<S>& Q) {
  LegShare<S> out;
  out.Q = Q;
  const PlaneAxes<S> axes = planeAxes<S>(model, plane);
  Vector3<S> force(S(0), S(0), S(0));
  for (std::size_t j = 0; j < 3; ++j) {
    if (model.motor[j] < 0)
      force += Q(static_cast<Eigen::Index>(j)) * plane.k[j];
    else
      out.row[j] = axes.toBase(plane.k[j]);
  }
  out.force = axes.toBase(force);
  return out;
}

/// (a)
template <class S>
Vector3<S> forceAtB(const std::array<int, 3>& motor, const LegShare<S>& share, const double* mu) {
  Vector3<S> f = share.force;
  for (std::size_t j = 0; j < 3; ++j)
    if (motor[j] >= 0)
      for (int k = 0; k < 3; ++k) {
        f(k).v -= mu[motor[j]] * share.row[j](k).v;
        f(k).d = f(k).d - mu[motor[j]] * share.row[j](k).d;
      }
  return f;
}

}  // namespace ursula::kernel

#pragma once

// A leg by its kind: what differs is chosen here, what is alike is in chain_motion.h. Internal.

#include "nocsolver/kernels/chain_motion.h"
#include "nocsolver/kernels/pus.h"
#include "nocsolver/kernels/rus.h"
#include "nocsolver/kernels/ups.h"
#include "nocsolver/kernels/urs.h"

namespace ursula {
namespace chain {

inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

template <class S>
void displacement(const ChainModel<S>& model, int index, const Motion<S>& motion, ChainState<S>& out) {
  out.Qb.noalias() = motion.Q * model.b;
  out.AB = (motion.p - model.a) + out.Qb;  // (3)
  switch (model.kind) {
    case LegKind::URS:
      return kernel::ursDisplacement(model, index, motion.t, out);
    case LegKind::UPS:
      return kernel::upsDisplacement(model, index, motion.t, out);
    case LegKind::RUS:
      return kernel::rusDisplacement(model, index, motion.t, out);
    case LegKind::PUS:
      return kernel::pusDisplacement(model, index, motion.t, out);
  }
}

template <class S>
void map(const ChainModel<S>& model, int index, const S& t, ChainState<S>& out) {
  switch (model.kind) {
    case LegKind::URS:
      return kernel::ursMap(model, index, t, out);
    case LegKind::UPS:
      return kernel::upsMap(out);
    case LegKind::RUS:
      return kernel::rusMap(model, index, t, out);
    case LegKind::PUS:
      return kernel::pusMap(model, index, t, out);
  }
}

template <class S, class R>
kernel::ChainMotion<S> motionOf(LegKind kind, const ChainState<S>& leg, const Vector3<S>& rate,
                                const Vector3<S>& acceleration, const R& reading) {
  return kernel::withKind(
      kind, [&](auto k) { return kernel::chainMotion<decltype(k)::value>(leg, rate, acceleration, reading); });
}

/// v_B of a twist [ω; v] at P.
template <class S>
Vector3<S> atB(const Vector6<S>& twist, const Vector3<S>& Qb) {
  return twist.template tail<3>() + Vector3<S>(twist.template head<3>()).cross(Qb);
}

template <class S>
void addForceAtB(const Vector3<S>& f, const Vector3<S>& Qb, Vector6<S>& wrench) {
  wrench.template head<3>() += Qb.cross(f);
  wrench.template tail<3>() += f;
}

}  // namespace chain

}  // namespace ursula

#pragma once

// Rates, accelerations and forces of a leg of any kind, of its joints' axes alone. Internal.
//
//   q̇ⱼ = kⱼ · v_B,  q̈ⱼ = kⱼ · (a_B − a_B⁰),  a_B⁰ the acceleration of B for q̈ = 0          (a)
// Twists run from the base to the tip; a joint that turns adds to ω̇ what its axis is carried by (Featherstone, Rigid
// Body Dynamics Algorithms, 2008, sect. 5.3, here in fixed axes):
//   ω ← ω + q̇ a,  ω̇ ← ω̇ + q̈ a + q̇ ω × a                                                   (b)
// a point that slides along a has q̇ a, q̈ a + 2 q̇ ω × a beside what it is carried by.        (c)

#include "nocsolver/chain_state.h"
#include "nocsolver/kernels/dynamics.h"
#include "nocsolver/kernels/with_kind.h"
#include "nocsolver/reading.h"

namespace ursula::kernel {

template <LegKind kind>
struct ChainOf {
  static constexpr int first = rowOf(kind).joints_of_proximal;  ///< joints before the proximal link
  static constexpr bool slides(int j) { return ursula::slides(rowOf(kind).coordinates[static_cast<std::size_t>(j)]); }
};

/// Motion of a body's frame: of a point and of what turns with it.
template <class S, class R>
struct FrameMotion {
  explicit FrameMotion(const R& of) : reading(of) {}

  const R& reading;
  Vector3<S> omega = Vector3<S>::Zero(), v = omega, omega_dot = omega, a = omega;

  /// The point moves on by `arm`, which the frame carries.
  void moveBy(const Vector3<S>& arm) {
    const Vector3<S> across = omega.cross(arm);
    v += across;
    Vector3<S> more = omega_dot.cross(arm);
    if (!reading.has(Slip::drop_centrifugal)) more += omega.cross(across);
    a += more;
  }
  void turn(const Vector3<S>& axis, const S& rate, const S& acceleration) {
    Vector3<S> more = acceleration * axis;
    if (!reading.has(Slip::drop_coriolis)) more += rate * omega.cross(axis);
    omega_dot += more;  // (b)
    omega += rate * axis;
  }
  void slide(const Vector3<S>& axis, const S& rate, const S& acceleration) {
    v += rate * axis;  // (c)
    Vector3<S> more = acceleration * axis;
    const S times = reading.has(Slip::half_coriolis) ? S(1) : S(2);
    if (!reading.has(Slip::drop_coriolis)) more += (times * rate) * omega.cross(axis);
    a += more;
  }
};

/// Both links, and B, for joint rates and accelerations.
template <class S>
struct ChainMotion {
  ChainLinkMotion<S> proximal, distal;
  Vector3<S> a_B;
};

template <class S, class R>
ChainLinkMotion<S> linkAt(FrameMotion<S, R> frame, const Vector3<S>& arm) {
  frame.moveBy(arm);
  return {frame.omega, frame.v, frame.omega_dot, frame.a};
}

template <LegKind kind, class S, class R>
ChainMotion<S> chainMotion(const ChainState<S>& leg, const Vector3<S>& rate, const Vector3<S>& acceleration,
                           const R& reading) {
  using Chain = ChainOf<kind>;
  ChainMotion<S> out;
  FrameMotion<S, R> frame(reading);
  for (int j = 0; j < 3; ++j) {
    const auto i = static_cast<std::size_t>(j);
    if (j == Chain::first) {
      out.proximal = linkAt(frame, leg.arm_1);
      frame.moveBy(leg.O_2 - leg.O_1);
    }
    if (Chain::slides(j))
      frame.slide(leg.axis[i], rate(j), acceleration(j));
    else
      frame.turn(leg.axis[i], rate(j), acceleration(j));
  }
  out.distal = linkAt(frame, leg.arm_2);
  frame.moveBy(leg.RB);
  out.a_B = frame.a;
  return out;
}

/// Joint rates for a velocity of B.
template <class S>
Vector3<S> chainRates(const ChainState<S>& leg, const Vector3<S>& v_B) {
  return {leg.k[0].dot(v_B), leg.k[1].dot(v_B), leg.k[2].dot(v_B)};  // (a)
}

/// Moment about the mass centre and force that move a link against gravity, in B.
template <class S, class Reading>
Vector3<S> linkMoment(const Matrix3<S>& frame, const Matrix3<S>& inertia, const ChainLinkMotion<S>& link,
                      const Reading& reading) {
  const Matrix3<S> R = reading.has(Slip::untwisted_tensors) ? Matrix3<S>(Matrix3<S>::Identity()) : frame;
  const Vector3<S> omega = R.transpose() * link.omega;
  Vector3<S> moment = inertia * (R.transpose() * link.omega_dot);
  if (!reading.has(Slip::drop_gyroscopic_legs)) moment += omega.cross(inertia * omega);
  return R * moment;
}

/// Forces on the three coordinates that would move the links as they move, were the leg alone, friction included.
template <LegKind kind, class S, class R>
Vector3<S> chainForces(const ChainModel<S>& model, const ChainState<S>& leg, const ChainMotion<S>& motion,
                       const Vector3<S>& gravity, const R& reading) {
  using Chain = ChainOf<kind>;
  const Vector3<S> g = reading.has(Slip::drop_gravity_legs) ? Vector3<S>(Vector3<S>::Zero()) : gravity;
  const Vector3<S> f_1 = model.mass_1 * (motion.proximal.c_ddot - g);
  const Vector3<S> f_2 = model.mass_2 * (motion.distal.c_ddot - g);
  const Vector3<S> n_2 = linkMoment(leg.R_2, model.I_2, motion.distal, reading) + leg.arm_2.cross(f_2);  // about O₂
  Vector3<S> n_1 = linkMoment(leg.R_1, model.I_1, motion.proximal, reading) + leg.arm_1.cross(f_1), all = f_1;
  if (!reading.has(Slip::drop_link_coupling)) {
    n_1 += n_2;
    n_1 += (leg.O_2 - leg.O_1).cross(f_2);  // about O₁
    all += f_2;
  }
  Vector3<S> Q;
  for (int j = 0; j < 3; ++j) {
    const auto i = static_cast<std::size_t>(j);
    const bool before = j < Chain::first;
    if (Chain::slides(j))
      Q(j) = leg.axis[i].dot(before ? all : f_2);
    else
      Q(j) = leg.axis[i].dot(before ? n_1 : n_2);
    if (!reading.has(Slip::drop_friction))
      Q(j) += frictionForce(model.viscous[i], model.coulomb[i], model.speed[i], leg.rate(j));
  }
  return Q;
}

/// Partial velocities of the links' mass centres: columns are for a unit rate of one coordinate.
template <class S>
struct ChainPartials {
  Matrix3<S> omega_1 = Matrix3<S>::Zero(), v_1 = omega_1, omega_2 = omega_1, v_2 = omega_1;
};

template <LegKind kind, class S>
ChainPartials<S> chainPartials(const ChainState<S>& leg) {
  using Chain = ChainOf<kind>;
  ChainPartials<S> out;
  for (int j = 0; j < 3; ++j) {
    const Vector3<S>& axis = leg.axis[static_cast<std::size_t>(j)];
    const bool before = j < Chain::first;
    if (Chain::slides(j)) {
      if (before) out.v_1.col(j) = axis;
      out.v_2.col(j) = axis;
      continue;
    }
    if (before) {
      out.omega_1.col(j) = axis;
      out.v_1.col(j) = axis.cross(leg.arm_1);
    }
    out.omega_2.col(j) = axis;
    out.v_2.col(j) = axis.cross(before ? Vector3<S>(leg.O_2 - leg.O_1 + leg.arm_2) : leg.arm_2);
  }
  return out;
}

/// Mass matrix of one leg in its coordinates.
template <LegKind kind, class S>
Matrix3<S> chainMassMatrix(const ChainModel<S>& model, const ChainState<S>& leg) {
  const ChainPartials<S> p = chainPartials<kind>(leg);
  const Matrix3<S> w_1 = leg.R_1.transpose() * p.omega_1, w_2 = leg.R_2.transpose() * p.omega_2;
  return model.mass_1 * (p.v_1.transpose() * p.v_1) + model.mass_2 * (p.v_2.transpose() * p.v_2) +
         w_1.transpose() * model.I_1 * w_1 + w_2.transpose() * model.I_2 * w_2;
}

/// K̇, the rate of the map with rows kⱼ: K̇ = −K J̇ K, J the velocity of B for unit rates.
template <LegKind kind, class S>
Matrix3<S> chainMapRate(const ChainState<S>& leg) {
  using Chain = ChainOf<kind>;
  Matrix3<S> K, J_dot;
  K << leg.k[0].transpose(), leg.k[1].transpose(), leg.k[2].transpose();
  Vector3<S> omega = Vector3<S>::Zero(), v_O2 = omega;
  for (int j = 0; j < 3; ++j) {
    const Vector3<S>& axis = leg.axis[static_cast<std::size_t>(j)];
    if (j == Chain::first) v_O2 += omega.cross(leg.O_2 - leg.O_1);
    const Vector3<S> axis_dot = omega.cross(axis);
    if (Chain::slides(j)) {
      J_dot.col(j) = axis_dot;
      if (j < Chain::first) v_O2 += leg.rate(j) * axis;  // of a carriage
    } else if (j < Chain::first) {
      J_dot.col(j) = axis_dot.cross(leg.AB - leg.O_1) + axis.cross(leg.v_B);
      omega += leg.rate(j) * axis;
    } else {
      J_dot.col(j) = axis_dot.cross(leg.RB) + axis.cross(leg.v_B - v_O2);
      omega += leg.rate(j) * axis;
    }
  }
  return -K * J_dot * K;
}

}  // namespace ursula::kernel

#pragma once

// Inverse dynamics, the algorithm of the paper's Fig. 6, as a product with Tᵀ that never forms T. Internal.
//
//   τ = −Tᵀ(wⁿ + w^g + w^d),  T = ∂(twists)/∂φ̇                                   (37), (48)
// The twists of a leg's links are linear in φ̇ᵢ, ψ̇ᵢ, θ̇ᵢ, and ψ̇ᵢ, θ̇ᵢ in the velocity of Bᵢ (15b), (4b). So the
// wrenches on the links are first projected on the leg's own three coordinates; what falls on ψᵢ and θᵢ is a force at
// Bᵢ; these and the platform's own wrench make one wrench w at P, and with T_P = B⁻¹A of (24)
//   τᵢ = Q_φᵢ + aᵢᵢ λᵢ,  Bᵀλ = w.                                                (a)

#include <cmath>

#include "model/motion.h"
#include "nocsolver/kernels/link_motion.h"

namespace ursula::kernel {

/// Force that moves the mass centre, less gravity, and moment about it, for one link; both in Fᵢ. (38), (45), (46)
template <class S>
struct LinkWrench {
  Vector3<S> n, f;
};

/// `sine`, `cosine` place the link's axis [0, cosine, sine] in Fᵢ; the link's frame of (40) is [x, axis × x, axis].
template <class S, class R>
LinkWrench<S> linkWrench(const LinkMotion<S>& link, const S& mass, const Matrix3<S>& inertia, const S& cosine,
                         const S& sine, const Vector3<S>& g, const R& reading) {
  const auto toLink = [&](const Vector3<S>& v) {
    return Vector3<S>(v.x(), sine * v.y() - cosine * v.z(), cosine * v.y() + sine * v.z());  // (paper, eq. 40)
  };
  const Vector3<S> omega = toLink(link.omega);
  Vector3<S> n = inertia * toLink(link.omega_dot);                                              // (paper, eq. 46)
  if (!reading.has(Slip::drop_gyroscopic_legs)) n += omega.cross(Vector3<S>(inertia * omega));  // (paper, eq. 38)
  LinkWrench<S> wrench;
  wrench.n = Vector3<S>(n.x(), sine * n.y() + cosine * n.z(), sine * n.z() - cosine * n.y());
  wrench.f = mass * link.c_ddot;
  if (!reading.has(Slip::drop_gravity_legs)) wrench.f -= mass * g;  // (paper, eq. 45)
  return wrench;
}

/// Viscous and smoothed Coulomb friction of one joint, as the force that drives against it.
template <class S>
S frictionForce(const S& viscous, const S& coulomb, const S& speed, const S& rate) {
  using std::tanh;
  const S force = viscous * rate;
  return coulomb == S(0) ? force : S(force + coulomb * tanh(rate / speed));
}

template <class S, class R>
JointTriple<S> legFriction(const LegModel<S>& leg, const JointTriple<S>& rate, const R& reading) {
  if (reading.has(Slip::drop_friction)) return {};
  return {frictionForce(leg.viscous[0], leg.coulomb[0], leg.coulomb_speed, rate.phi),
          frictionForce(leg.viscous[1], leg.coulomb[1], leg.coulomb_speed, rate.psi),
          frictionForce(leg.viscous[2], leg.coulomb[2], leg.coulomb_speed, rate.theta)};
}

/// Forces on φᵢ, ψᵢ, θᵢ that would move the links as they move, were the leg alone.
template <class S, class R>
JointTriple<S> legForces(const LegModel<S>& leg, const LegState<S>& state, const LinkMotion<S>& proximal,
                         const LinkMotion<S>& distal, const Vector3<S>& gravity, const R& reading) {
  const Vector3<S> g(state.x.dot(gravity), leg.y_hat.dot(gravity), state.z.dot(gravity));
  const LinkWrench<S> first =
      linkWrench(proximal, leg.mass_proximal, leg.I_proximal, state.cos_psi, state.sin_psi, g, reading);
  const LinkWrench<S> second =
      linkWrench(distal, leg.mass_distal, leg.I_distal, S(-state.cos_sum), S(-state.sin_sum), g, reading);
  // Partial velocities: the twists of (16), (41) for a unit rate of one joint.
  const S about_y = S(reading.has(Slip::eq16) ? 1 : -1);
  const S knee = reading.has(Slip::drop_link_coupling) ? S(0) : leg.l;
  JointTriple<S> Q = legFriction(leg, state.rate, reading);
  Q.phi += about_y * (first.n.y() + second.n.y()) - proximal.c.z() * first.f.x() - distal.c.z() * second.f.x();
  const S about_knee = second.n.x() + leg.sigma * (state.sin_sum * second.f.y() - state.cos_sum * second.f.z());
  Q.theta += about_knee;
  Q.psi += about_knee + first.n.x() + leg.rho * (state.cos_psi * first.f.z() - state.sin_psi * first.f.y()) +
           knee * (state.cos_psi * second.f.z() - state.sin_psi * second.f.y());
  return Q;
}

/// The force at Bᵢ, in B, that does the work of Q_ψ and Q_θ: (15b) and (4b) transposed.
template <class S>
Vector3<S> forceAtB(const LegModel<S>& leg, const LegState<S>& state, const JointTriple<S>& Q) {
  const S distance = leg.s * state.sin_sum - leg.l * state.sin_psi;
  const S per_ls = S(1) / (leg.l * leg.s * state.sin_theta);
  const S theta_y = state.k_y * per_ls, theta_z = state.r * per_ls;
  const S Q_psi = Q.psi / distance;
  const S on_theta = Q.theta - leg.s * state.sin_sum * Q_psi;
  return (Q_psi + on_theta * theta_y) * leg.y_hat + (on_theta * theta_z) * state.z;
}

/// [moment about P; force], in B, that moves the platform as it moves against gravity. (38), (43c), (46c), (47)
template <class S, class R>
Vector6<S> platformWrench(const PaperModel<S>& model, const Motion<S>& motion, const R& reading) {
  const Vector3<S> arm = motion.Q * model.rho;
  Vector3<S> c_ddot = motion.p_ddot + motion.omega_dot.cross(arm);  // (paper, eq. 43c)
  if (!reading.has(Slip::drop_platform_centripetal)) c_ddot += motion.omega.cross(motion.omega.cross(arm));
  const Vector3<S> omega_M = motion.Q.transpose() * motion.omega;
  const Vector3<S> omega_dot_M = motion.Q.transpose() * motion.omega_dot;
  Vector3<S> n_M = model.I_M * omega_dot_M;  // (paper, eq. 46c)
  if (!reading.has(Slip::drop_gyroscopic_platform)) n_M += omega_M.cross(Vector3<S>(model.I_M * omega_M));
  Vector3<S> f = model.mass * c_ddot;
  if (!reading.has(Slip::drop_gravity_platform)) f -= model.mass * model.gravity;
  const Vector3<S> arm_read = reading.has(Slip::eq47) ? model.rho : arm;  // (paper, eq. 47)
  Vector6<S> wrench;
  wrench << motion.Q * n_M + arm_read.cross(f), f;
  return wrench;
}

}  // namespace ursula::kernel

#pragma once

// Inverse and direct dynamics of a platform on legs of any kinds, each leg in its own plane. Internal.
//
//   τ = −Tᵀ(wⁿ + w^g + w^d)                                                       (37)
// T is never formed. The links' loads are projected on a leg's three coordinates as Q. For undriven coordinates, the
// rows of the leg's map turn them into a force Σ Qⱼ kⱼ at B. With the platform's own load that gives a wrench w at P:
//   Bᵀλ = w,  τ = Q + A λ,  rows of B [Qb × n; n], n = A k                         (23), (24)
// No angle is formed either. It computes one pose, or as many as a pack has lanes.

#include <cmath>

#include <Eigen/Geometry>
#include "model/motion.h"

#include "parts/fast/kernels/leg_kernels.h"
#include "parts/fast/kernels/machine_model.h"
#include "parts/fast/kernels/solve6.h"

namespace ursula::kernel {

/// a + b × c, written so that products fuse with sums.
template <class S>
Vector3<S> plusCross(const Vector3<S>& a, const Vector3<S>& b, const Vector3<S>& c) {
  return {a.x() + b.y() * c.z() - b.z() * c.y(), a.y() + b.z() * c.x() - b.x() * c.z(),
          a.z() + b.x() * c.y() - b.y() * c.x()};
}

/// Motion of points fixed to the platform: v + ω × r, a + (ω̇× + ω×ω×) r.
template <class S>
struct RigidMotion {
  explicit RigidMotion(const Motion<S>& m) : motion(m) {
    const Vector3<S>&w = m.omega, &e = m.omega_dot;
    const S xx = w.x() * w.x(), yy = w.y() * w.y(), zz = w.z() * w.z();
    const S xy = w.x() * w.y(), xz = w.x() * w.z(), yz = w.y() * w.z();
    W << -(yy + zz), xy - e.z(), xz + e.y(), xy + e.z(), -(xx + zz), yz - e.x(), xz - e.y(), yz + e.x(), -(xx + yy);
  }
  Vector3<S> velocity(const Vector3<S>& r) const { return plusCross<S>(motion.p_dot, motion.omega, r); }
  Vector3<S> acceleration(const Vector3<S>& r) const {
    return motion.p_ddot + W.col(0) * r.x() + W.col(1) * r.y() + W.col(2) * r.z();
  }

  const Motion<S>& motion;
  Matrix3<S> W;
};

/// x, u, z of a leg's plane in B.
template <class S>
struct PlaneAxes {
  Vector3<S> x, u, z;

  Vector3<S> along(const Vector3<S>& v) const { return {x.dot(v), u.dot(v), z.dot(v)}; }

  /// Transforms back to B; components missing from `present` (rowOfMap) are 0.
  template <int present = 7>
  Vector3<S> toBase(const Vector3<S>& v) const {
    if constexpr (present == 1) return v.x() * x;
    if constexpr (present == 2) return v.y() * u;
    if constexpr (present == 4) return v.z() * z;
    if constexpr (present == 6) return v.y() * u + v.z() * z;
    return v.x() * x + v.y() * u + v.z() * z;
  }
};

template <class S>
PlaneAxes<S> planeAxes(const PlaneModel<S>& model, const PlaneLeg<S>& leg) {
  return {leg.cosine * model.x_hat + leg.sine * model.z_hat, model.u,
          leg.cosine * model.z_hat - leg.sine * model.x_hat};
}

/// Calls f with each coordinate's index as a constant.
template <class F>
void eachCoordinate(const F& f) {
  f(std::integral_constant<std::size_t, 0>{});
  f(std::integral_constant<std::size_t, 1>{});
  f(std::integral_constant<std::size_t, 2>{});
}

/// Forces against viscous and smoothed Coulomb friction of a leg's joints. Unlike frictionForce of the NOC, this has
/// no branch on the rate, because a pack cannot branch.
template <class S>
Vector3<S> friction(const PlaneModel<S>& model, const PlaneLeg<S>& leg) {
  using std::tanh;
  Vector3<S> Q;
  for (std::size_t j = 0; j < 3; ++j) {
    const S& rate = leg.rate(static_cast<Eigen::Index>(j));
    S& force = Q(static_cast<Eigen::Index>(j));
    force = model.viscous[j] * rate;
    if (model.has_coulomb) force += model.coulomb[j] * tanh(rate / model.speed[j]);
  }
  return Q;
}

/// Rotor inertias, kg·m² or kg: each adds j q̈ to the effort and j to the mass matrix.
template <class S>
Vector3<S> rotorInertia(const PlaneModel<S>& model) {
  return {model.rotor[0], model.rotor[1], model.rotor[2]};
}

/// Forces of rotors and of off-line mass centres. They have a separate function so that they do not change how the
/// surrounding code rounds.
template <class Kind, class S>
[[gnu::noinline]] Vector3<S> addedForces(Kind kind, const PlaneModel<S>& model, const Vector3<S>& base,
                                         const PlaneLeg<S>& leg) {
  Vector3<S> Q = Vector3<S>::Zero();
  if (model.has_rotor) Q += rotorInertia<S>(model).cwiseProduct(leg.acceleration);
  if (model.off_line) Q += offLineForces(kind, model, base, leg);
  return Q;
}

/// The same terms in the mass matrix of the leg's coordinates.
template <class Kind, class S>
[[gnu::noinline]] Matrix3<S> addedMass(Kind kind, const PlaneModel<S>& model, const PlaneLeg<S>& leg) {
  Matrix3<S> out = Matrix3<S>::Zero();
  if (model.has_rotor) out.diagonal() += rotorInertia<S>(model);
  if (model.off_line) out += offLineMass(kind, model, leg);
  return out;
}

template <class S>
void addForceAt(const Vector3<S>& arm, const Vector3<S>& f, Vector6<S>& wrench) {
  wrench.template head<3>() = plusCross<S>(wrench.template head<3>(), arm, f);
  wrench.template tail<3>() += f;
}

/// [moment about P; force], in B, that the platform's motion needs against gravity. (38), (43c), (46c)
template <class S>
Vector6<S> platformLoad(const MachineModel<S>& machine, const Motion<S>& motion, const RigidMotion<S>& carried) {
  const Vector3<S> arm = motion.Q * machine.rho;
  const Vector3<S> omega_M = motion.Q.transpose() * motion.omega;
  const Vector3<S> n_M =
      machine.I_M * (motion.Q.transpose() * motion.omega_dot) + omega_M.cross(Vector3<S>(machine.I_M * omega_M));
  const Vector3<S> f = machine.mass * (carried.acceleration(arm) - machine.gravity);
  Vector6<S> wrench;
  wrench << motion.Q * n_M, S(0), S(0), S(0);
  addForceAt<S>(arm, f, wrench);
  return wrench;
}

/// A leg's position and motion, and the loads on its coordinates.
template <class S>
struct MovingLeg {
  Vector3<S> Qb;
  PlaneLeg<S> plane;
  PlaneAxes<S> axes;
  Vector3<S> Q;
};
template <class S>
using MovingLegs = PerLeg<MovingLeg<S>>;

/// All legs pass a stage before the next begins. A processor then overlaps them, because no leg waits for another's
/// roots and quotients. guardOf(i) creates each leg's guard.
template <class S, class GuardOf>
void moveLegs(const MachineModel<S>& machine, const Motion<S>& motion, const RigidMotion<S>& carried,
              const GuardOf& guardOf, MovingLegs<S>& legs) {
  const auto each = [&](const auto& stage) {
    for (int i = 0; i < machine.legs_in_all; ++i)
      withKind(machine.legs[i].kind, [&](auto kind) { stage(kind, i, machine.legs[i], legs[i]); });
  };
  each([&](auto kind, std::size_t i, const PlaneModel<S>& model, MovingLeg<S>& leg) {
    auto&& guard = guardOf(static_cast<int>(i));
    leg.Qb = motion.Q * model.b;
    place(kind, model, alongAxes<S>(model, motion.p - model.a + leg.Qb), guard, leg.plane);
    leg.axes = planeAxes<S>(model, leg.plane);
  });
  each([&](auto kind, std::size_t, const PlaneModel<S>& model, MovingLeg<S>& leg) {
    const Vector3<S> h = leg.axes.along(carried.velocity(leg.Qb));
    const Vector3<S> a = leg.axes.along(carried.acceleration(leg.Qb));
    setRates(kind, model, h, a, leg.plane);
  });
  each([&](auto kind, std::size_t, const PlaneModel<S>& model, MovingLeg<S>& leg) {
    const Vector3<S> base = toPlane<S>(leg.plane, model.minus_gravity);
    leg.Q = model.principal ? linkForces<true>(kind, model, base, leg.plane)
                            : linkForces<false>(kind, model, base, leg.plane);
    if (model.has_friction) leg.Q += friction<S>(model, leg.plane);
    if (model.has_rotor || model.off_line) leg.Q += addedForces(kind, model, base, leg.plane);
  });
}

/// Adds one leg: the loads on its motors, their rows, and its load on the platform.
template <class S, class Kind>
void addLeg(Kind, const PlaneModel<S>& model, const S& per_length, const MovingLeg<S>& leg, Vector6<S>& wrench,
            Vector6<S>& Q_driven, Vector6<S>& A, System6<S>& system) {
  Vector3<S> f = Vector3<S>::Zero();
  eachCoordinate([&](auto j) {
    constexpr int present = rowOfMap(Kind{})[j];
    const int motor = model.motor[j];
    const S& share = leg.Q(static_cast<Eigen::Index>(j.value));
    const Vector3<S>& k = leg.plane.k[j];
    if (motor < 0) {
      if constexpr ((present & 1) != 0) f.x() += share * k.x();
      if constexpr ((present & 2) != 0) f.y() += share * k.y();
      if constexpr ((present & 4) != 0) f.z() += share * k.z();
      return;
    }
    Q_driven(motor) = share;
    A(motor) = leg.plane.lever[j];  // gives rows of B similar sizes; any value near k's will do
    const Vector3<S> n = leg.axes.template toBase<present>(A(motor) * k), moment = per_length * leg.Qb.cross(n);
    for (int row = 0; row < 3; ++row) {
      system.a[row][motor] = moment(row);
      system.a[3 + row][motor] = n(row);
    }
  });
  addForceAt<S>(leg.Qb, leg.axes.toBase(f), wrench);
}

template <class S>
void addLeg(const MachineModel<S>& machine, std::size_t i, const MovingLeg<S>& leg, Vector6<S>& wrench,
            Vector6<S>& Q_driven, Vector6<S>& A, System6<S>& system) {
  const PlaneModel<S>& model = machine.legs[i];
  withKind(model.kind, [&](auto kind) { addLeg(kind, model, machine.per_length, leg, wrench, Q_driven, A, system); });
}

/// Efforts for a motion, minus `load` at P. Sets `pivots` to the smallest pivot over the largest.
template <class S, class GuardOf>
Vector6<S> inverseDynamics(const MachineModel<S>& machine, const Motion<S>& motion, const Vector6<S>& load,
                           const GuardOf& guardOf, S& pivots) {
  const RigidMotion<S> carried(motion);
  Vector6<S> wrench = platformLoad<S>(machine, motion, carried) - load, efforts, A;
  System6<S> system;
  MovingLegs<S> legs;
  moveLegs<S>(machine, motion, carried, guardOf, legs);
  for (int i = 0; i < machine.legs_in_all; ++i) addLeg<S>(machine, i, legs[i], wrench, efforts, A, system);
  for (int row = 0; row < 3; ++row) {
    system.a[row][6] = machine.per_length * wrench(row);
    system.a[3 + row][6] = wrench(3 + row);
  }
  pivots = solve(system);
  for (int m = 0; m < motor_count; ++m) efforts(m) += A(m) * system.a[m][6];  // (37)
  return efforts;
}

/// Adds Gᵀ M G, G = [−[Qb]×, 1]: moves a mass matrix at B, in B's frame, to P.
template <class S>
void addMassAt(const Vector3<S>& Qb, const Matrix3<S>& M_B, Matrix6<S>& M_P) {
  Matrix3<S> arm_M;
  for (int c = 0; c < 3; ++c) arm_M.col(c) = Qb.cross(Vector3<S>(M_B.col(c)));
  for (int r = 0; r < 3; ++r) {
    const Vector3<S> row = -Vector3<S>(arm_M.row(r).transpose()).cross(Qb);
    for (int c = 0; c < 3; ++c) {
      M_P(r, c) += row(c);
      M_P(3 + r, c) += arm_M(c, r);
      M_P(3 + r, 3 + c) += M_B(r, c);
    }
  }
}

/// Adds the platform's part of the wrench and of M_P.
template <class S>
void addPlatform(const MachineModel<S>& machine, const Motion<S>& motion, const RigidMotion<S>& carried,
                 Vector6<S>& wrench, Matrix6<S>& M_P) {
  wrench -= platformLoad<S>(machine, motion, carried);
  M_P.template topLeftCorner<3, 3>() += motion.Q * machine.I_M * motion.Q.transpose();
  addMassAt<S>(motion.Q * machine.rho, machine.mass * Matrix3<S>::Identity(), M_P);
}

/// Adds one leg's part of the wrench and of M_P.
template <class S, class Kind>
void addLegMass(Kind kind, const PlaneModel<S>& model, const MovingLeg<S>& leg, const Vector6<S>& efforts,
                Vector6<S>& wrench, Matrix6<S>& M_P) {
  Vector3<S> f = Vector3<S>::Zero();
  Matrix3<S> K;
  eachCoordinate([&](auto j) {
    constexpr int present = rowOfMap(Kind{})[j];
    const int motor = model.motor[j];
    const S& share = leg.Q(static_cast<Eigen::Index>(j.value));
    const Vector3<S>& k = leg.plane.k[j];
    const S free = motor < 0 ? S(-share) : S(efforts(motor) - share);
    if constexpr ((present & 1) != 0) f.x() += free * k.x();
    if constexpr ((present & 2) != 0) f.y() += free * k.y();
    if constexpr ((present & 4) != 0) f.z() += free * k.z();
    K.col(j.value) = leg.axes.template toBase<present>(k);
  });
  addForceAt<S>(leg.Qb, leg.axes.toBase(f), wrench);
  addMassAt<S>(leg.Qb, K * massMatrix(kind, model, leg.plane) * K.transpose(), M_P);
  if (model.has_rotor || model.off_line)
    addMassAt<S>(leg.Qb, K * addedMass(kind, model, leg.plane) * K.transpose(), M_P);
}

template <class S>
void addLegMass(const MachineModel<S>& machine, std::size_t i, const MovingLeg<S>& leg, const Vector6<S>& efforts,
                Vector6<S>& wrench, Matrix6<S>& M_P) {
  const PlaneModel<S>& model = machine.legs[i];
  withKind(model.kind, [&](auto kind) { addLegMass(kind, model, leg, efforts, wrench, M_P); });
}

/// The platform's twist rate [ω̇; p̈] under `efforts`; accelerations in `motion` must be 0.
template <class S, class GuardOf>
Vector6<S> directDynamics(const MachineModel<S>& machine, const Motion<S>& motion, const Vector6<S>& efforts,
                          const Vector6<S>& load, const GuardOf& guardOf) {
  const RigidMotion<S> carried(motion);
  Vector6<S> wrench = load;
  Matrix6<S> M_P = Matrix6<S>::Zero();
  addPlatform<S>(machine, motion, carried, wrench, M_P);
  MovingLegs<S> legs;
  moveLegs<S>(machine, motion, carried, guardOf, legs);
  for (int i = 0; i < machine.legs_in_all; ++i) addLegMass<S>(machine, i, legs[i], efforts, wrench, M_P);
  return solvePositive<S>(M_P, wrench);  // (36)
}

}  // namespace ursula::kernel

#pragma once

// A machine as the kernels of plane_dynamics.h take it. Internal.

#include <array>

#include "nocsolver/chain_solver.h"

namespace ursula::kernel {

/// What does not change with the motion.
template <class S>
struct MachineModel {
  std::array<ChainModel<S>, leg_count> legs;
  std::array<Vector3<S>, leg_count> lift;     ///< −g along each leg's F̂
  std::array<bool, leg_count> rubs, coulomb;  ///< legs with friction, and with some that is not viscous
  int legs_in_all = 0;
  S mass, length, per_length;
  Vector3<S> rho, gravity;
  Matrix3<S> I_M;
};

template <class S>
Vector3<S> alongAxes(const ChainModel<S>& leg, const Vector3<S>& v) {
  return {leg.x_hat.dot(v), leg.u.dot(v), leg.z_hat.dot(v)};
}

template <class S>
MachineModel<S> machineModel(const Manipulator& manipulator) {
  const ChainSolver<S> chain(manipulator);
  MachineModel<S> out;
  out.legs_in_all = chain.legCount();
  out.mass = S(manipulator.platform().mass);
  out.rho = manipulator.platform().center_of_mass.template cast<S>();
  out.I_M = manipulator.platform().inertia.template cast<S>();
  out.gravity = chain.gravity();
  out.length = chain.length();
  out.per_length = S(1) / out.length;
  for (std::size_t i = 0; i < static_cast<std::size_t>(out.legs_in_all); ++i) {
    const ChainModel<S>& leg = out.legs[i] = chain.leg(static_cast<int>(i));
    out.lift[i] = -alongAxes<S>(leg, out.gravity);
    out.coulomb[i] = out.rubs[i] = false;
    for (std::size_t j = 0; j < 3; ++j) {
      out.coulomb[i] = out.coulomb[i] || leg.coulomb[j] != S(0);
      out.rubs[i] = out.rubs[i] || out.coulomb[i] || leg.viscous[j] != S(0);
    }
  }
  return out;
}

}  // namespace ursula::kernel

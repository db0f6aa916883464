#pragma once

// Bodies of FastDynamics; included by the sources that instantiate it.

#include "parts/fast/fast_dynamics.h"
#include "parts/fast/kernels/leg_kernels.h"
#include "parts/fast/kernels/link_terms.h"
#include "parts/fast/kernels/plane_dynamics.h"

namespace ursula {

template <class S>
FastDynamics<S>::FastDynamics(const Manipulator& manipulator, InstructionSet set)
    : FastDynamics(kernel::machineModel(MachineParameters<S>(manipulator)), set) {}

template <class S>
FastDynamics<S>::FastDynamics(const kernel::MachineModel<S>& machine, InstructionSet set)
    : machine_(machine), at_once_(machine_, set) {}

template <class S>
Vector6<S> FastDynamics<S>::inverseDynamics(const Motion<S>& motion, const Vector6<S>& load) const {
  S pivots;
  if constexpr (std::is_same_v<S, double>)
    if (const auto efforts = at_once_.inverseDynamics(motion, load, pivots)) {
      legs::requireRegularB(pivots, motion.t);
      return *efforts;
    }
  const auto guardOf = [&motion](int leg) { return kernel::LegGuard<S>{leg, motion.t}; };
  const Vector6<S> efforts = kernel::inverseDynamics<S>(machine_, motion, load, guardOf, pivots);
  legs::requireRegularB(pivots, motion.t);
  return efforts;
}

template <class S>
Vector6<S> FastDynamics<S>::directDynamics(const Motion<S>& motion, const Vector6<S>& efforts,
                                           const Vector6<S>& load) const {
  if constexpr (std::is_same_v<S, double>)
    if (const auto rates = at_once_.directDynamics(motion, efforts, load)) return *rates;
  Motion<S> unaccelerated = motion;
  unaccelerated.omega_dot.setZero();
  unaccelerated.p_ddot.setZero();
  const auto guardOf = [&motion](int leg) { return kernel::LegGuard<S>{leg, motion.t}; };
  return kernel::directDynamics<S>(machine_, unaccelerated, efforts, load, guardOf);
}

}  // namespace ursula

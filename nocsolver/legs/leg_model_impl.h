#pragma once

// The constructor of MachineParameters; included by the sources that instantiate it.

#include <algorithm>

#include "nocsolver/legs/fixed_frame.h"
#include "nocsolver/legs/leg_model.h"

namespace ursula {
namespace legs {

template <class S>
LegModel<S> modelOf(const Leg& from) {
  LegModel<S> leg;
  leg.kind = from.kind;
  setFixedFrame<S>(from.base_axis, leg.x_hat, leg.u, leg.z_hat);
  leg.a = from.base_point.cast<S>();
  leg.b = from.platform_point.cast<S>();
  leg.l = S(from.proximal.length);
  leg.s = S(from.distal.length);
  leg.knee = S(from.knee == Knee::positive ? 1 : -1);
  leg.rho = S(from.proximal.center_of_mass);
  leg.sigma = S(from.distal.center_of_mass);
  leg.mass_1 = S(from.proximal.mass);
  leg.mass_2 = S(from.distal.mass);
  leg.I_1 = from.proximal.inertia.cast<S>();
  leg.I_2 = from.distal.inertia.cast<S>();
  for (std::size_t j = 0; j < 3; ++j) {
    const Coordinate coordinate = rowOf(from.kind).coordinates[j];
    leg.viscous[j] = S(from.friction.on(coordinate));
    leg.coulomb[j] = S(from.coulomb.on(coordinate));
    leg.speed[j] = S(from.coulomb.speedOf(coordinate));
    leg.rotor[j] = S(from.rotor_inertia.on(coordinate));
  }
  leg.has_rotor = from.rotor_inertia.any();
  leg.off_1 = from.proximal.off_line.cast<S>();
  leg.off_2 = from.distal.off_line.cast<S>();
  leg.off_line = !from.proximal.off_line.isZero(0) || !from.distal.off_line.isZero(0);
  leg.motor.fill(-1);
  return leg;
}

}  // namespace legs

template <class S>
MachineParameters<S>::MachineParameters(const Manipulator& manipulator)
    : legs_in_all(manipulator.legCount()),
      motors(manipulator.motors()),
      gravity(manipulator.gravity().cast<S>()),
      mass(static_cast<S>(manipulator.platform().mass)),
      rho(manipulator.platform().center_of_mass.cast<S>()),
      I_M(manipulator.platform().inertia.cast<S>()),
      length(0) {
  for (int i = 0; i < legs_in_all; ++i) {
    LegModel<S>& leg = this->legs[i];
    leg = ursula::legs::modelOf<S>(manipulator.leg(i));
    length = std::max({length, S(leg.b.norm()), leg.l, leg.s});
  }
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = motors[m];
    this->legs[motor.leg].motor[motor.joint] = m;
  }
}

}  // namespace ursula

#pragma once

// Splits a machine's model into real numbers and other properties. Internal.

#include "parts/fast/kernels/batch_functions.h"
#include "parts/fast/kernels/machine_model.h"

namespace ursula::kernel {

/// Calls f with every number of the model, always in the same order.
template <class Model, class F>
void forEachNumber(Model& machine, const F& f) {
  const auto all = [&f](auto& matrix) {
    for (Eigen::Index k = 0; k < matrix.size(); ++k) f(matrix.data()[k]);
  };
  f(machine.mass);
  f(machine.per_length);
  all(machine.rho);
  all(machine.gravity);
  all(machine.I_M);
  for (int i = 0; i < machine.legs_in_all; ++i) {
    auto& leg = machine.legs[i];
    all(leg.minus_gravity);
    all(leg.a);
    all(leg.b);
    all(leg.x_hat);
    all(leg.u);
    all(leg.z_hat);
    for (auto* number : {&leg.l, &leg.s, &leg.knee, &leg.rho, &leg.sigma, &leg.mass_1, &leg.mass_2, &leg.per_l,
                         &leg.per_s, &leg.per_sum, &leg.first_1, &leg.first_2})
      f(*number);
    all(leg.I_1);
    all(leg.I_2);
    all(leg.J_1);
    all(leg.J_2);
    all(leg.off_1);
    all(leg.off_2);
    for (auto* three : {&leg.viscous, &leg.coulomb, &leg.speed, &leg.rotor})
      for (auto& number : *three) f(number);
  }
}

template <class S>
MachineShape shapeOf(const MachineModel<S>& machine) {
  MachineShape out;
  out.legs = machine.legs_in_all;
  for (int i = 0; i < out.legs; ++i) {
    out.kinds[i] = machine.legs[i].kind;
    out.motors[i] = machine.legs[i].motor;
    out.has_friction[i] = machine.legs[i].has_friction;
    out.has_coulomb[i] = machine.legs[i].has_coulomb;
    out.principal[i] = machine.legs[i].principal;
    out.has_rotor[i] = machine.legs[i].has_rotor;
    out.off_line[i] = machine.legs[i].off_line;
  }
  return out;
}

template <class S>
void copyShape(const MachineShape& shape, MachineModel<S>& to) {
  to.legs_in_all = shape.legs;
  for (int i = 0; i < shape.legs; ++i) {
    to.legs[i].kind = shape.kinds[i];
    to.legs[i].motor = shape.motors[i];
    to.legs[i].has_friction = shape.has_friction[i];
    to.legs[i].has_coulomb = shape.has_coulomb[i];
    to.legs[i].principal = shape.principal[i];
    to.legs[i].has_rotor = shape.has_rotor[i];
    to.legs[i].off_line = shape.off_line[i];
  }
}

}  // namespace ursula::kernel

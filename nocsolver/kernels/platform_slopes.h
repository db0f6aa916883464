#pragma once

// What the platform itself adds to the wrench at P, by the state. Internal; included as leg_slopes.h is.

#include "nocsolver/kernels/leg_slopes.h"

namespace ursula::kernel {

/// The platform's part of a machine; its legs are nobody's business here.
template <class S>
void setPlatform(const MachineNumbers& from, MachineModel<S>& to) {
  to.mass = S(from.mass);
  to.rho = three<S>(from.rho);
  to.gravity = three<S>(from.gravity);
  to.I_M = nine<S>(from.I_M);
}

/// `numbers` as Motion<double> has them from t on.
template <class S>
void setMotion(const double* numbers, Motion<S>& to) {
  to.p = three<S>(numbers + 1);
  to.Q = nine<S>(numbers + 4);
  to.omega = three<S>(numbers + 13);
  to.p_dot = three<S>(numbers + 16);
  to.omega_dot = three<S>(numbers + 19);
  to.p_ddot = three<S>(numbers + 22);
}

/// δ × q, its row `row` as factors of δ.
template <class Isa>
void turnOf(const double* q, int row, double* to) {
  to[(row + 1) % 3] = q[(row + 2) % 3];
  to[(row + 2) % 3] = -q[(row + 1) % 3];
}

/// [moment about P; force] of (38), (43c), (46c): lanes 0 to 2 by δ, then four on each by ω, ω̇, p̈.
template <class Isa>
__attribute__((flatten, noinline)) Vector6<Dual<Isa, 16>> platformByState(const MachineNumbers& numbers,
                                                                          const double* motion_numbers) {
  using S = Dual<Isa, 16>;
  MachineModel<S> machine;
  setPlatform(numbers, machine);
  Motion<S> motion;
  setMotion(motion_numbers, motion);
  for (int k = 0; k < 3; ++k) {
    const auto seed = [k](S& number, int first) {
      double lanes[16] = {};
      lanes[first + k] = 1;
      number = tangent<S>(number.v, lanes);
    };
    seed(motion.omega(k), 4);
    seed(motion.omega_dot(k), 8);
    seed(motion.p_ddot(k), 12);
    for (int row = 0; row < 3; ++row) {
      double lanes[16] = {};
      turnOf<Isa>(motion_numbers + 4 + 3 * k, row, lanes);
      motion.Q(row, k) = tangent<S>(motion.Q(row, k).v, lanes);
    }
  }
  return platformLoad<S>(machine, motion, Carried<S>(motion));
}

}  // namespace ursula::kernel

#pragma once

#include <array>

#include "nocsolver/legs/leg_model.h"

// The machine and its legs in the form that the kernels of plane_dynamics.h use. Internal.

namespace ursula::kernel {

template <class S>
struct PlaneModel : LegModel<S> {
  Vector3<S> minus_gravity;        ///< −g along F̂
  Matrix3<S> J_1, J_2;             ///< about the links' first ends
  S first_1, first_2;              ///< masses times the distances of their centres
  S per_l, per_s, per_sum;         ///< 1/l, 1/s, 1/(l + s)
  bool has_friction, has_coulomb;  ///< of any kind; of Coulomb's kind
  bool principal;                  ///< the links' frames are principal axes
};

/// The constants of the motion.
template <class S>
struct MachineModel {
  PerLeg<PlaneModel<S>> legs;
  int legs_in_all = 0;
  S mass, per_length;  ///< the platform's mass; 1 over a length of the machine's size
  Vector3<S> rho, gravity;
  Matrix3<S> I_M;
};

template <class S>
Vector3<S> alongAxes(const LegModel<S>& leg, const Vector3<S>& v) {
  return {leg.x_hat.dot(v), leg.u.dot(v), leg.z_hat.dot(v)};
}

/// The tensor about a point at `distance` from the mass centre along the link; `first` is the mass times `distance`.
template <class S>
Matrix3<S> aboutEnd(const Matrix3<S>& I, const S& first, const S& distance) {
  Matrix3<S> J = I;
  J(0, 0) += first * distance;
  J(1, 1) += first * distance;
  return J;
}

template <class S>
PlaneModel<S> planeModel(const LegModel<S>& leg, const Vector3<S>& gravity) {
  PlaneModel<S> out;
  static_cast<LegModel<S>&>(out) = leg;
  out.minus_gravity = -alongAxes<S>(leg, gravity);
  out.first_1 = leg.mass_1 * leg.rho;
  out.first_2 = leg.mass_2 * leg.sigma;
  out.J_1 = aboutEnd<S>(leg.I_1, out.first_1, leg.rho);
  out.J_2 = aboutEnd<S>(leg.I_2, out.first_2, leg.sigma);
  out.per_l = S(1) / leg.l;
  out.per_s = S(1) / leg.s;
  out.per_sum = S(1) / (leg.l + leg.s);
  out.has_coulomb = out.has_friction = false;
  for (std::size_t j = 0; j < 3; ++j) {
    out.has_coulomb = out.has_coulomb || leg.coulomb[j] != S(0);
    out.has_friction = out.has_friction || out.has_coulomb || leg.viscous[j] != S(0);
  }
  out.principal = leg.I_1.isDiagonal(S(0)) && leg.I_2.isDiagonal(S(0));
  return out;
}

template <class S>
MachineModel<S> machineModel(const MachineParameters<S>& from) {
  MachineModel<S> out;
  out.legs_in_all = from.legs_in_all;
  out.mass = from.mass;
  out.rho = from.rho;
  out.I_M = from.I_M;
  out.gravity = from.gravity;
  out.per_length = S(1) / from.length;
  for (int i = 0; i < out.legs_in_all; ++i) out.legs[i] = planeModel<S>(from.legs[i], out.gravity);
  return out;
}

}  // namespace ursula::kernel

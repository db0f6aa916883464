#pragma once

// A leg's mass matrix in its coordinates, in the axes of its plane. Internal. It holds the partial derivatives of
// leg_forces.h by the accelerations, in closed form; noc/ computes the same from T.
//
// For a link along [0, C, S], with I about any point of its axis, the products about x and the plane's axis are: P =
// I_xy S + I_xz C, J = I_yy S² + 2 I_yz S C + I_zz C².

#include "nocsolver/fast/kernels/plane_leg.h"

namespace ursula::kernel {

template <class S>
struct CrossInertia {
  S x, P, J;
};

template <class S>
CrossInertia<S> crossInertia(const Matrix3<S>& I, const S& C, const S& S_) {
  return {I(0, 0), I(0, 1) * S_ + I(0, 2) * C, I(1, 1) * S_ * S_ + S(2) * I(1, 2) * S_ * C + I(2, 2) * C * C};
}

template <class S>
Matrix3<S> symmetric(const S& a, const S& ab, const S& ac, const S& b, const S& bc, const S& c) {
  Matrix3<S> M;
  M << a, ab, ac, ab, b, bc, ac, bc, c;
  return M;
}

/// In φ, ψ, d.
template <class S>
Matrix3<S> massMatrix(Ups, const PlaneModel<S>& model, const PlaneLeg<S>& leg) {
  const auto a = crossInertia<S>(model.J_1, leg.C_1, leg.S_1), b = crossInertia<S>(model.I_2, leg.C_1, leg.S_1);
  const S inner = leg.d - model.s + model.sigma, mu = model.mass_2 * inner * inner;
  return symmetric<S>(a.J + b.J + leg.S_1 * leg.S_1 * mu, -(a.P + b.P), S(0), a.x + b.x + mu, S(0), model.mass_2);
}

/// In d, ψ, θ.
template <class S>
Matrix3<S> massMatrix(Pus, const PlaneModel<S>& model, const PlaneLeg<S>& leg) {
  const auto rod = crossInertia<S>(model.J_2, leg.C_2, leg.S_2);
  return symmetric<S>(model.mass_1 + model.mass_2, S(0), -model.first_2 * leg.S_2, rod.J, -rod.P, rod.x);
}

/// In φ, ψ, θ.
template <class S>
Matrix3<S> massMatrix(Rus, const PlaneModel<S>& model, const PlaneLeg<S>& leg) {
  const auto rod = crossInertia<S>(model.J_2, leg.C_2, leg.S_2);
  const S e = model.first_2 * model.l * leg.S_2 * leg.C_1, g = model.first_2 * model.l * leg.C_2 * leg.S_1;
  const S crank = model.mass_2 * model.l * model.l + model.J_1(1, 1);
  return symmetric<S>(rod.J + S(2) * e + crank, rod.J + e, rod.P - g, rod.J, rod.P, rod.x);
}

/// In φ, ψ, θ.
template <class S>
Matrix3<S> massMatrix(Urs, const PlaneModel<S>& model, const PlaneLeg<S>& leg) {
  const auto a = crossInertia<S>(model.J_1, leg.C_1, leg.S_1), b = crossInertia<S>(model.J_2, leg.C_2, leg.S_2);
  const S across = leg.S_1 * leg.S_2, k = model.first_2 * model.l * (across + leg.C_1 * leg.C_2);
  const S knee = model.l * (model.mass_2 * model.l * (leg.S_1 * leg.S_1) + S(2) * model.first_2 * across);
  return symmetric<S>(a.J + b.J + knee, -(a.P + b.P), -b.P, b.x + S(2) * k + model.mass_2 * model.l * model.l + a.x,
                      b.x + k, b.x);
}

}  // namespace ursula::kernel

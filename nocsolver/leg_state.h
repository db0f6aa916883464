#pragma once

#include "model/scalar.h"

namespace ursula {

/// φ, ψ, θ of one leg, or their rates or accelerations.
template <class S>
struct JointTriple {
  S phi{0}, psi{0}, theta{0};
};

/// What the inverse kinematics finds for one leg, (1)–(19). Vectors in B unless the frame is said.
/// The dynamics needs sines and cosines only; angles are made of them where they are asked for.
template <class S>
struct LegState {
  // displacement
  Vector3<S> Qb, AB;  ///< Q bᵢ; AᵢBᵢ of (3)
  Vector3<S> x, z;    ///< xᵢ and zᵢ, axes of Fᵢ; yᵢ = uᵢ
  S k_y, r, q;        ///< second entry of (13); third: the distance of Bᵢ from the axis; ‖AᵢBᵢ‖
  S sin_phi, cos_phi, sin_theta, cos_theta;
  S sin_psi, cos_psi;  ///< of ψ
  S sin_sum, cos_sum;  ///< of ψ + θ
  // rates
  Vector3<S> v_B, h;  ///< velocity of Bᵢ; hᵢ of (11b), in Fᵢ
  S q_dot, a_ii;      ///< q̇ᵢ of (6); aᵢᵢ of (23)
  JointTriple<S> rate;
  // accelerations
  Vector3<S> h_dot;         ///< (18), in Fᵢ
  S q_ddot, eta, a_ii_dot;  ///< (8); η; ȧᵢᵢ of (26)
  JointTriple<S> acceleration;
};

/// The motion of one link in the axes of Fᵢ: twist of the mass centre, and its rate. Position from Aᵢ.
template <class S>
struct LinkMotion {
  Vector3<S> c, omega, c_dot, omega_dot, c_ddot;
};

}  // namespace ursula

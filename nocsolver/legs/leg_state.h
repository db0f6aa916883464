#pragma once

#include <array>

#include "base/scalar.h"

namespace ursula {

/// How near a leg is to poses where its rates are undetermined.
template <class S>
struct LegMargins {
  S sine{1};  ///< |sin θ| for URS, |sin ψ| for RUS, |cos θ| for PUS, 1 for UPS; 0 if the leg is stretched or folded
  S leverage{1};  ///< ‖AB‖ over the distance from the axis, or similar; large near the axis
};

/// One coordinate's row of A q̇ = B t_P (22) for a leg: A q̇ = n · v_B, with the rates of A and n.
template <class S>
struct JacobianRow {
  S A{0}, A_dot{0};
  Vector3<S> n = Vector3<S>::Zero(), n_dot = n;
};

/// Twist of a link's mass centre and its rate, in B.
template <class S>
struct LinkMotion {
  Vector3<S> omega, c_dot, omega_dot, c_ddot;
};

template <class S>
struct LinkMotions {
  LinkMotion<S> proximal, distal;
};

/// Kinematics of one leg, (1)–(19) and their counterparts for other kinds. Vectors are in B, points relative to A.
///
/// Joints before the proximal link turn about axis[j] through O₁ = A, those after it through O₂, or slide along
/// axis[j]. If no joint turns about O₁, it is the carriage's point.
template <class S>
struct LegState {
  // displacement
  Vector3<S> Qb, AB;              ///< Q bᵢ; AᵢBᵢ of (3)
  std::array<S, 3> sine, cosine;  ///< of the angles; for a sliding coordinate `cosine` is its value, m
  std::array<Vector3<S>, 3> axis;
  Vector3<S> x, z;                ///< axes of Fᵢ; yᵢ = uᵢ
  S sin_sum, cos_sum;             ///< of ψ + θ (URS), of φ + ψ (RUS)
  Vector3<S> x_1, e, x_2, along;  ///< of the links' frames [x, e × x, e]; `along` is sᵢ
  LegMargins<S> margins;
  // positions of the links
  Vector3<S> O_1, O_2;      ///< first ends of the links
  Matrix3<S> R_1, R_2;      ///< Gᵢ, Hᵢ of (40)
  Vector3<S> arm_1, arm_2;  ///< from O₁, O₂ along the links to the points nearest to their mass centres
  // rates
  std::array<JacobianRow<S>, 3> row;
  Vector3<S> v_B, rate;
  // accelerations
  Vector3<S> a_B, acceleration;
};

}  // namespace ursula

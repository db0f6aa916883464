#pragma once

#include <array>

#include "model/manipulator.h"
#include "model/scalar.h"

namespace ursula {

/// One leg as a chain of three joints, in the scalar S, with the fixed frame of (2a).
template <class S>
struct ChainModel {
  LegKind kind;
  Vector3<S> a, b;                           ///< aᵢ in B, bᵢ in M
  Vector3<S> x_hat, u, z_hat;                ///< columns of F̂, in B
  S l, s;                                    ///< lengths of the links
  S knee;                                    ///< +1 or −1
  S rho, sigma;                              ///< mass centres from O₁ and O₂ along their links
  S mass_1, mass_2;                          ///< proximal, distal link
  Matrix3<S> I_1, I_2;                       ///< about the mass centres, in the links' frames
  std::array<S, 3> viscous, coulomb, speed;  ///< friction of the three coordinates
  std::array<int, 3> motor;                  ///< that drives the coordinate, −1 where none does
};

/// How near a leg is to where its map fails.
template <class S>
struct LegMargins {
  S sine{1};  ///< |sin θ| of URS, |sin ψ| of RUS, |cos θ| of PUS, 1 of UPS: 0 where the leg is stretched or folded
  S leverage{1};  ///< ‖AB‖ over the distance from the axis, or the like: large where that distance is small
};

/// Twist of a link's mass centre and its rate, in B.
template <class S>
struct ChainLinkMotion {
  Vector3<S> omega, c_dot, omega_dot, c_ddot;
};

/// What the kinematics finds for one leg. Vectors in B; points from A.
///
/// Joints turn about axis[j] through O₁ = A before the proximal link, through O₂ after it, or slide along axis[j].
/// Where no joint turns about O₁ it is the carriage's point.
template <class S>
struct ChainState {
  // displacement
  Vector3<S> Qb, AB;              ///< Q bᵢ; from A to B
  std::array<S, 3> sine, cosine;  ///< of the angles; of a sliding coordinate `cosine` is its value, m
  std::array<Vector3<S>, 3> axis;
  Vector3<S> x_1, along_1, x_2, along_2;  ///< of the links' frames [x, along × x, along]
  LegMargins<S> margins;
  // where the links are
  Vector3<S> O_1, O_2;      ///< first ends of the links
  Vector3<S> RB;            ///< from O₂ to B; what turns about O₂
  Matrix3<S> R_1, R_2;      ///< frames of the links
  Vector3<S> arm_1, arm_2;  ///< from O₁, O₂ to the mass centres
  // rates
  std::array<Vector3<S>, 3> k;  ///< q̇ⱼ = kⱼ · v_B: rows of the leg's map
  Vector3<S> v_B;
  Vector3<S> rate, acceleration;
};

}  // namespace ursula

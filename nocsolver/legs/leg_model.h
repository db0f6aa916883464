#pragma once

#include <array>

#include "model/manipulator.h"

namespace ursula {

/// One leg's parameters in the scalar S, with the fixed frame of (2a).
template <class S>
struct LegModel {
  LegKind kind;
  Vector3<S> a, b;             ///< aᵢ in B, bᵢ in M
  Vector3<S> x_hat, u, z_hat;  ///< columns of Q̂ᵢ (2b), in B
  S l, s;                      ///< lengths of the links
  S knee;                      ///< +1 or −1
  S rho, sigma;                ///< ρᵢ, σᵢ of (39a,b): mass centres along the links from their first ends
  S mass_1, mass_2;            ///< mᵢ, m₆₊ᵢ: proximal, distal link
  Matrix3<S> I_1, I_2;         ///< [Iᵢ]_G, [I₆₊ᵢ]_H
  std::array<S, 3> viscous, coulomb, speed;  ///< friction of the three coordinates
  std::array<S, 3> rotor;                    ///< rotor inertia of the coordinate's motor
  bool has_rotor, off_line;  ///< whether a rotor has inertia; whether a mass centre is off its link's line
  Vector3<S> off_1, off_2;   ///< offsets of the mass centres from the links' lines, in the links' frames
  std::array<int, 3> motor;  ///< index of the motor on the coordinate, −1 if there is none
};

/// The machine in the form that the formulas use: raw parameters in the scalar S.
template <class S>
struct MachineParameters {
  explicit MachineParameters(const Manipulator& manipulator);

  PerLeg<LegModel<S>> legs;
  int legs_in_all;
  Motors motors;
  Vector3<S> gravity;  ///< g, in B
  S mass;              ///< m of the platform
  Vector3<S> rho;      ///< ρ, in M
  Matrix3<S> I_M;      ///< [I_M]_M
  S length;            ///< a length of the machine's size: the largest ‖bᵢ‖ or link, m
};

}  // namespace ursula

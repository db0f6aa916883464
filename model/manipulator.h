#pragma once

#include <array>
#include <string>

#include "model/scalar.h"

namespace ursula {

/// Which of the two bends of the knee: the sign of sin θ.
enum class Knee { positive, negative };

/// One link of a leg. The proximal link runs from A to R along e, the distal one from R to B along s (paper, Fig. 3).
struct Link {
  double length = 0;          ///< l or s, m
  double mass = 0;            ///< kg
  double center_of_mass = 0;  ///< ρᵢ or σᵢ: distance along the link from its first joint, m
  /// [Iᵢ]_G or [I₆₊ᵢ]_H of (46): about the mass centre, in the link's frame of (40), kg·m².
  Matrix3d inertia = Matrix3d::Zero();
};

/// Coefficients of one friction law on the joint coordinates φ, ψ, θ of a leg.
struct JointFriction {
  double actuated = 0;   ///< on φ
  double universal = 0;  ///< on ψ
  double knee = 0;       ///< on θ
};

/// Coulomb friction smoothed to −c tanh(q̇ / smoothing_speed); coefficients in N·m.
struct CoulombFriction : JointFriction {
  double smoothing_speed = 1e-2;  ///< rad/s, > 0
};

struct Leg {
  Vector3d base_point = Vector3d::Zero();      ///< aᵢ, m, in B
  Vector3d base_axis = Vector3d::UnitX();      ///< uᵢ, in B; need not be unit
  Vector3d platform_point = Vector3d::Zero();  ///< bᵢ, m, in M
  Link proximal, distal;
  Knee knee = Knee::positive;
  JointFriction friction;   ///< viscous, N·m·s/rad
  CoulombFriction coulomb;  ///< N·m
};

struct Platform {
  double mass = 0;                             ///< m, kg
  Vector3d center_of_mass = Vector3d::Zero();  ///< ρ, m, in M
  Matrix3d inertia = Matrix3d::Zero();         ///< [I_M]_M about the mass centre, kg·m²
};

/// The raw parameters of the machine, SI: all that the two roads share.
struct ManipulatorParameters {
  Vector3d gravity = {0.0, 0.0, -9.81};  ///< g, m/s², in B
  Platform platform;
  std::array<Leg, leg_count> legs;
};

/// Raw parameters that some machine can have; immutable.
class Manipulator {
 public:
  /// Checks finiteness, positive masses and lengths, non-zero axes, inertias (symmetric, positive definite, within the
  /// triangle inequality) and that every pair of legs is long enough to join base and platform.
  /// Throws InvalidParameter with the key, the value and the bound.
  explicit Manipulator(const ManipulatorParameters& parameters);

  const ManipulatorParameters& parameters() const { return parameters_; }
  const Leg& leg(int i) const { return parameters_.legs[static_cast<std::size_t>(i)]; }
  const Platform& platform() const { return parameters_.platform; }
  const Vector3d& gravity() const { return parameters_.gravity; }

 private:
  ManipulatorParameters parameters_;
};

/// The same machine, but nothing rubs.
Manipulator frictionless(const Manipulator& manipulator);

}  // namespace ursula

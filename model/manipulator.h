#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/scalar.h"
#include "model/leg_kind.h"

namespace ursula {

/// Which of the two bends of the knee: the sign of sin θ for URS, of sin ψ for RUS, of cos θ for PUS.
enum class Knee { positive, negative };

/// One link of a leg. The proximal link runs from A to R along e, the distal one from R to B along s (paper, Fig. 3).
/// Of UPS they are cylinder and rod, both along e; of PUS the first is the carriage, along u.
struct Link {
  double length = 0;          ///< l or s, m
  double mass = 0;            ///< kg
  double center_of_mass = 0;  ///< ρᵢ or σᵢ: distance along the link from its first end, m
  /// [Iᵢ]_G or [I₆₊ᵢ]_H of (46): about the mass centre, in the link's frame of (40), kg·m².
  Matrix3d inertia = Matrix3d::Zero();
  /// What takes the mass centre off the link's line: across it, in the link's frame of (40), m.
  Vector3d off_line = Vector3d::Zero();
};

/// A number for each coordinate of a leg; of those that the leg has not it is zero.
struct PerCoordinate {
  double phi = 0, psi = 0, theta = 0, d = 0;

  double& on(Coordinate coordinate);
  double on(Coordinate coordinate) const { return const_cast<PerCoordinate&>(*this).on(coordinate); }
  bool any() const { return phi != 0 || psi != 0 || theta != 0 || d != 0; }
};
using JointFriction = PerCoordinate;  ///< coefficients of one law of friction

/// Coulomb friction smoothed to −c tanh(q̇ / speed); coefficients in N·m, on d in N.
struct CoulombFriction : JointFriction {
  double smoothing_speed = 1e-2;  ///< of the angles, rad/s, > 0
  double sliding_speed = 1e-2;    ///< of d, m/s, > 0; files give both as one number

  double speedOf(Coordinate coordinate) const { return slides(coordinate) ? sliding_speed : smoothing_speed; }
};

struct Leg {
  Vector3d base_point = Vector3d::Zero();      ///< aᵢ, m, in B
  Vector3d base_axis = Vector3d::UnitX();      ///< uᵢ, in B; need not be unit
  Vector3d platform_point = Vector3d::Zero();  ///< bᵢ, m, in M
  Link proximal, distal;
  Knee knee = Knee::positive;
  JointFriction friction;   ///< viscous, N·m·s/rad, on d N·s/m
  CoulombFriction coulomb;  ///< N·m, on d N
  LegKind kind = LegKind::URS;
  std::array<bool, 3> actuated = {true, false, false};  ///< which of the kind's coordinates a motor drives
  PerCoordinate rotor_inertia;  ///< j of the energy ½ j q̇² of what a motor turns, kg·m², on d kg; of driven ones alone
  /// The rod between two balls, or cylinder and rod, turns freely about its own line and does not to begin with.
  bool spins = false;

  /// Whether a motor drives it.
  bool drives(Coordinate coordinate) const;
  /// Which axis of the proximal link's frame its line is: of a carriage û.
  int proximalLine() const { return kind == LegKind::PUS ? 1 : 2; }
  /// Mass centres from the links' first ends, in their frames.
  Vector3d proximalCenter() const {
    return proximal.off_line + proximal.center_of_mass * Vector3d::Unit(proximalLine());
  }
  Vector3d distalCenter() const { return distal.off_line + distal.center_of_mass * Vector3d::UnitZ(); }
};

/// A coordinate that is driven. Its effort is conjugate to the coordinate's rate: N·m, or N where it slides.
struct Motor {
  int leg = 0;    ///< 0-based
  int joint = 0;  ///< which of the leg's three coordinates
  Coordinate coordinate = Coordinate::phi;

  bool slides() const { return ursula::slides(coordinate); }
  /// "Nm" or "N", as columns write it.
  const char* effortUnit() const { return slides() ? "N" : "Nm"; }
};
using Motors = std::array<Motor, motor_count>;

struct Platform {
  double mass = 0;                             ///< m, kg
  Vector3d center_of_mass = Vector3d::Zero();  ///< ρ, m, in M
  Matrix3d inertia = Matrix3d::Zero();         ///< [I_M]_M about the mass centre, kg·m²
};

/// The raw parameters of the machine, SI: all that the two formulations share.
struct ManipulatorParameters {
  Vector3d gravity = {0.0, 0.0, -9.81};  ///< g, m/s², in B
  Platform platform;
  std::vector<Leg> legs = std::vector<Leg>(leg_count);  ///< three to six
};

/// Raw parameters that some machine can have; immutable.
class Manipulator {
 public:
  /// Checks finiteness, positive masses and lengths, non-zero axes, inertias (symmetric, positive definite, of a thin
  /// rod zero about its line, within the triangle inequality), that there are six motors on three to six legs, that no
  /// other coordinate has a rotor, that what spins is round, and that every pair of legs is long enough to join base
  /// and platform. Throws InvalidParameter with the key, the value and the bound.
  explicit Manipulator(const ManipulatorParameters& parameters);

  /// What moves: a link that spins freely has no moment about its line, as what it has there stays at rest.
  const ManipulatorParameters& parameters() const { return parameters_; }
  /// As it was written.
  const ManipulatorParameters& given() const { return given_; }
  const Leg& leg(int i) const { return parameters_.legs[static_cast<std::size_t>(i)]; }
  int legCount() const { return static_cast<int>(parameters_.legs.size()); }
  /// In leg order, within a leg in the order of its coordinates: the order of efforts.
  const Motors& motors() const { return motors_; }
  /// Six URS legs with a motor on each φ: what the paper's equations are for.
  bool isOfThePaper() const;
  const Platform& platform() const { return parameters_.platform; }
  const Vector3d& gravity() const { return parameters_.gravity; }

 private:
  ManipulatorParameters given_, parameters_;
  Motors motors_;
};

/// Whether some motor turns an inertia of its own.
bool hasRotors(const Manipulator& manipulator);

/// The same machine, but nothing rubs.
Manipulator frictionless(const Manipulator& manipulator);

}  // namespace ursula

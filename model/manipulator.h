#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "base/scalar.h"
#include "model/leg_kind.h"

namespace ursula {

/// Selects the branch of the knee: the sign of sin θ for URS, of sin ψ for RUS, of cos θ for PUS.
enum class Knee { positive, negative };

/// One link of a leg. The proximal link runs from A to R along e, the distal one from R to B along s (paper, Fig. 3).
/// For UPS they are cylinder and rod, both along e; for PUS the first is the carriage, along u.
struct Link {
  double length = 0;          ///< l or s, m
  double mass = 0;            ///< kg
  double center_of_mass = 0;  ///< ρᵢ or σᵢ: distance along the link from its first end, m
  /// [Iᵢ]_G or [I₆₊ᵢ]_H of (46): about the mass centre, in the link's frame of (40), kg·m².
  Matrix3d inertia = Matrix3d::Zero();
  /// Offset of the mass centre across the link's line, in the link's frame of (40), m.
  Vector3d off_line = Vector3d::Zero();
};

/// One number for each coordinate of a leg; zero for coordinates that the leg lacks.
struct PerCoordinate {
  double phi = 0, psi = 0, theta = 0, d = 0;

  double& on(Coordinate coordinate);
  double on(Coordinate coordinate) const { return const_cast<PerCoordinate&>(*this).on(coordinate); }
  bool any() const { return phi != 0 || psi != 0 || theta != 0 || d != 0; }
};
using JointFriction = PerCoordinate;  ///< coefficients of one friction law

/// Coulomb friction smoothed to −c tanh(q̇ / speed); coefficients in N·m, for d in N.
struct CoulombFriction : JointFriction {
  double smoothing_speed = 1e-2;  ///< for the angles, rad/s, > 0
  double sliding_speed = 1e-2;    ///< for d, m/s, > 0; files give both as one number

  double speedOf(Coordinate coordinate) const { return slides(coordinate) ? sliding_speed : smoothing_speed; }
};

struct Leg {
  Vector3d base_point = Vector3d::Zero();      ///< aᵢ, m, in B
  Vector3d base_axis = Vector3d::UnitX();      ///< uᵢ, in B; need not be unit
  Vector3d platform_point = Vector3d::Zero();  ///< bᵢ, m, in M
  Link proximal, distal;
  Knee knee = Knee::positive;
  JointFriction friction;   ///< viscous, N·m·s/rad, for d N·s/m
  CoulombFriction coulomb;  ///< N·m, for d N
  LegKind kind = LegKind::URS;
  std::array<bool, 3> actuated = {true, false, false};  ///< which of the kind's coordinates a motor drives
  PerCoordinate rotor_inertia;  ///< j in the rotor's energy ½ j q̇², kg·m², for d kg; zero unless driven
  /// Whether the rod between two balls, or cylinder and rod, turns freely about its line. At first it does not spin.
  bool spins = false;

  /// Returns whether a motor drives the coordinate.
  bool drives(Coordinate coordinate) const;
  /// Returns the axis of the proximal link's frame along its line; for a carriage that is û.
  int proximalLine() const { return rowOf(kind).hasCarriage() ? 1 : 2; }
  /// These functions return the mass centres relative to the links' first ends, in the links' frames.
  Vector3d proximalCenter() const {
    return proximal.off_line + proximal.center_of_mass * Vector3d::Unit(proximalLine());
  }
  Vector3d distalCenter() const { return distal.off_line + distal.center_of_mass * Vector3d::UnitZ(); }
};

/// A driven coordinate. Its effort is conjugate to the coordinate's rate: N·m, or N if it slides.
struct Motor {
  int leg = 0;    ///< 0-based
  int joint = 0;  ///< index among the leg's three coordinates
  Coordinate coordinate = Coordinate::phi;

  bool slides() const { return ursula::slides(coordinate); }
  /// Returns "Nm" or "N", as in column names.
  const char* effortUnit() const { return slides() ? "N" : "Nm"; }
};
using Motors = PerMotor<Motor>;

inline bool allSlide(const Motors& motors) {
  return std::all_of(motors.begin(), motors.end(), [](const Motor& motor) { return motor.slides(); });
}
inline bool anySlides(const Motors& motors) {
  return std::any_of(motors.begin(), motors.end(), [](const Motor& motor) { return motor.slides(); });
}

/// m (r² 1 − r rᵀ), the inertia of a point mass, kg·m².
inline Matrix3d pointInertia(double mass, const Vector3d& r) {
  return mass * (r.squaredNorm() * Matrix3d::Identity() - r * r.transpose());
}

struct Platform {
  double mass = 0;                             ///< m, kg
  Vector3d center_of_mass = Vector3d::Zero();  ///< ρ, m, in M
  Matrix3d inertia = Matrix3d::Zero();         ///< [I_M]_M about the mass centre, kg·m²
};

/// The machine's raw parameters, SI. The NOC and the engines share nothing else.
struct ManipulatorParameters {
  Vector3d gravity = {0.0, 0.0, -9.81};  ///< g, m/s², in B
  Platform platform;
  std::vector<Leg> legs = std::vector<Leg>(leg_count);  ///< three to six
};

/// Raw parameters of a possible machine; immutable.
class Manipulator {
 public:
  /// Checks finiteness, positive masses and lengths, non-zero axes, and six motors on three to six legs. Inertias must
  /// be symmetric, positive definite and satisfy the triangle inequality; a thin rod may have zero about its line. Only
  /// driven coordinates may have rotors. Links that spin must be round. Each pair of legs must be long enough to join
  /// base and platform. Throws InvalidParameter with key, value and bound.
  explicit Manipulator(const ManipulatorParameters& parameters);

  /// Returns the parameters of the moving machine: here a freely spinning link has no inertia about its line, because
  /// it never begins to spin.
  const ManipulatorParameters& parameters() const { return parameters_; }
  /// Returns the parameters as given.
  const ManipulatorParameters& given() const { return given_; }
  const Leg& leg(int i) const { return parameters_.legs[i]; }
  int legCount() const { return static_cast<int>(parameters_.legs.size()); }
  /// Returns the motors in the order of efforts: by leg, then by the leg's coordinates.
  const Motors& motors() const { return motors_; }
  /// Returns whether it has six URS legs with a motor on each φ; the paper's equations hold for these.
  bool isOfThePaper() const;
  const Platform& platform() const { return parameters_.platform; }
  const Vector3d& gravity() const { return parameters_.gravity; }

 private:
  ManipulatorParameters given_, parameters_;
  Motors motors_;
};

/// Returns whether some motor has a rotor inertia.
bool hasRotors(const Manipulator& manipulator);

/// Returns the same machine without friction.
Manipulator frictionless(const Manipulator& manipulator);

}  // namespace ursula

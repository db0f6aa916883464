#pragma once

#include <array>
#include <optional>
#include <stdexcept>
#include <string>

#include "parts/fast/solver.h"

namespace ursula {

/// What one leg does at a pose of the platform.
struct LegAtPose {
  double distance = 0;    ///< ‖AᵢBᵢ‖, m
  bool in_reach = false;  ///< |l − s| ≤ distance ≤ l + s
  /// Whether the third component of (13) is positive: inverse kinematics then returns the given φ, else φ ± π.
  bool front = false;
  /// ψ and θ of (13), (27) for the manipulator's own knee branch, rad; NaN if out of reach. The other branch also
  /// reaches, at −θ and ψ − 2 atan2(s sin θ, l − s cos θ).
  double psi = 0, theta = 0;
};

/// One pose of the platform for given actuated angles; vectors in B.
struct PlatformPose {
  Vector3d p = Vector3d::Zero();                 ///< position of P, m
  Matrix3d Q = Matrix3d::Identity();             ///< orientation of M in B
  Eigen::Vector4d q = Eigen::Vector4d::UnitX();  ///< the same as a unit quaternion [w, x, y, z], w ≥ 0
  int multiplicity = 1;                          ///< number of poses that rounding merges into this one
  /// Largest mismatch, m, in (27) over l + s and in (13); a leg out of reach has only the first component of (13).
  double residual = 0;
  PerLeg<LegAtPose> legs;
  bool assembles = false;  ///< every leg is in reach, so the machine can be assembled at this pose
  bool front = false;      ///< every leg is in front: inverse kinematics returns the given angles
};

/// All real poses for given actuated angles, at most eight. Poses that assemble come first, of those the ones in front,
/// then by decreasing w, x, y, z of the quaternion.
struct PlatformPoses {
  std::array<PlatformPose, 8> list;
  int size = 0;
  /// Number of complex solutions found, with multiplicities. If it is 8, none is missing.
  int counted = 0;

  const PlatformPose* begin() const { return list.data(); }
  const PlatformPose* end() const { return list.data() + size; }
};

/// The actuated angles leave the platform free to move, or determine its pose too poorly for doubles.
class UndeterminedPose : public std::runtime_error {
 public:
  UndeterminedPose(const std::string& what, double measure, double bound);
  double measure() const { return measure_; }  ///< a ratio of pivots: 0 if the platform is free, about 1 far from that
  double bound() const { return bound_; }      ///< `measure` had to exceed this

 private:
  double measure_, bound_;
};

/// Direct kinematics, section 2.3 of the paper: the platform's motion from that of the six motors.
/// docs/direct_kinematics.md explains the method. Immutable; threads may share it. Does not allocate.
class DirectKinematics {
 public:
  explicit DirectKinematics(const Manipulator& manipulator)
      : solver_(manipulator), of_the_paper_(manipulator.isOfThePaper()) {}

  /// Returns every real pose for φ, rad: the solutions of (27) with (13), including those that legs cannot reach.
  /// Throws UndeterminedPose if there are infinitely many, or nearly so; std::invalid_argument unless φ is finite;
  /// std::domain_error unless the machine is of the paper's kind.
  PlatformPoses poses(const Vector6d& phi) const;

  /// Continues `from` to the pose for φ, or for other driven coordinates, by Newton's method; legs may be of any kinds.
  /// Returns nullopt if the steps do not shrink as they do near a solution, or would cross a singular pose. Then `from`
  /// is too far away, or no continuation exists.
  std::optional<PlatformPose> track(const Vector6d& phi, const PlatformPose& from) const;

  /// Returns the platform's motion at `pose` for rates and accelerations of φ, rad/s and rad/s², by (24) and (25).
  /// Leaves displacements, rates and Jacobians in `work`. Throws PoseError like Solver: out of reach, stretched,
  /// singular.
  Motion<double> motion(const PlatformPose& pose, const Vector6d& phi_dot, const Vector6d& phi_ddot,
                        Workspace<double>& work) const;

  const Solver<double>& solver() const { return solver_; }

 private:
  /// Throws std::domain_error for other kinds of machines.
  const MachineParameters<double>& paper() const;

  Solver<double> solver_;
  bool of_the_paper_;
};

}  // namespace ursula

#pragma once

#include <array>
#include <optional>
#include <stdexcept>
#include <string>

#include "nocsolver/solver.h"

namespace ursula {

/// What a pose of the platform needs of one leg.
struct LegAtPose {
  double distance = 0;    ///< ‖AᵢBᵢ‖, m
  bool in_reach = false;  ///< |l − s| ≤ distance ≤ l + s
  /// The third component of (13) is positive: inverse kinematics answers with the φ given, else with φ ± π.
  bool front = false;
  /// ψ and θ of (13), (27) for the manipulator's own bend of the knee, rad; not numbers where out of reach. The other
  /// bend reaches as well, at −θ and ψ − 2 atan2(s sin θ, l − s cos θ).
  double psi = 0, theta = 0;
};

/// One pose of the platform for given actuated angles; vectors in B.
struct PlatformPose {
  Vector3d p = Vector3d::Zero();                 ///< position of P, m
  Matrix3d Q = Matrix3d::Identity();             ///< orientation of M in B
  Eigen::Vector4d q = Eigen::Vector4d::UnitX();  ///< the same as a unit quaternion [w, x, y, z], w ≥ 0
  int multiplicity = 1;                          ///< how many poses cannot be told from this one in the arithmetic
  /// Largest mismatch, m, in (27) over l + s and in (13); of a leg out of reach, in the first component of (13) only.
  double residual = 0;
  std::array<LegAtPose, leg_count> legs;
  bool assembles = false;  ///< every leg is in reach: the machine can be put together so
  bool front = false;      ///< every leg is in front: inverse kinematics answers with the angles given
};

/// All real poses for given actuated angles, at most eight: first those that assemble, of them first those in front,
/// then by falling w, x, y, z of the quaternion.
struct PlatformPoses {
  std::array<PlatformPose, 8> list;
  int size = 0;
  /// Solutions in the complex numbers that were found, with their multiplicities: 8 proves that none is missing.
  int counted = 0;

  const PlatformPose* begin() const { return list.data(); }
  const PlatformPose* end() const { return list.data() + size; }
};

/// The actuated angles leave the platform free to move, or so nearly that its poses are not determined in double.
class UndeterminedPose : public std::runtime_error {
 public:
  UndeterminedPose(const std::string& what, double measure, double bound);
  double measure() const { return measure_; }  ///< a ratio of pivots: 0 where the platform is free, about 1 far from it
  double bound() const { return bound_; }      ///< what `measure` had to exceed

 private:
  double measure_, bound_;
};

/// Direct kinematics, section 2.3 of the paper: the platform's motion from that of the six motors. See
/// docs/direct_kinematics.md for the method. Immutable, may be shared by threads. Nothing here allocates.
class DirectKinematics {
 public:
  explicit DirectKinematics(const Manipulator& manipulator)
      : solver_(manipulator), of_the_paper_(manipulator.isOfThePaper()) {}

  /// Every real pose for φ, rad: the solutions of (27) with (13), and those in which legs do not reach.
  /// Throws UndeterminedPose where there are infinitely many, or nearly so; std::invalid_argument unless φ is finite;
  /// std::domain_error unless the machine is of the paper's kind.
  PlatformPoses poses(const Vector6d& phi) const;

  /// The pose for φ, or what else the motors drive, that continues `from`, by Newton, for legs of any kinds. None where
  /// Newton's steps do not shrink as they must near a solution, or where it would cross a singular pose: then `from` is
  /// too far, or there is nothing to continue to.
  std::optional<PlatformPose> track(const Vector6d& phi, const PlatformPose& from) const;

  /// The platform's motion at `pose` for rates and accelerations of φ, rad/s and rad/s², by (24) and (25). Leaves
  /// displacements, rates and Jacobians in `work`. Throws PoseError as Solver does: out of reach, stretched, singular.
  Motion<double> motion(const PlatformPose& pose, const Vector6d& phi_dot, const Vector6d& phi_ddot,
                        Workspace<double>& work) const;

  const Solver<double>& solver() const { return solver_; }

 private:
  /// Throws std::domain_error where the machine is of another kind.
  const MachineParameters<double>& paper() const;

  Solver<double> solver_;
  bool of_the_paper_;
};

}  // namespace ursula

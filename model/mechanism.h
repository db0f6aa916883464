#pragma once

#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "base/scalar.h"

namespace ursula {

/// A body at the reference pose, that of the model file. Vectors are in world axes, SI.
struct MechanismBody {
  std::string name;
  int line = 0;                                             ///< in the file, 1-based; 0 if unknown
  bool fixed = false;                                       ///< the world itself, or a static body
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();  ///< the body's own frame in the world
  double mass = 0;                                          ///< kg; a frame between two joints has none
  Vector3d center_of_mass = Vector3d::Zero();               ///< position in the world, m
  Matrix3d inertia = Matrix3d::Zero();                      ///< about the mass centre, world axes, kg·m²
  double inertia_rounding = 0;                              ///< half a unit of the last digit in the file
  bool weightless = false;                                  ///< gravity does not act on it
};

enum class JointKind { fixed, revolute, prismatic, universal, ball, free };

/// Returns the number of coordinates of a joint: 0 to 6.
int freedomsOf(JointKind kind);

/// A joint between two bodies at the reference pose. If `closure` is set, the file closes a loop with it.
struct MechanismJoint {
  std::string name;
  int line = 0;
  JointKind kind = JointKind::fixed;
  std::size_t parent = 0, child = 0;            ///< indices into bodies
  Vector3d centre = Vector3d::Zero();           ///< on the parent's side, in the world, m
  Vector3d centre_of_child = Vector3d::Zero();  ///< on the child's side; differs if a closure is open
  /// Takes the child's side to the parent's; not the identity if a closure is open.
  Matrix3d turn = Matrix3d::Identity();
  /// Unit vectors in the world. Revolute and prismatic use the first, universal both (parent's first). A
  /// coordinate grows as the child turns about or slides along its axis.
  std::array<Vector3d, 2> axis = {Vector3d::Zero(), Vector3d::Zero()};
  double position = 0;  ///< coordinate at the reference pose, rad or m
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();
  double damping = 0, friction = 0;  ///< viscous; Coulomb: friction·tanh(rate / smoothing_speed)
  double smoothing_speed = 0;        ///< of Coulomb friction, rad/s or m/s; 0 if the file gives none
  double rotor_inertia = 0;          ///< armature, kg·m² or kg, added to the coordinate's own inertia
  double stiffness = 0;              ///< of a spring, N·m/rad or N/m: −stiffness·(coordinate − spring_reference)
  double spring_reference = 0;       ///< the coordinate at which the spring is at rest, rad or m
  bool driven = false;               ///< the format says that a motor drives it
  bool closure = false;

  /// Returns the displacement of the child, in the world, that closes a joint which is open at the reference pose.
  Eigen::Isometry3d closing() const {
    Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
    out.linear() = turn;
    out.translation() = centre - turn * centre_of_child;
    return out;
  }
  bool isOpen() const { return centre != centre_of_child || turn != Matrix3d::Identity(); }
  bool slides() const { return kind == JointKind::prismatic; }
  /// Returns the smoothing speed, or that of `coulomb` if the file gives none.
  double smoothing() const { return smoothing_speed > 0 ? smoothing_speed : 1e-2; }
  /// Returns whether something acts along its coordinates beside a motor.
  bool isLoaded() const { return damping != 0 || friction != 0 || rotor_inertia != 0 || stiffness != 0; }
};

/// The raw parameters of a machine with any closed loops, SI; the solver and the engines share nothing else.
struct MechanismParameters {
  std::string name;
  Vector3d gravity = {0.0, 0.0, -9.81};
  std::vector<MechanismBody> bodies;
  std::vector<MechanismJoint> joints;
  std::vector<std::string> motors;  ///< driven joints, in the order of efforts
  /// Displacement of each body from the reference pose, x = D x₀, where the loops are closed; empty if the reference
  /// pose closes them to the file's digits. Angles lie within half a turn.
  std::vector<Eigen::Isometry3d> start;
};

/// Raw parameters of a possible mechanism; immutable. Its motors are joints of one coordinate each.
class Mechanism {
 public:
  /// `output` is the body whose motion is reported; empty for the body farthest from the base, counted in joints.
  /// Throws InvalidParameter (places `mechanism.…`) for numbers that no body has, for motors that are no hinge or
  /// slide, and for an unknown output.
  explicit Mechanism(MechanismParameters parameters, const std::string& output = "");

  const MechanismParameters& parameters() const { return parameters_; }
  const std::vector<MechanismBody>& bodies() const { return parameters_.bodies; }
  const std::vector<MechanismJoint>& joints() const { return parameters_.joints; }
  const Vector3d& gravity() const { return parameters_.gravity; }
  std::size_t motorCount() const { return motors_.size(); }
  /// Returns the indices of the driven joints, in the order of efforts.
  const std::vector<std::size_t>& motors() const { return motors_; }
  const MechanismJoint& motor(std::size_t k) const { return parameters_.joints[motors_[k]]; }
  /// Returns "Nm" or "N", as in column names.
  const char* effortUnit(std::size_t k) const { return motor(k).slides() ? "N" : "Nm"; }
  std::size_t output() const { return output_; }  ///< index of a body
  /// Where engines begin to close the loops: parameters().start.
  const std::vector<Eigen::Isometry3d>& start() const { return parameters_.start; }
  void startAt(std::vector<Eigen::Isometry3d> start) { parameters_.start = std::move(start); }
  /// Returns the diameter of the cloud of its joints and mass centres at the reference pose, m, > 0.
  double length() const { return length_; }

 private:
  MechanismParameters parameters_;
  std::vector<std::size_t> motors_;
  std::size_t output_ = 0;
  double length_ = 1;
};

}  // namespace ursula

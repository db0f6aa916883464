#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "model/mechanism.h"

namespace ursula {

/// Bodies that fixed joints weld together, as one rigid body at the reference pose.
struct WeldedBodies {
  bool fixed = false;
  double mass = 0;
  Vector3d center = Vector3d::Zero();  ///< of mass; without mass, of a joint
  Matrix3d inertia = Matrix3d::Zero();
  double weight = 0;                       ///< the mass that gravity acts on
  Vector3d weight_arm = Vector3d::Zero();  ///< from center to where it acts
};

/// All welded bodies of a mechanism; number 0 is the ground, whose centre is the engines' origin.
struct WeldedMechanism {
  explicit WeldedMechanism(const Mechanism& mechanism);

  std::vector<WeldedBodies> welds;
  std::vector<std::size_t> of_body;  ///< the number of each body of the mechanism

  std::size_t parentOf(const MechanismJoint& joint) const { return of_body[joint.parent]; }
  std::size_t childOf(const MechanismJoint& joint) const { return of_body[joint.child]; }
};

/// Where welded bodies are: turn from the reference pose, centre from the engines' origin, twist of the centre.
struct WeldState {
  Matrix3d R = Matrix3d::Identity();
  Vector3d c = Vector3d::Zero(), w = Vector3d::Zero(), v = Vector3d::Zero();
};

/// A linear form of the twists of two welds a and b, and what it is the rate of.
struct JointRow {
  enum class Kind {
    point,  ///< along · (point of b − point of a), with `along` on a
    dot,    ///< along · with − constant, with `along` on a and `with` on b
    turn,   ///< along · (ω_b − ω_a), with `along` on b or on a; the rate of no function
  };
  Kind kind = Kind::point;
  std::size_t joint = 0, a = 0, b = 0;
  Vector3d on_a = Vector3d::Zero(), on_b = Vector3d::Zero();  ///< points, from the welds' centres
  Vector3d along = Vector3d::Zero(), with = Vector3d::Zero();
  bool is_on_b = false;
  double constant = 0;
};

/// A row at a pose: rate = of_a · twist of a + of_b · twist of b; its derivative has the same factors, and a bias.
struct JointRowNow {
  double value = 0;
  Vector6d of_a = Vector6d::Zero(), of_b = Vector6d::Zero();
  double bias = 0;
};
JointRowNow rowNow(const JointRow& row, const WeldState& a, const WeldState& b);

/// A coordinate of a motor or of a loaded joint.
struct JointCoordinate {
  const MechanismJoint* joint = nullptr;
  int index = 0;  ///< among those of the joint
  JointRow row;   ///< of its rate
};
/// Returns a coordinate's value; of an angle the one nearest to `near`.
double valueOf(const JointCoordinate& coordinate, const WeldState& a, const WeldState& b, double near);

/// Returns what the joint holds fixed. Empty for joints within one weld.
std::vector<JointRow> rowsOf(const Mechanism& mechanism, std::size_t joint, const WeldedMechanism& welded);
/// Returns a joint's coordinates. Those of balls are angular components in the axes of the child's frame, those of free
/// joints then also linear ones in the parent's.
std::vector<JointCoordinate> coordinatesOf(const Mechanism& mechanism, std::size_t joint,
                                           const WeldedMechanism& welded);

}  // namespace ursula

#pragma once

#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/errors.h"
#include "base/scalar.h"

namespace ursula::exchange {

/// A body of a model file, at the file's initial pose; vectors in world axes, SI.
struct GraphBody {
  std::string name;                                         ///< its name in the file
  int line = 0;                                             ///< in the file, 1-based; 0 if unknown
  bool fixed = false;                                       ///< the world itself, or a static body
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();  ///< the body's own frame in the world
  double mass = 0;                                          ///< kg
  Vector3d center_of_mass = Vector3d::Zero();               ///< position in the world, m
  Matrix3d inertia = Matrix3d::Zero();                      ///< about the mass centre, world axes, kg·m²
  double inertia_rounding = 0;                              ///< half a unit of the last digit in the file
  bool weightless = false;                                  ///< the file disables gravity for it
};

enum class JointKind { fixed, revolute, prismatic, universal, ball, free };

/// A joint between two bodies. If `closure` is set, it closes a loop of the other joints' tree.
struct GraphJoint {
  std::string name;
  int line = 0;
  JointKind kind = JointKind::fixed;
  std::size_t parent = 0, child = 0;            ///< indices into ModelGraph::bodies
  Vector3d centre = Vector3d::Zero();           ///< on the parent's side, in the world, m
  Vector3d centre_of_child = Vector3d::Zero();  ///< on the child's side; differs if a closure is open
  Matrix3d turn =
      Matrix3d::Identity();  ///< takes the child's side to the parent's; not the identity if a closure is open
  /// Unit vectors in the world. Revolute and prismatic use the first, universal both (parent's first). A
  /// coordinate grows as the child turns about or slides along its axis.
  std::array<Vector3d, 2> axis = {Vector3d::Zero(), Vector3d::Zero()};
  double position = 0;  ///< coordinate at the initial pose, rad or m
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();
  double damping = 0, friction = 0;  ///< viscous; Coulomb
  double smoothing_speed = 0;        ///< of Coulomb friction, rad/s or m/s; 0 if the file gives none
  double rotor_inertia = 0;          ///< kg·m² or kg, added to the coordinate's own inertia
  bool driven = false;               ///< the format says that a motor drives it
  bool closure = false;

  /// Returns the displacement of the child, in the world, that closes a joint which is open at the initial pose.
  Eigen::Isometry3d closing() const {
    Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
    out.linear() = turn;
    out.translation() = centre - turn * centre_of_child;
    return out;
  }
  bool isOpen() const { return centre != centre_of_child || turn != Matrix3d::Identity(); }
};

/// One assumption of the import, with its size in the machine's own units.
struct Assumption {
  std::string what;   ///< a full sentence
  std::string where;  ///< bodies, joints or place in the file
  double size = 0;
  std::string unit = "1";  ///< "m", "rad", "1", "kg", …
  bool warning = false;    ///< the file may not mean what was read; warnings come first
};
using Assumptions = std::vector<Assumption>;
/// Returns one line of text, "warning: JOINT: This joint is open … (0.01 m)".
std::string inWords(const Assumption& assumption);

enum class ModelFormat { sdf, mjcf, urdf };

/// The content of a model file in any format: bodies, primitive joints, closures, motors and gravity.
struct ModelGraph {
  ModelFormat format = ModelFormat::sdf;
  std::string name;
  Vector3d gravity = {0.0, 0.0, -9.81};
  std::vector<GraphBody> bodies;
  std::vector<GraphJoint> joints;
  std::vector<std::string> motors;  ///< driven joints in the order of the file's motors, or of the user's choice
  Assumptions assumptions;
};

/// A model that cannot be imported: what is wrong, what was expected, what would help. The line of the file is 1-based,
/// or 0 if no single line causes it.
class ImportError : public InputError {
 public:
  explicit ImportError(const std::string& what, int at_line = 0) : InputError(what), line(at_line) {}

  int line;
};

}  // namespace ursula::exchange

#pragma once

// Internals of SimbodyMechanism; only simbody_mechanism*.cpp include it.

#include <Eigen/QR>
#include <optional>
#include <string>
#include <vector>

#include "simbody/simbody_mechanism.h"
#include "simbody/simbody_mechanism_tree.h"
#include "simbody/simtk_internal.h"

namespace ursula {

/// A solution of least squares, and of least norm among these. The rank is where the pivots fall the most.
class LeastSquares {
 public:
  explicit LeastSquares(const Eigen::MatrixXd& A);
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  Eigen::Index rank() const { return rank_; }
  /// Returns a basis of the x with A x = 0, as columns.
  Eigen::MatrixXd kernel() const;
  /// Returns the indices of the independent columns.
  Eigen::VectorXi independentColumns() const;

 private:
  Eigen::Index columns_, rank_ = 0;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr_;
  std::optional<Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>> of_lower_rank_;
};

/// A body in Simbody. Its frame has the world's axes at the reference pose, and its origin in the mass centre; massless
/// bodies have theirs in their joint.
struct BodyInSimbody {
  SimTK::MobilizedBody mobilizer;
  Vector3d origin = Vector3d::Zero();  ///< at the reference pose
};

/// A coordinate of a motor or of a loaded joint.
struct CoordinateInSimbody {
  enum class Row {
    tree,     ///< a coordinate of a mobilizer
    angular,  ///< of bodies: component of the relative angular velocity
    linear,   ///< of bodies: component of the relative velocity of the joint's point
  };
  std::size_t joint;
  int index;  ///< among the joint's own
  Row row;
  int u = -1, q = -1;                ///< tree: index in Simbody's u and q
  double sign = 1;                   ///< tree: −1 if the mobilizer goes from child to parent
  Vector3d axis = Vector3d::Zero();  ///< of bodies, at the reference pose on the parent's side
  bool is_on_child = false;          ///< whether the child carries the axis
  mutable double turns_near = 0;     ///< of bodies: the last angle, which says the number of turns
};

/// Consecutive rows of the constraint Jacobian.
struct CutRows {
  SimTK::Constraint constraint;
  std::size_t joint;  ///< that is cut
  bool angular;
};

/// A spin of a body about its own line that closures and motors leave free. Nothing drives it, so the body keeps û·ω,
/// and it began at rest: û·ω = 0, whatever turns beside it.
struct IdleSpin {
  std::size_t body;
  Vector3d line;  ///< at the reference pose
};

/// Returns the angle from `from` to `to` about a unit axis.
double angleAbout(const Vector3d& axis, const Vector3d& from, const Vector3d& to);
/// Returns a unit vector perpendicular to a unit axis.
Vector3d anyAcross(const Vector3d& axis);

/// The linear form of a coordinate's rate: rate = J u, its derivative J u̇ + bias.
struct CoordinateRow {
  Eigen::VectorXd J;
  double bias = 0;
};

struct SimbodyMechanism::Impl {
  Impl(const Mechanism& of, Tree kind);

  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter;
  SimTK::GeneralForceSubsystem forces;
  SimTK::Force::Gravity gravity;
  SimTK::Force::DiscreteForces discrete;  ///< motors and loads, if Simbody computes accelerations itself
  Mechanism mechanism;
  SpanningTree tree;
  std::vector<BodyInSimbody> bodies;
  std::vector<CutRows> cut_rows;
  std::vector<CoordinateInSimbody> coordinates;  ///< those of the motors first, in their order
  std::vector<IdleSpin> spins;
  SimTK::State state;
  SimTK::Vector q_of_file;
  SimTK::Vector u_dot;  ///< accelerations last placed or computed
  /// The machine's length where rows and coordinates are lengths, else 1: rows are divided, columns multiplied.
  Eigen::VectorXd row_scale, column_scale;
  std::vector<std::size_t> joint_of_row;
  /// Whether a coordinate moves a row of Simbody's Jacobian, and coordinates that share no row: they take one sweep.
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> moves;
  std::vector<std::vector<int>> sweeps;
  std::optional<Eigen::MatrixXd> rates;  ///< of all coordinates by those of the motors, at the placed state
  bool simbodys_own = true;

  Eigen::Index motorCount() const { return static_cast<Eigen::Index>(mechanism.motorCount()); }
  const MechanismJoint& jointOf(const CoordinateInSimbody& c) const { return mechanism.joints()[c.joint]; }
  void realize(SimTK::Stage stage) const { system.realize(state, stage); }

  // --- build ---
  void addStep(const SpanningTree::Step& step);
  void addCut(std::size_t joint);
  void addGimbal(const SpanningTree::Gimbal& gimbal);
  void addBall(std::size_t joint, std::size_t a, const Vector3d& on_a, std::size_t b, const Vector3d& on_b);
  void addAngle(std::size_t joint, std::size_t a, const Vector3d& on_a, std::size_t b, const Vector3d& on_b,
                double angle);
  void addPlane(std::size_t joint, const Vector3d& normal);
  void addTurn(std::size_t joint);
  void addCoordinates();
  void addCoordinate(std::size_t joint);
  void addScales();
  void addSweeps();
  /// Finds the idle spins, and holds them at rest.
  void holdSpins();
  void addForces();
  /// Moves the mobilizers to mechanism.start(), if there is one.
  void setStart();
  /// Returns the joint's frame on its parent's or its child's side; the axes are given at the parent's side.
  SimTK::Transform side(std::size_t joint, bool of_child, const Matrix3d& axes) const;

  // --- kinematics ---
  Eigen::Isometry3d displacement(std::size_t body) const;
  Matrix3d rotation(std::size_t body) const { return toEigen(bodies[body].mobilizer.getBodyRotation(state)); }
  Vector3d omega(std::size_t body) const { return toEigen(bodies[body].mobilizer.getBodyAngularVelocity(state)); }
  /// Returns the Jacobian [angular; linear] of a body's frame at a point in the world.
  Eigen::MatrixXd frameJacobian(std::size_t body, const Vector3d& point) const;
  Vector6d frameBias(std::size_t body, const Vector3d& point) const;
  Vector3d axisNow(const CoordinateInSimbody& c) const;
  double value(const CoordinateInSimbody& c) const;  ///< in the file's coordinates
  double angleOfCut(const CoordinateInSimbody& c) const;
  double rate(const CoordinateInSimbody& c) const;
  /// Needs stage Position, with the bias Velocity.
  CoordinateRow row(const CoordinateInSimbody& c, bool with_bias) const;
  Eigen::VectorXd motorValues() const;

  // --- closures; all scaled ---
  /// Returns the constraint Jacobian over the rows of idle spins.
  Eigen::MatrixXd closureRows() const;
  /// Returns the same over the motors' rows.
  Eigen::MatrixXd allRows() const;
  Eigen::VectorXd closureErrors() const;
  Eigen::VectorXd closureBias() const;
  double motorScale(Eigen::Index k) const { return mechanism.motor(k).slides() ? mechanism.length() : 1; }
  void step(const Eigen::VectorXd& scaled);
  /// Returns whether Newton's method brought the motors to `target` quickly.
  bool newton(const Eigen::VectorXd& target);
  void moveTo(const Eigen::VectorXd& target, double t);
  /// Closes the loops by least movement. Throws std::domain_error if that fails.
  void close();
  std::string worstJoint() const;
  void setRates(const MotorMotion& motion);
  void setRatesByMotors(const LeastSquares& factors);

  // --- dynamics ---
  /// Returns the forces of loads and motors on the coordinates u; needs stage Velocity.
  Eigen::VectorXd loads(const Eigen::VectorXd* efforts) const;
  /// Returns Simbody's residual of the open tree with rotors, for these accelerations and forces.
  Eigen::VectorXd residual(const SimTK::Vector& accelerations, const Eigen::VectorXd& applied) const;
  SimTK::Vector eliminated(const Eigen::VectorXd& efforts) const;
  SimTK::Vector byRealizing(const Eigen::VectorXd& efforts);
  /// The same, quicker, at any state near closed loops; where Simbody's own serves.
  SimTK::Vector byMultipliers(const Eigen::VectorXd& efforts) const;
  bool simbodyAgrees();
  Eigen::VectorXd motorAccelerations() const;
  BodyState stateOf(std::size_t body, const SimTK::Vector_<SimTK::SpatialVec>& accelerations) const;
  BodyState stateOf(const SpanningTree::Gimbal& gimbal, const std::vector<BodyState>& states) const;
};

}  // namespace ursula

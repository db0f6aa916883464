#pragma once

// The inside of SimbodyLoop; included by simbody_loop*.cpp only. Never `using namespace SimTK` here: beside Eigen it
// breaks Eigen's comparisons.

#include <Simbody.h>

#include <array>
#include <optional>
#include <vector>

#include <Eigen/LU>

#include "engines/simbody/simbody_loop.h"

namespace ursula {

inline SimTK::Vec3 toSimTK(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Vector3d toEigen(const SimTK::Vec3& v) { return {v[0], v[1], v[2]}; }

inline SimTK::Rotation toSimTK(const Matrix3d& R) {
  // trustMe: re-orthogonalising would move the pose that was asked for.
  return SimTK::Rotation(SimTK::Mat33(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
                         true);
}

inline Matrix3d toEigen(const SimTK::Rotation& R) {
  Matrix3d out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out(i, j) = R[i][j];
  return out;
}

/// [ω; v] or [n; f].
inline Vector6d toEigen(const SimTK::SpatialVec& v) {
  Vector6d out;
  out << toEigen(v[0]), toEigen(v[1]);
  return out;
}

inline Eigen::Map<const Eigen::VectorXd> mapped(const SimTK::Vector& v) {
  return {v.size() > 0 ? &v[0] : nullptr, v.size()};
}

/// What Simbody asks for forces that are not its own: torques, Coulomb friction, the load on the platform.
struct AppliedForces {
  Vector6d torques = Vector6d::Zero();  ///< of the motors
  SimbodyLoop::TorqueHistory history;   ///< instead of `torques`, where set
  std::shared_ptr<const Load> load;
  std::vector<Leg> legs;  ///< whose Coulomb friction it is
  Motors motors;
  bool any_coulomb = false;
};

/// Handles on the bodies and on the balls that close the loops.
struct Mechanism {
  std::vector<SimTK::MobilizedBody> proximal, distal;
  std::vector<int> joints_of_proximal;
  SimTK::MobilizedBody platform;
  std::vector<SimTK::Constraint::Ball> balls;

  /// What a motor turns: a wheel on Ground that a coupler has turn by the leg's coordinate, radians for metres where
  /// that slides. Behind all else in Simbody's order.
  struct Rotor {
    SimTK::MobilizedBody wheel;
    int joint, leg;
  };
  std::vector<Rotor> rotors;

  /// The body that a leg's joint moves, and which of its mobilizer's coordinates that is.
  struct Place {
    const SimTK::MobilizedBody& body;
    int coordinate;
  };
  Place place(int joint, int leg) const;
  /// Rate of one of a leg's three coordinates.
  double rate(const SimTK::State& state, int joint, int leg) const;
};

/// −c tanh(q̇ / speed), the force that smoothed Coulomb friction puts on one of a leg's three joints.
double coulombForce(const Leg& leg, int joint, double rate);

/// Columns −u, x̂, ẑ, where φ = 0 puts the plane of the leg upright; for an axis along e_z, where upright says nothing,
/// by convention x̂ = u × e_y.
Matrix3d baseFrame(const Vector3d& axis);

/// The joints' coordinates of a leg for B, `d` from A, by vector geometry; empty where it cannot reach. `base` is
/// baseFrame of its axis.
std::optional<std::array<double, 3>> legGeometry(const Leg& leg, const Matrix3d& base, const Vector3d& d);

/// [moment about P; force] of the load in B for the platform's pose in `state`, realized to Position.
SimTK::SpatialVec loadOnPlatform(const Load& load, const Mechanism& mechanism, const SimTK::State& state);

/// Kept from call to call, so that none of them allocates.
struct OpenTreeScratch {
  SimTK::Vector mobility_forces, residual;
  SimTK::Vector_<SimTK::SpatialVec> body_forces;
  SimTK::Matrix G_transposed;
};

struct SimbodyLoop::Impl {
  Impl(const Manipulator& manipulator, Topology topology, std::shared_ptr<const Load> load);

  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter;
  SimTK::GeneralForceSubsystem forces;
  Mechanism mechanism;
  std::shared_ptr<AppliedForces> applied = std::make_shared<AppliedForces>();
  SimTK::State state;
  SimTK::State open;    ///< without the balls: what derivative() asks for needs none of their errors; six balls only
  SimTK::Vector u_dot;  ///< accelerations last placed or found
  std::vector<Matrix3d> leg_jacobians;  ///< velocities of Bᵢ by the leg's rates, as last eliminated
  OpenTreeScratch scratch;
  Manipulator parameters;
  Topology topology;

  int legCount() const { return parameters.legCount(); }
  /// The one that derivative() realizes.
  const SimTK::State& differentiated() const { return topology == Topology::six_balls ? open : state; }
  /// Index in u of a leg's joint.
  int indexOf(int joint, int leg) const;
  int indexOf(const Mechanism::Rotor& rotor) const { return rotor.wheel.getFirstUIndex(state); }
  void setLeg(int leg, const std::array<double, 3>& q);
  /// Geometry of one leg for the platform's pose. Throws std::domain_error where it cannot reach.
  std::array<double, 3> legGeometry(int leg, const Motion<double>& motion) const;
  void setPlatformPose(const Motion<double>& motion);
  void realize(SimTK::Stage stage) const { system.realize(state, stage); }
  /// [G; J]: constraint Jacobian over the platform's frame Jacobian, nu × nu.
  Eigen::MatrixXd constraintsAndPlatform() const;
  Eigen::MatrixXd constraintJacobian() const;
  /// Forces that act besides the motors', into the scratch; from the state's velocities.
  void applyForces();
  /// Of the state last placed.
  std::optional<Eigen::MatrixXd> placed_jacobian;
  /// Sets u_dot under `torques` in the coordinates of `state`, the legs' eliminated, and realizes `open`; six balls
  /// only.
  void eliminate(const Vector6d& torques);
  /// Velocities and accelerations of all coordinates that go with the platform's.
  void setRates(const Motion<double>& motion);
  /// Those of a platform that hangs on no leg alone.
  void setFreePlatform(const Motion<double>& motion);

 private:
  void addLeg(int leg);
  void addUniversalLeg(const Leg& from);  ///< URS and UPS
  void addCrank(const Leg& from);         ///< RUS
  void addCarriage(const Leg& from);      ///< PUS
  void addPlatform();
  void addRotors();
  void addForces(std::shared_ptr<const Load> load);
};

}  // namespace ursula

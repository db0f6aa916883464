#pragma once

// Internals of SimbodyLoop; only simbody_loop*.cpp include it.

#include <array>
#include <optional>
#include <vector>

#include <Eigen/LU>

#include "model/legs/leg_chain.h"
#include "simbody/simbody_loop.h"
#include "simbody/simtk_internal.h"

namespace ursula {

/// Forces that Simbody does not compute itself: torques, Coulomb friction, the load on the platform.
struct AppliedForces {
  Vector6d torques = Vector6d::Zero();  ///< torques of the motors
  SimbodyLoop::TorqueHistory history;   ///< replaces `torques` if set
  std::shared_ptr<const Load> load;
  std::vector<Leg> legs;  ///< with their Coulomb friction
  Motors motors;
  bool any_coulomb = false;
};

/// Handles on the bodies and on the balls that close the loops.
struct LoopParts {
  std::vector<SimTK::MobilizedBody> proximal, distal;
  std::vector<int> joints_of_proximal;
  SimTK::MobilizedBody platform;
  std::vector<SimTK::Constraint::Ball> balls;

  /// A rotor: a wheel on Ground. A coupler turns it by the leg's coordinate, with radians for metres if that slides.
  /// Rotors come last in Simbody's order.
  struct Rotor {
    SimTK::MobilizedBody wheel;
    int joint, leg;
  };
  std::vector<Rotor> rotors;

  /// The body that a leg's joint moves, and the index of the coordinate in its mobilizer.
  struct Place {
    const SimTK::MobilizedBody& body;
    int coordinate;
  };
  Place place(int joint, int leg) const;
  /// Returns the rate of one of a leg's three coordinates.
  double rate(const SimTK::State& state, int joint, int leg) const;
};

/// Returns −c tanh(q̇ / speed), the smoothed Coulomb friction force on one of a leg's three joints.
double coulombForce(const Leg& leg, int joint, double rate);

/// Returns the joint coordinates of a leg for B at `d` from A, by vector geometry; nullopt if it cannot reach. `frame`
/// is fixedFrame of its axis.
std::optional<std::array<double, 3>> legGeometry(const Leg& leg, const Matrix3d& frame, const Vector3d& d);

/// Returns the velocity of B per unit rates of the leg's joints; axes are Simbody's. `first` and `second` are the leg's
/// bodies, `from_A` and `to_B` lead to B from A and from the second body's origin, in B.
Matrix3d legJacobian(const LegChain& chain, const SimTK::State& state, const SimTK::MobilizedBody& first,
                     const SimTK::MobilizedBody& second, const Vector3d& from_A, const Vector3d& to_B);

/// Returns the properties about the body's origin. Simbody undoes the shift again; std::domain_error is thrown if
/// rounding invalidates the result.
SimTK::MassProperties massProperties(double mass, const Vector3d& center, const Matrix3d& about_center);

/// Returns [moment about P; force] of the load in B for the platform's pose in `state`, realized to Position.
SimTK::SpatialVec loadOnPlatform(const Load& load, const LoopParts& mechanism, const SimTK::State& state);

/// Kept between calls to avoid allocation.
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
  LoopParts mechanism;
  std::shared_ptr<AppliedForces> applied = std::make_shared<AppliedForces>();
  SimTK::State state;
  SimTK::State open;    ///< state without the balls, as derivative() needs none of their errors; six balls only
  SimTK::Vector u_dot;  ///< accelerations last placed or computed
  std::vector<Matrix3d> leg_jacobians;  ///< velocities of Bᵢ by the leg's rates, at the last elimination
  OpenTreeScratch scratch;
  Manipulator parameters;
  std::vector<LegChain> chains;  ///< the legs' joints
  Topology topology;

  int legCount() const { return parameters.legCount(); }
  /// Returns the state that derivative() realizes.
  const SimTK::State& differentiated() const { return topology == Topology::ball_per_leg ? open : state; }
  /// Returns the index in u of a leg's joint.
  int indexOf(int joint, int leg) const;
  int indexOf(const LoopParts::Rotor& rotor) const { return rotor.wheel.getFirstUIndex(state); }
  void setLeg(int leg, const std::array<double, 3>& q);
  /// Returns the joint coordinates of one leg for the platform's pose. Throws std::domain_error if the leg cannot
  /// reach.
  std::array<double, 3> legGeometry(int leg, const Motion<double>& motion) const;
  void setPlatformPose(const Motion<double>& motion);
  void realize(SimTK::Stage stage) const { system.realize(state, stage); }
  /// Returns [G; J]: the constraint Jacobian over the platform's frame Jacobian, nu × nu.
  Eigen::MatrixXd constraintsAndPlatform() const;
  Eigen::MatrixXd constraintJacobian() const;
  /// The same, faster; for six balls and no rotor.
  Eigen::MatrixXd jacobianOfBalls() const;
  /// Replaces the forces in the scratch by those other than the motors', from the state's velocities.
  void applyForces();
  /// The Jacobian of the last placed state.
  std::optional<Eigen::MatrixXd> placed_jacobian;
  /// Sets u_dot under `torques` in the coordinates of `state`, with the legs' eliminated, and realizes `open`. Six
  /// balls only.
  void eliminate(const Vector6d& torques);
  /// Sets the velocities and accelerations of all coordinates from the platform's.
  void setRates(const Motion<double>& motion);
  /// Sets only the platform's own, if the platform is free instead of on leg 1.
  void setFreePlatform(const Motion<double>& motion);

 private:
  void addLeg(int leg);
  SimTK::MobilizedBody addLink(const LegChain& chain, int link, SimTK::MobilizedBody& parent);
  void addPlatform();
  void addRotors();
  void addForces(std::shared_ptr<const Load> load);
};

}  // namespace ursula

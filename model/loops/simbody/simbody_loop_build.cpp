// How the closed loop is built. Frames of the joints: φ turns about −u, then ψ about x (Universal turns about its x,
// then y), θ about x (Pin turns about z). The links' body frames are G = [x, e × x, e] and H = [x, s × x, s] of the
// paper's (40), with origins at A and R, so that the raw inertias go in as they are.

#include <Eigen/Geometry>

#include "model/loops/simbody/simbody_loop_internal.h"

namespace ursula {
namespace {

SimTK::Inertia inertiaAboutOrigin(const Matrix3d& about_center, double mass, const Vector3d& center) {
  const SimTK::Inertia central(about_center(0, 0), about_center(1, 1), about_center(2, 2), about_center(0, 1),
                               about_center(0, 2), about_center(1, 2));
  return central.shiftFromMassCenter(-toSimTK(center), mass);
}

SimTK::Body::Rigid linkBody(const Link& link) {
  const Vector3d center(0, 0, link.center_of_mass);
  return SimTK::Body::Rigid(
      SimTK::MassProperties(link.mass, toSimTK(center), inertiaAboutOrigin(link.inertia, link.mass, center)));
}

/// Columns −u, x̂, ẑ, where φ = 0 puts the plane of the leg upright; for an axis along e_z, where upright says nothing,
/// by convention x̂ = u × e_y.
Matrix3d baseFrame(const Vector3d& axis) {
  const Vector3d u = axis.normalized();
  const bool vertical = u.cross(Vector3d::UnitZ()).norm() < 1e-10;
  const Vector3d x = u.cross(vertical ? Vector3d(Vector3d::UnitY()) : Vector3d(Vector3d::UnitZ())).normalized();
  Matrix3d frame;
  frame << -u, x, x.cross(u);
  return frame;
}

/// Torques, Coulomb friction and load, as Simbody asks for them.
class DriverForce : public SimTK::Force::Custom::Implementation {
 public:
  DriverForce(Mechanism mechanism, std::shared_ptr<const AppliedForces> applied)
      : mechanism_(std::move(mechanism)), applied_(std::move(applied)) {}

  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector& mobility_forces) const override {
    const Vector6d torques = applied_->history ? applied_->history(state.getTime()) : applied_->torques;
    for (int i = 0; i < leg_count; ++i) {
      const auto leg = static_cast<std::size_t>(i);
      mechanism_.proximal[leg].applyOneMobilityForce(state, 0, torques(i), mobility_forces);
      if (applied_->any_coulomb) addCoulomb(state, i, mobility_forces);
    }
    if (applied_->load)
      body_forces[mechanism_.platform.getMobilizedBodyIndex()] += loadOnPlatform(*applied_->load, mechanism_, state);
  }

  SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0; }

 private:
  void addCoulomb(const SimTK::State& state, int i, SimTK::Vector& mobility_forces) const {
    const auto leg = static_cast<std::size_t>(i);
    const auto force = [&](int joint) {
      return coulombForce(applied_->coulomb[leg], joint, mechanism_.rate(state, joint, i));
    };
    mechanism_.proximal[leg].applyOneMobilityForce(state, 0, force(0), mobility_forces);
    mechanism_.proximal[leg].applyOneMobilityForce(state, 1, force(1), mobility_forces);
    mechanism_.distal[leg].applyOneMobilityForce(state, 0, force(2), mobility_forces);
  }

  Mechanism mechanism_;
  std::shared_ptr<const AppliedForces> applied_;
};

void addDamper(SimTK::GeneralForceSubsystem& forces, const SimTK::MobilizedBody& body, int coordinate, double damping) {
  if (damping > 0) SimTK::Force::MobilityLinearDamper(forces, body, SimTK::MobilizerUIndex(coordinate), damping);
}

}  // namespace

double Mechanism::rate(const SimTK::State& state, int joint, int leg) const {
  const auto i = static_cast<std::size_t>(leg);
  return joint < 2 ? proximal[i].getOneU(state, joint) : distal[i].getOneU(state, 0);
}

double coulombForce(const CoulombFriction& friction, int joint, double rate) {
  const std::array<double, 3> coefficients{friction.phi, friction.psi, friction.theta};
  return -coefficients[static_cast<std::size_t>(joint)] * std::tanh(rate / friction.smoothing_speed);
}

SimTK::SpatialVec loadOnPlatform(const Load& load, const Mechanism& mechanism, const SimTK::State& state) {
  const SimTK::Rotation& R = mechanism.platform.getBodyRotation(state);
  const auto wrench = load.at(state.getTime());
  const bool in_platform = load.frame == Load::Frame::platform;
  const SimTK::Vec3 force = in_platform ? R * toSimTK(wrench.force) : toSimTK(wrench.force);
  const SimTK::Vec3 moment = in_platform ? R * toSimTK(wrench.moment) : toSimTK(wrench.moment);
  return {moment + (R * toSimTK(load.point)) % force, force};
}

SimbodyLoop::Impl::Impl(const Manipulator& manipulator, Topology topology_, std::shared_ptr<const Load> load)
    : matter(system), forces(system), parameters(manipulator), topology(topology_) {
  const SimTK::Force::UniformGravity gravity(forces, matter, toSimTK(manipulator.gravity()));
  for (int i = 0; i < leg_count; ++i) addLeg(i);
  addPlatform(topology);
  addForces(std::move(load));
  state = system.realizeTopology();
  system.realizeModel(state);
  u_dot = SimTK::Vector(state.getNU(), 0.0);
}

void SimbodyLoop::Impl::addLeg(int leg) {
  const Leg& from = parameters.leg(leg);
  const auto i = static_cast<std::size_t>(leg);
  // ψ = 0 lays e along u: Universal's axes −u, x, z are then −e, x, −(e × x).
  Matrix3d in_proximal;
  in_proximal << 0, 1, 0, 0, 0, -1, -1, 0, 0;
  mechanism.proximal[i] = SimTK::MobilizedBody::Universal(
      matter.Ground(), SimTK::Transform(toSimTK(baseFrame(from.base_axis)), toSimTK(from.base_point)),
      linkBody(from.proximal), SimTK::Transform(toSimTK(in_proximal)));
  // Pin's z is x of the leg. θ = 0 folds the leg: s = −e.
  Matrix3d knee_in_proximal, knee_in_distal;
  knee_in_proximal << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  knee_in_distal << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  mechanism.distal[i] = SimTK::MobilizedBody::Pin(
      mechanism.proximal[i], SimTK::Transform(toSimTK(knee_in_proximal), SimTK::Vec3(0, 0, from.proximal.length)),
      linkBody(from.distal), SimTK::Transform(toSimTK(knee_in_distal)));
}

void SimbodyLoop::Impl::addPlatform(Topology topology) {
  const Platform& from = parameters.platform();
  const SimTK::Body::Rigid body(SimTK::MassProperties(
      from.mass, toSimTK(from.center_of_mass), inertiaAboutOrigin(from.inertia, from.mass, from.center_of_mass)));
  const bool on_leg_1 = topology == Topology::tree_through_leg_1;
  if (on_leg_1)
    mechanism.platform = SimTK::MobilizedBody::Ball(
        mechanism.distal[0], SimTK::Transform(SimTK::Vec3(0, 0, parameters.leg(0).distal.length)), body,
        SimTK::Transform(toSimTK(parameters.leg(0).platform_point)));
  else
    mechanism.platform = SimTK::MobilizedBody::Free(matter.Ground(), body);
  for (int leg = on_leg_1 ? 1 : 0; leg < leg_count; ++leg)
    mechanism.balls.emplace_back(mechanism.distal[static_cast<std::size_t>(leg)],
                                 SimTK::Vec3(0, 0, parameters.leg(leg).distal.length), mechanism.platform,
                                 toSimTK(parameters.leg(leg).platform_point));
}

void SimbodyLoop::Impl::addForces(std::shared_ptr<const Load> load) {
  applied->load = std::move(load);
  for (int leg = 0; leg < leg_count; ++leg) {
    const auto i = static_cast<std::size_t>(leg);
    const Leg& from = parameters.leg(leg);
    addDamper(forces, mechanism.proximal[i], 0, from.friction.phi);
    addDamper(forces, mechanism.proximal[i], 1, from.friction.psi);
    addDamper(forces, mechanism.distal[i], 0, from.friction.theta);
    applied->coulomb[i] = from.coulomb;
    applied->any_coulomb |= from.coulomb.phi > 0 || from.coulomb.psi > 0 || from.coulomb.theta > 0;
  }
  SimTK::Force::Custom(forces, new DriverForce(mechanism, applied));  // Simbody takes ownership
}

}  // namespace ursula

// Builds the closed loop: platform, balls, rotors and forces; simbody_loop_legs.cpp has the legs. Rotors are bodies as
// well, so Simbody's own dynamics, energy and integrators include them.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <stdexcept>

#include "simbody/simbody_loop_internal.h"

namespace ursula {
namespace {

/// Supplies torques, Coulomb friction and load to Simbody.
class DriverForce : public SimTK::Force::Custom::Implementation {
 public:
  DriverForce(LoopParts mechanism, std::shared_ptr<const AppliedForces> applied)
      : mechanism_(std::move(mechanism)), applied_(std::move(applied)) {}

  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector& mobility_forces) const override {
    const Vector6d torques = applied_->history ? applied_->history(state.getTime()) : applied_->torques;
    for (int m = 0; m < motor_count; ++m) {
      const Motor& motor = applied_->motors[m];
      apply(state, motor.joint, motor.leg, torques(m), mobility_forces);
    }
    if (applied_->any_coulomb) addCoulomb(state, mobility_forces);
    if (applied_->load)
      body_forces[mechanism_.platform.getMobilizedBodyIndex()] += loadOnPlatform(*applied_->load, mechanism_, state);
  }

  SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0; }

 private:
  void apply(const SimTK::State& state, int joint, int leg, double force, SimTK::Vector& mobility_forces) const {
    const LoopParts::Place place = mechanism_.place(joint, leg);
    place.body.applyOneMobilityForce(state, place.coordinate, force, mobility_forces);
  }

  void addCoulomb(const SimTK::State& state, SimTK::Vector& mobility_forces) const {
    for (std::size_t i = 0; i < applied_->legs.size(); ++i)
      for (int joint = 0; joint < 3; ++joint) {
        const int leg = static_cast<int>(i);
        const double rate = mechanism_.rate(state, joint, leg);
        apply(state, joint, leg, coulombForce(applied_->legs[i], joint, rate), mobility_forces);
      }
  }

  LoopParts mechanism_;
  std::shared_ptr<const AppliedForces> applied_;
};

void addDamper(SimTK::GeneralForceSubsystem& forces, const SimTK::MobilizedBody& body, int coordinate, double damping) {
  if (damping > 0) SimTK::Force::MobilityLinearDamper(forces, body, SimTK::MobilizerUIndex(coordinate), damping);
}

}  // namespace

SimTK::MassProperties massProperties(double mass, const Vector3d& center, const Matrix3d& about_center) try {
  const SimTK::Inertia central(about_center(0, 0), about_center(1, 1), about_center(2, 2), about_center(0, 1),
                               about_center(0, 2), about_center(1, 2));
  const SimTK::MassProperties out(mass, toSimTK(center), central.shiftFromMassCenter(-toSimTK(center), mass));
  static_cast<void>(out.calcCentralInertia());
  return out;
} catch (const SimTK::Exception::Base&) {
  throw std::domain_error(
      fmt::format("Simbody cannot hold a body of {:.6g} kg whose center of mass is {:.6g} m from its origin: its "
                  "moments of inertia of {:.6g} kg m^2 are lost beside {:.6g} kg m^2",
                  mass, center.norm(), about_center.diagonal().maxCoeff(), mass * center.squaredNorm()));
}

LoopParts::Place LoopParts::place(int joint, int leg) const {
  const int first = joints_of_proximal[leg];
  if (joint < first) return {proximal[leg], joint};
  return {distal[leg], joint - first};
}

double LoopParts::rate(const SimTK::State& state, int joint, int leg) const {
  const Place here = place(joint, leg);
  return here.body.getOneU(state, here.coordinate);
}

double coulombForce(const Leg& leg, int joint, double rate) {
  const Coordinate coordinate = rowOf(leg.kind).coordinates[joint];
  return -leg.coulomb.on(coordinate) * std::tanh(rate / leg.coulomb.speedOf(coordinate));
}

SimTK::SpatialVec loadOnPlatform(const Load& load, const LoopParts& mechanism, const SimTK::State& state) {
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
  for (int i = 0; i < legCount(); ++i) addLeg(i);
  addPlatform();
  addRotors();
  addForces(std::move(load));
  state = system.realizeTopology();
  system.realizeModel(state);
  u_dot = SimTK::Vector(state.getNU(), 0.0);
  if (topology != Topology::ball_per_leg) return;
  open = state;
  for (const SimTK::Constraint::Ball& ball : mechanism.balls) ball.disable(open);
  system.realizeModel(open);
}

void SimbodyLoop::Impl::addPlatform() {
  const Platform& from = parameters.platform();
  const SimTK::Body::Rigid body(massProperties(from.mass, from.center_of_mass, from.inertia));
  const bool on_leg_1 = topology == Topology::tree_through_leg_1;
  if (on_leg_1)
    mechanism.platform = SimTK::MobilizedBody::Ball(
        mechanism.distal[0], SimTK::Transform(SimTK::Vec3(0, 0, parameters.leg(0).distal.length)), body,
        SimTK::Transform(toSimTK(parameters.leg(0).platform_point)));
  else
    mechanism.platform = SimTK::MobilizedBody::Free(matter.Ground(), body);
  for (int leg = on_leg_1 ? 1 : 0; leg < legCount(); ++leg)
    mechanism.balls.emplace_back(mechanism.distal[leg], SimTK::Vec3(0, 0, parameters.leg(leg).distal.length),
                                 mechanism.platform, toSimTK(parameters.leg(leg).platform_point));
}

void SimbodyLoop::Impl::addRotors() {
  for (const Motor& motor : parameters.motors()) {
    const double inertia = parameters.leg(motor.leg).rotor_inertia.on(motor.coordinate);
    if (inertia == 0) continue;
    const SimTK::MassProperties properties(inertia, SimTK::Vec3(0), SimTK::Inertia(inertia));  // any mass is valid
    const SimTK::MobilizedBody::Pin wheel(matter.Ground(), SimTK::Body::Rigid(properties));
    const LoopParts::Place place = mechanism.place(motor.joint, motor.leg);
    SimTK::Vector alike(3, 0.0);
    alike[0] = 1;
    alike[1] = -1;
    const std::vector<SimTK::MobilizedBodyIndex> bodies = {place.body.getMobilizedBodyIndex(),
                                                           wheel.getMobilizedBodyIndex()};
    const std::vector<SimTK::MobilizerQIndex> coordinates = {SimTK::MobilizerQIndex(place.coordinate),
                                                             SimTK::MobilizerQIndex(0)};
    const SimTK::Constraint::CoordinateCoupler coupler(matter, new SimTK::Function::Linear(alike), bodies,
                                                       coordinates);  // takes ownership
    mechanism.rotors.push_back({wheel, motor.joint, motor.leg});
  }
}

void SimbodyLoop::Impl::addForces(std::shared_ptr<const Load> load) {
  applied->load = std::move(load);
  for (int leg = 0; leg < legCount(); ++leg) {
    const Leg& from = parameters.leg(leg);
    for (int joint = 0; joint < 3; ++joint) {
      const LoopParts::Place place = mechanism.place(joint, leg);
      const Coordinate coordinate = rowOf(from.kind).coordinates[joint];
      addDamper(forces, place.body, place.coordinate, from.friction.on(coordinate));
    }
    applied->legs.push_back(from);
    applied->any_coulomb |= from.coulomb.any();
  }
  applied->motors = parameters.motors();
  SimTK::Force::Custom(forces, new DriverForce(mechanism, applied));  // Simbody takes ownership
}

}  // namespace ursula

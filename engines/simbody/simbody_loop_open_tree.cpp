// Uses the fewest calls of Simbody that suffice. Forces are summed here, because its own force subsystem would realize
// all stages up to Dynamics.

#include <Eigen/Geometry>
#include <algorithm>

#include "engines/simbody/simbody_loop_internal.h"

namespace ursula {

void SimbodyLoop::coordinates(const Motion<double>& motion, const JointMotion& joint_motion,
                              TreeCoordinates& out) const {
  const Impl& loop = *impl_;
  out.motion = motion;
  out.q.resize(static_cast<std::size_t>(loop.state.getNQ()));
  out.u.resize(static_cast<std::size_t>(loop.state.getNU()));
  out.u_dot.resize(out.u.size());
  for (int leg = 0; leg < loop.legCount(); ++leg)
    for (int joint = 0; joint < 3; ++joint) {
      const Coordinate coordinate = rowOf(loop.parameters.leg(leg).kind).coordinates[static_cast<std::size_t>(joint)];
      const auto at = static_cast<std::size_t>(loop.indexOf(joint, leg));  // q has the order of u before the platform's
      out.q[at] = joint_motion.q.of(coordinate)(leg);
      out.u[at] = joint_motion.q_dot.of(coordinate)(leg);
      out.u_dot[at] = joint_motion.q_ddot.of(coordinate)(leg);
    }
  for (const Mechanism::Rotor& rotor : loop.mechanism.rotors) {
    const auto at = static_cast<std::size_t>(loop.indexOf(rotor)),
               of = static_cast<std::size_t>(loop.indexOf(rotor.joint, rotor.leg));
    out.q[static_cast<std::size_t>(rotor.wheel.getFirstQIndex(loop.state))] = out.q[of];
    out.u[at] = out.u[of];
    out.u_dot[at] = out.u_dot[of];
  }
  const int first_q = loop.mechanism.platform.getFirstQIndex(loop.state);
  const int first_u = loop.mechanism.platform.getFirstUIndex(loop.state);
  const Eigen::Quaterniond Q(motion.Q);
  Eigen::Map<Eigen::Matrix<double, 7, 1>>(out.q.data() + first_q) << Q.w(), Q.vec(), motion.p;
  Eigen::Map<Vector6d>(out.u.data() + first_u) << motion.omega, motion.p_dot;
  Eigen::Map<Vector6d>(out.u_dot.data() + first_u) << motion.omega_dot, motion.p_ddot;
}

void SimbodyLoop::Impl::applyForces() {
  SimTK::Vector_<SimTK::SpatialVec>& on_bodies = scratch.body_forces;
  SimTK::Vector& on_joints = scratch.mobility_forces;
  on_bodies.resize(matter.getNumBodies());
  on_joints.resize(state.getNU());
  on_bodies.setToZero();
  on_joints.setToZero();
  const SimTK::Vec3 g = toSimTK(parameters.gravity());
  for (SimTK::MobilizedBodyIndex body(1); body < matter.getNumBodies(); ++body) {
    const SimTK::MobilizedBody& here = matter.getMobilizedBody(body);
    const SimTK::Vec3 weight = here.getBodyMass(state) * g;
    on_bodies[body] = {(here.getBodyRotation(state) * here.getBodyMassCenterStation(state)) % weight, weight};
  }
  for (int i = 0; i < legCount(); ++i) {
    const Leg& leg = parameters.leg(i);
    if (!leg.friction.any() && !leg.coulomb.any()) continue;
    for (int joint = 0; joint < 3; ++joint) {
      const double viscous = leg.friction.on(rowOf(leg.kind).coordinates[static_cast<std::size_t>(joint)]);
      const double rate = mechanism.rate(state, joint, i);
      on_joints[indexOf(joint, i)] = coulombForce(leg, joint, rate) - viscous * rate;
    }
  }
  if (applied->load)
    on_bodies[mechanism.platform.getMobilizedBodyIndex()] += loadOnPlatform(*applied->load, mechanism, state);
}

void SimbodyLoop::openTree(const TreeCoordinates& at, OpenTree& out) {
  Impl& loop = *impl_;
  OpenTreeScratch& scratch = loop.scratch;
  loop.placed_jacobian.reset();
  loop.state.setTime(at.motion.t);
  std::copy(at.q.begin(), at.q.end(), &loop.state.updQ()[0]);
  std::copy(at.u.begin(), at.u.end(), &loop.state.updU()[0]);
  std::copy(at.u_dot.begin(), at.u_dot.end(), &loop.u_dot[0]);
  loop.realize(SimTK::Stage::Velocity);
  loop.applyForces();
  loop.matter.calcResidualForceIgnoringConstraints(loop.state, scratch.mobility_forces, scratch.body_forces, loop.u_dot,
                                                   scratch.residual);
  // This takes one sweep per constraint; calcG takes one per coordinate.
  loop.matter.calcGTranspose(loop.state, scratch.G_transposed);

  const auto force = mapped(scratch.residual);
  const auto G = Eigen::Map<const Eigen::MatrixXd>(scratch.G_transposed.getContiguousScalarData(),
                                                   scratch.G_transposed.nrow(), scratch.G_transposed.ncol())
                     .transpose();
  const int platform = loop.mechanism.platform.getFirstUIndex(loop.state);
  for (int i = 0; i < loop.legCount(); ++i) {
    OpenTree::Leg& leg = out.legs[static_cast<std::size_t>(i)];
    const int first = loop.indexOf(0, i);
    leg.J = G.block<3, 3>(3 * i, first);
    leg.P = -G.block<3, 6>(3 * i, platform);
    leg.force = force.segment<3>(first);
  }
  for (const Mechanism::Rotor& rotor : loop.mechanism.rotors)
    out.legs[static_cast<std::size_t>(rotor.leg)].force(rotor.joint) += force(loop.indexOf(rotor));
  out.force = force.segment<6>(platform);
}

Vector6d SimbodyLoop::twistRate(const TreeCoordinates& at, const Vector6d& efforts) {
  Impl& loop = *impl_;
  loop.placed_jacobian.reset();
  loop.state.setTime(at.motion.t);
  std::copy(at.q.begin(), at.q.end(), &loop.state.updQ()[0]);
  std::copy(at.u.begin(), at.u.end(), &loop.state.updU()[0]);
  accelerate(efforts);
  return mapped(loop.u_dot).segment<6>(loop.mechanism.platform.getFirstUIndex(loop.state));
}

}  // namespace ursula

#include <algorithm>
#include <new>

#include "base/deadline.h"
#include "simbody/simbody_loop_internal.h"

namespace ursula {

namespace {

BodyMotion<double> bodyMotion(const SimTK::State& state, const SimTK::MobilizedBody& body,
                              const SimTK::SpatialVec& acceleration) {
  const SimTK::Vec3& center = body.getBodyMassCenterStation(state);
  const SimTK::Rotation& R = body.getBodyRotation(state);
  const SimTK::SpatialVec& velocity = body.getBodyVelocity(state);
  const SimTK::Vec3 arm = R * center;
  const SimTK::Vec3& omega = velocity[0];
  BodyMotion<double> out;
  out.R = toEigen(R);
  out.c = toEigen(SimTK::Vec3(body.getBodyOriginLocation(state) + arm));
  // Simbody refers to the body origin, the paper to the mass centre.
  out.twist << toEigen(omega), toEigen(SimTK::Vec3(velocity[1] + omega % arm));
  out.twist_rate << toEigen(acceleration[0]),
      toEigen(SimTK::Vec3(acceleration[1] + acceleration[0] % arm + omega % (omega % arm)));
  return out;
}

/// Wraps the torques to note a lack of memory or time, because Simbody takes every exception for too long a step.
SimbodyLoop::TorqueHistory noting(std::exception_ptr& lack, const SimbodyLoop::TorqueHistory& torques) {
  return [&lack, &torques](double t) {
    try {
      return torques(t);
    } catch (const std::exception& error) {
      if (isShortage(error)) lack = std::current_exception();
      throw;
    }
  };
}

}  // namespace

SimbodyLoop::Closure SimbodyLoop::closure() const {
  impl_->realize(SimTK::Stage::Velocity);
  Closure out;
  for (const SimTK::Constraint::Ball& ball : impl_->mechanism.balls) {
    out.position = larger(out.position, ball.getPositionErrors(impl_->state).norm());
    out.velocity = larger(out.velocity, ball.getVelocityErrors(impl_->state).norm());
  }
  return out;
}

SimbodyLoop::Energy SimbodyLoop::energy() const {
  impl_->realize(SimTK::Stage::Dynamics);
  return {impl_->system.calcKineticEnergy(impl_->state), impl_->system.calcPotentialEnergy(impl_->state)};
}

Motion<double> SimbodyLoop::platform() const {
  const Impl& loop = *impl_;
  loop.realize(SimTK::Stage::Velocity);
  const SimTK::MobilizedBody& body = loop.mechanism.platform;
  SimTK::Vector_<SimTK::SpatialVec> accelerations;
  loop.matter.calcBodyAccelerationFromUDot(loop.state, loop.u_dot, accelerations);
  const SimTK::SpatialVec& acceleration = accelerations[body.getMobilizedBodyIndex()];
  Motion<double> out;
  out.t = loop.state.getTime();
  out.p = toEigen(body.getBodyOriginLocation(loop.state));
  out.Q = toEigen(body.getBodyRotation(loop.state));
  out.omega = toEigen(body.getBodyAngularVelocity(loop.state));
  out.p_dot = toEigen(body.getBodyOriginVelocity(loop.state));
  out.omega_dot = toEigen(acceleration[0]);
  out.p_ddot = toEigen(acceleration[1]);
  return out;
}

BodyMotions<double> SimbodyLoop::bodies() const {
  const Impl& loop = *impl_;
  loop.realize(SimTK::Stage::Velocity);
  SimTK::Vector_<SimTK::SpatialVec> accelerations;
  loop.matter.calcBodyAccelerationFromUDot(loop.state, loop.u_dot, accelerations);
  BodyMotions<double> out;
  const auto motionOf = [&](const SimTK::MobilizedBody& body) {
    return bodyMotion(loop.state, body, accelerations[body.getMobilizedBodyIndex()]);
  };
  for (std::size_t i = 0; i < loop.mechanism.proximal.size(); ++i) {
    out[i] = motionOf(loop.mechanism.proximal[i]);
    out[leg_count + i] = motionOf(loop.mechanism.distal[i]);
  }
  out.back() = motionOf(loop.mechanism.platform);
  return out;
}

/// With G N = 0 and identity as the actuated rows of N, Nᵀ removes the multipliers from the residual forces: τ = Nᵀ f.
Vector6d SimbodyLoop::inverseDynamics() const {
  const Impl& loop = *impl_;
  loop.applied->torques.setZero();
  loop.state.invalidateAllCacheAtOrAbove(SimTK::Stage::Dynamics);
  loop.realize(SimTK::Stage::Dynamics);
  SimTK::Vector residual;
  loop.matter.calcResidualForceIgnoringConstraints(
      loop.state, loop.system.getMobilityForces(loop.state, SimTK::Stage::Dynamics),
      loop.system.getRigidBodyForces(loop.state, SimTK::Stage::Dynamics), loop.u_dot, residual);

  const Eigen::MatrixXd G = loop.placed_jacobian ? *loop.placed_jacobian : loop.constraintJacobian();
  Eigen::MatrixXd constraints_and_actuators = Eigen::MatrixXd::Zero(G.cols(), G.cols());
  constraints_and_actuators.topRows(G.rows()) = G;
  const Motors& motors = loop.parameters.motors();
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = motors[m];
    constraints_and_actuators(G.rows() + m, loop.indexOf(motor.joint, motor.leg)) = 1;
  }
  const Eigen::VectorXd forces = constraints_and_actuators.transpose().partialPivLu().solve(mapped(residual));
  return forces.tail<6>();
}

void SimbodyLoop::accelerate(const Vector6d& torques) {
  Impl& loop = *impl_;
  if (loop.topology == Topology::ball_per_leg) {
    loop.eliminate(torques);
    return;
  }
  loop.applied->torques = torques;
  loop.state.invalidateAllCacheAtOrAbove(SimTK::Stage::Dynamics);
  loop.realize(SimTK::Stage::Acceleration);
  loop.u_dot = loop.state.getUDot();
}

Vector6d SimbodyLoop::ownTwistRateError(const Vector6d& torques) {
  accelerate(torques);
  Impl& loop = *impl_;
  loop.state.invalidateAllCacheAtOrAbove(SimTK::Stage::Dynamics);
  loop.realize(SimTK::Stage::Acceleration);
  const SimTK::Vector& own = loop.state.getUDot();
  const int first = loop.mechanism.platform.getFirstUIndex(loop.state);
  Vector6d out;
  for (int k = 0; k < 6; ++k) out(k) = own[first + k] - loop.u_dot[first + k];
  return out;
}

int SimbodyLoop::stateSize() const { return impl_->state.getNQ() + impl_->state.getNU(); }

std::vector<double> SimbodyLoop::state() const {
  std::vector<double> x;
  x.reserve(stateSize());
  const SimTK::Vector& q = impl_->state.getQ();
  const SimTK::Vector& u = impl_->state.getU();
  for (int i = 0; i < q.size(); ++i) x.push_back(q[i]);
  for (int i = 0; i < u.size(); ++i) x.push_back(u[i]);
  return x;
}

void SimbodyLoop::setState(double t, const double* x) {
  impl_->placed_jacobian.reset();
  SimTK::State& state = impl_->state;
  const int nq = state.getNQ(), nu = state.getNU();
  state.setTime(t);
  SimTK::Vector& q = state.updQ();
  for (int i = 0; i < nq; ++i) q[i] = x[i];
  SimTK::Vector& u = state.updU();
  for (int i = 0; i < nu; ++i) u[i] = x[nq + i];
}

void SimbodyLoop::derivative(double t, const double* x, const Vector6d& torques, double* x_dot) {
  setState(t, x);
  accelerate(torques);
  const SimTK::Vector& q_dot = impl_->differentiated().getQDot();
  for (int i = 0; i < q_dot.size(); ++i) x_dot[i] = q_dot[i];
  for (int i = 0; i < impl_->u_dot.size(); ++i) x_dot[q_dot.size() + i] = impl_->u_dot[i];
}

SimbodyLoop::Power SimbodyLoop::power() const {
  const Impl& loop = *impl_;
  Power power;
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = loop.parameters.motors()[m];
    power.actuators += loop.applied->torques(m) * loop.mechanism.rate(loop.state, motor.joint, motor.leg);
  }
  for (int i = 0; i < loop.legCount(); ++i) {
    const Leg& leg = loop.parameters.leg(i);
    for (int joint = 0; joint < 3; ++joint) {
      const double viscous = leg.friction.on(rowOf(leg.kind).coordinates[joint]);
      const double rate = loop.mechanism.rate(loop.state, joint, i);
      power.friction += (coulombForce(leg, joint, rate) - viscous * rate) * rate;
    }
  }
  if (loop.applied->load) {
    const SimTK::State& now = loop.differentiated();
    const SimTK::SpatialVec wrench = loadOnPlatform(*loop.applied->load, loop.mechanism, now);
    const SimTK::SpatialVec& velocity = loop.mechanism.platform.getBodyVelocity(now);
    power.load = ~wrench[0] * velocity[0] + ~wrench[1] * velocity[1];
  }
  return power;
}

SimbodyLoop::Counters SimbodyLoop::integrateRungeKuttaMerson(double accuracy, const TorqueHistory& torques,
                                                             const std::vector<double>& instants,
                                                             const std::function<void(double)>& observe,
                                                             double longest_step) {
  Impl& loop = *impl_;
  std::exception_ptr lack;
  loop.applied->history = noting(lack, torques);
  loop.placed_jacobian.reset();
  Counters counters;
  bool initialized = false;  // Simbody aborts where the steps of another one are asked for
  SimTK::RungeKuttaMersonIntegrator integrator(loop.system);
  integrator.setAccuracy(accuracy);
  integrator.setConstraintTolerance(accuracy);
  integrator.setReturnEveryInternalStep(false);
  integrator.setFinalTime(instants.back());
  if (longest_step > 0) integrator.setMaximumStepSize(longest_step);
  loop.state.invalidateAllCacheAtOrAbove(SimTK::Stage::Dynamics);
  const int before = loop.system.getNumRealizationsOfThisStage(SimTK::Stage::Acceleration);
  try {
    integrator.initialize(loop.state);
    initialized = true;
    const auto show = [&] {
      loop.state = integrator.getState();
      loop.realize(SimTK::Stage::Velocity);
      observe(integrator.getTime());
    };
    show();
    for (double instant : instants) {
      while (integrator.getTime() < instant) integrator.stepTo(instant);
      show();
    }
  } catch (const std::exception& error) {
    if (isShortage(error)) lack = std::current_exception();
    counters.gave_up = true;  // the caller still reports the earlier part
  }
  counters.derivative_evaluations = loop.system.getNumRealizationsOfThisStage(SimTK::Stage::Acceleration) - before;
  if (initialized) counters.steps = integrator.getNumStepsTaken();
  loop.applied->history = nullptr;
  if (lack) std::rethrow_exception(lack);  // it says nothing about the motion
  return counters;
}

}  // namespace ursula

// Computes the loop's accelerations without multipliers. Simbody's own realize(Acceleration) solves for 18 multipliers
// with G M⁻¹Gᵀ. That takes most of a replay's time and loses digits if the platform is light. It drops multipliers if a
// link is nearly massless, so accelerations violate the constraints. Here Simbody's tree gives mass matrix, forces and
// velocities. The balls' constraints, which involve one leg each, eliminate the legs' coordinates (García de Jalón and
// Bayo, Kinematic and Dynamic Simulation of Multibody Systems, 1994, sect. 5.3):
//   Jᵢ u̇ᵢ + aᵢ = Pᵢ u̇_P + a_Pᵢ,  Pᵢ = [−[Qbᵢ]×, 1]          (a) both sides are the acceleration of Bᵢ
//   u̇ = N u̇_P + c,  N = [Jᵢ⁻¹Pᵢ; 1],  c = [Jᵢ⁻¹(a_Pᵢ − aᵢ); 0]  (b)
//   NᵀMN u̇_P = −Nᵀ(M c + bias − applied)                       (c)
//   Jᵢᵀ fᵢ = (M u̇ + bias − applied)ᵢ                            (d) fᵢ is the platform's force on leg i
// Tests compare it with realize(Acceleration).

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>

#include "simbody/simbody_loop_internal.h"

namespace ursula {
namespace {

using Matrix36 = Eigen::Matrix<double, 3, 6>;

/// One leg's part of (a).
struct LegClosure {
  Matrix3d J;
  Matrix36 P;
  Vector3d bias;  ///< a_P − a
};

Vector3d centripetal(const Vector3d& omega, const Vector3d& arm) { return omega.cross(omega.cross(arm)); }

LegClosure closureOf(const LoopParts& mechanism, const SimTK::State& state, std::size_t i, const Leg& leg,
                     const LegChain& chain, const SimTK::Vector_<SimTK::SpatialVec>& at_rest) {
  const SimTK::MobilizedBody &first = mechanism.proximal[i], &second = mechanism.distal[i];
  const Vector3d A = toEigen(first.getInboardFrame(state).p()), R = toEigen(second.getBodyOriginLocation(state));
  const Vector3d to_B = leg.distal.length * toEigen(SimTK::Vec3(second.getBodyRotation(state).z()));
  const Vector3d from_A = R + to_B - A;
  const Vector3d arm = toEigen(mechanism.platform.getBodyRotation(state)) * leg.platform_point;
  LegClosure out;
  out.J = legJacobian(chain, state, first, second, from_A, to_B);
  out.P.leftCols<3>() << 0, arm.z(), -arm.y(), -arm.z(), 0, arm.x(), arm.y(), -arm.x(), 0;
  out.P.rightCols<3>().setIdentity();
  const SimTK::SpatialVec& second_at_rest = at_rest[second.getMobilizedBodyIndex()];
  const SimTK::SpatialVec& platform_at_rest = at_rest[mechanism.platform.getMobilizedBodyIndex()];
  const auto pointOf = [](const SimTK::SpatialVec& body, const Vector3d& omega, const Vector3d& to_point) {
    return Vector3d(toEigen(body[1]) + toEigen(body[0]).cross(to_point) + centripetal(omega, to_point));
  };
  out.bias = pointOf(platform_at_rest, toEigen(mechanism.platform.getBodyAngularVelocity(state)), arm) -
             pointOf(second_at_rest, toEigen(second.getBodyAngularVelocity(state)), to_B);
  return out;
}

}  // namespace

void SimbodyLoop::Impl::eliminate(const Vector6d& torques) {
  applied->torques = torques;
  open.setTime(state.getTime());
  open.updQ() = state.getQ();
  open.updU() = state.getU();
  system.realize(open, SimTK::Stage::Dynamics);
  const int nu = open.getNU(), of_platform = mechanism.platform.getFirstUIndex(state);
  SimTK::Vector_<SimTK::SpatialVec> at_rest;
  matter.calcBodyAccelerationFromUDot(open, SimTK::Vector(nu, 0.0), at_rest);

  leg_jacobians.resize(legCount());
  Eigen::Matrix<double, Eigen::Dynamic, 6> N = Eigen::Matrix<double, Eigen::Dynamic, 6>::Zero(nu, 6);
  SimTK::Vector c(nu, 0.0);
  for (int k = 0; k < 6; ++k) N(of_platform + k, k) = 1;
  for (int i = 0; i < legCount(); ++i) {
    const LegClosure leg = closureOf(mechanism, open, i, parameters.leg(i), chains[i], at_rest);
    leg_jacobians[i] = leg.J;
    const Eigen::PartialPivLU<Matrix3d> factors(leg.J);
    const Matrix36 rates = factors.solve(leg.P);        // (b)
    const Vector3d constant = factors.solve(leg.bias);  // (b)
    for (int joint = 0; joint < 3; ++joint) {
      N.row(indexOf(joint, i)) = rates.row(joint);
      c[indexOf(joint, i)] = constant(joint);
    }
  }
  for (const LoopParts::Rotor& rotor : mechanism.rotors) {
    N.row(indexOf(rotor)) = N.row(indexOf(rotor.joint, rotor.leg));
    c[indexOf(rotor)] = c[indexOf(rotor.joint, rotor.leg)];
  }
  SimTK::Vector residual, column(nu), M_column;
  matter.calcResidualForceIgnoringConstraints(open, system.getMobilityForces(open, SimTK::Stage::Dynamics),
                                              system.getRigidBodyForces(open, SimTK::Stage::Dynamics), c, residual);
  Eigen::Matrix<double, Eigen::Dynamic, 6> MN(nu, 6);
  for (int k = 0; k < 6; ++k) {
    for (int row = 0; row < nu; ++row) column[row] = N(row, k);
    matter.multiplyByM(open, column, M_column);
    MN.col(k) = mapped(M_column);
  }
  const Matrix6d mass = N.transpose() * MN;
  const Vector6d platform = mass.llt().solve(-N.transpose() * mapped(residual));  // (c)
  const Eigen::VectorXd found = N * platform + mapped(c);
  for (int row = 0; row < nu; ++row) u_dot[row] = found(row);
}

double SimbodyLoop::gapAcceleration() const {
  const Impl& loop = *impl_;
  SimTK::Vector_<SimTK::SpatialVec> bodies;
  loop.matter.calcBodyAccelerationFromUDot(loop.open, loop.u_dot, bodies);
  const auto accelerationOf = [&](const SimTK::MobilizedBody& body, const SimTK::Vec3& station) {
    const SimTK::Vec3 arm = body.getBodyRotation(loop.open) * station;
    const SimTK::SpatialVec& of_body = bodies[body.getMobilizedBodyIndex()];
    const SimTK::Vec3& omega = body.getBodyAngularVelocity(loop.open);
    return SimTK::Vec3(of_body[1] + of_body[0] % arm + omega % (omega % arm));
  };
  double largest = 0;
  for (int i = 0; i < loop.legCount(); ++i) {
    const Leg& leg = loop.parameters.leg(i);
    const SimTK::MobilizedBody& distal = loop.mechanism.distal[i];
    const SimTK::Vec3 on_leg = accelerationOf(distal, SimTK::Vec3(0, 0, leg.distal.length));
    const SimTK::Vec3 on_platform = accelerationOf(loop.mechanism.platform, toSimTK(leg.platform_point));
    largest = std::max(largest, (on_leg - on_platform).norm());
  }
  return largest;
}

/// Computes the loop's closing force by (d), then the other reactions by Newton–Euler, body by body. It uses Simbody's
/// inertias, accelerations and applied forces.
Reactions SimbodyLoop::reactions() const {
  const Impl& loop = *impl_;
  const SimTK::State& open = loop.open;
  const SimTK::Vector_<SimTK::SpatialVec>& applied = loop.system.getRigidBodyForces(open, SimTK::Stage::Dynamics);
  SimTK::Vector residual;
  SimTK::Vector_<SimTK::SpatialVec> accelerations;
  loop.matter.calcResidualForceIgnoringConstraints(open, loop.system.getMobilityForces(open, SimTK::Stage::Dynamics),
                                                   applied, loop.u_dot, residual);
  loop.matter.calcBodyAccelerationFromUDot(open, loop.u_dot, accelerations);
  // The wrench that the joints alone exert on a body, about its origin.
  const auto wrenchOn = [&](const SimTK::MobilizedBody& body) {
    const SimTK::MobilizedBodyIndex index = body.getMobilizedBodyIndex();
    return Vector6d(toEigen(SimTK::SpatialVec(body.getBodySpatialInertiaInGround(open) * accelerations[index] +
                                              loop.matter.getGyroscopicForce(open, index) - applied[index])));
  };
  Reactions out;
  for (int i = 0; i < loop.legCount(); ++i) {
    const SimTK::MobilizedBody &first = loop.mechanism.proximal[i], &second = loop.mechanism.distal[i];
    Vector3d of_joints;
    for (int joint = 0; joint < 3; ++joint) of_joints(joint) = residual[loop.indexOf(joint, i)];
    for (const LoopParts::Rotor& rotor : loop.mechanism.rotors)
      if (rotor.leg == i) of_joints(rotor.joint) += residual[loop.indexOf(rotor)];
    const Vector3d on_leg = loop.leg_jacobians[i].transpose().partialPivLu().solve(of_joints);
    const Vector3d to_B = loop.parameters.leg(i).distal.length * toEigen(SimTK::Vec3(second.getBodyRotation(open).z()));
    const Vector3d to_R = toEigen(SimTK::Vec3(second.getBodyOriginLocation(open) - first.getBodyOriginLocation(open)));
    const Vector6d on_second = wrenchOn(second), on_first = wrenchOn(first);
    LegReactions& to = out[i];
    to.f_B = -on_leg;
    to.f_R = on_second.tail<3>() - on_leg;
    to.n_R = on_second.head<3>() - to_B.cross(on_leg);
    to.f_A = on_first.tail<3>() + to.f_R;
    to.n_A = on_first.head<3>() + to.n_R + to_R.cross(to.f_R);
  }
  return out;
}

}  // namespace ursula

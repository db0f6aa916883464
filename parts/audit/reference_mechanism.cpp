#include "parts/audit/reference_mechanism.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <stdexcept>

namespace ursula::audit {
namespace {

/// Returns the frame of (2) for a tilted axis: x̂ = (u × e_z)/‖·‖, ŷ = u, ẑ = x̂ × u. An axis along e_z takes e_y
/// instead.
M fixedFrame(const V& u) {
  const V e_z = V::UnitZ();
  const bool along_e_z = u.cross(e_z).squaredNorm() < S(1e-20);
  const V seed = along_e_z ? V(V::UnitY()) : e_z;
  M frame;
  frame.col(0) = u.cross(seed) / sqrt(u.cross(seed).squaredNorm());
  frame.col(1) = u;
  frame.col(2) = frame.col(0).cross(u);
  return frame;
}

V unitAxis(const Leg& leg) {
  const V axis = leg.base_axis.cast<S>();
  return axis / sqrt(axis.squaredNorm());
}

/// Returns [x, axis × x, axis] of (40).
M linkFrame(const V& x, const V& axis) {
  M frame;
  frame << x, axis.cross(x), axis;
  return frame;
}

/// spin() returns the angular velocity of a frame, spinRate() its angular acceleration.
V spin(const M& R, const M& R_dot) { return vect(R_dot * R.transpose()); }
V spinRate(const M& R, const M& R_dot, const M& R_ddot) {
  return vect(R_ddot * R.transpose() + R_dot * R_dot.transpose());
}

M rotationAbout(int axis, const S& angle) {
  const M K = crossMatrix(V(V::Unit(axis)));
  return M::Identity() + sin(angle) * K + (1 - cos(angle)) * K * K;
}

/// Makes angles differ from `center` by less than half a turn.
void unwrap(LegPose& pose, const LegPose& center) {
  const S turn = 2 * acos(S(-1));
  for (int k = 0; k < 3; ++k) pose.v(k) -= turn * round((pose.v(k) - center.v(k)) / turn);
}

ReferenceBody linkBody(const S& mass, const M& I, const M& R, const M& R_dot, const M& R_ddot, const V& c_dot,
                       const V& c_ddot) {
  ReferenceBody body;
  body.mass = mass;
  body.I = R * I * R.transpose();
  body.I_dot = R_dot * I * R.transpose() + R * I * R_dot.transpose();
  body.omega = spin(R, R_dot);
  body.omega_dot = spinRate(R, R_dot, R_ddot);
  body.c_dot = c_dot;
  body.c_ddot = c_ddot;
  return body;
}

/// Returns the friction forces on φ, ψ, θ of a leg.
V frictionForces(const Leg& leg, const LegPose& rate) {
  const double viscous[3] = {leg.friction.phi, leg.friction.psi, leg.friction.theta};
  const double coulomb[3] = {leg.coulomb.phi, leg.coulomb.psi, leg.coulomb.theta};
  V force;
  for (int k = 0; k < 3; ++k)
    force(k) = -viscous[k] * rate.v(k) - coulomb[k] * tanh(S(rate.v(k) / leg.coulomb.smoothing_speed));
  return force;
}

}  // namespace

M crossMatrix(const V& v) {
  M matrix;
  matrix << S(0), -v.z(), v.y(), v.z(), S(0), -v.x(), -v.y(), v.x(), S(0);
  return matrix;
}

V vect(const M& m) { return V(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)) / 2; }

M ReferenceLeg::Q_i() const {
  const S c = cos(at.phi()), s_phi = sin(at.phi());
  M Q;
  Q << c, S(0), -s_phi, S(0), S(1), S(0), s_phi, S(0), c;
  return Q;
}

Vector6<S> ReferenceBody::momentumRate() const {
  Vector6<S> rate;
  rate << I_dot * omega + I * omega_dot, mass * c_ddot;
  return rate;
}

Vector6<S> ReferenceState::phi_dot() const {
  Vector6<S> rates;
  for (int i = 0; i < leg_count; ++i) rates(i) = legs[static_cast<std::size_t>(i)].dot.phi();
  return rates;
}

Vector6<S> ReferenceState::phi_ddot() const {
  Vector6<S> accelerations;
  for (int i = 0; i < leg_count; ++i) accelerations(i) = legs[static_cast<std::size_t>(i)].ddot.phi();
  return accelerations;
}

ReferenceMechanism::ReferenceMechanism(const Manipulator& manipulator, const Trajectory& trajectory)
    : manipulator_(manipulator), trajectory_(trajectory) {}

/// B lies in the plane through A that contains u. R is where two circles about A and B in that plane meet, on the
/// knee's side.
LegPose ReferenceMechanism::legPose(int i, const V& p, const M& Q) const {
  const Leg& leg = manipulator_.leg(i);
  const V u = unitAxis(leg), Qb = Q * leg.platform_point.cast<S>();
  const S l(leg.proximal.length), s(leg.distal.length);
  const V AB = p + Qb - leg.base_point.cast<S>();
  const S q2 = AB.squaredNorm(), q = sqrt(q2);
  const V off_axis = AB - u * u.dot(AB);
  const V z = off_axis / sqrt(off_axis.squaredNorm()), x = u.cross(z);

  const S along = (q2 + l * l - s * s) / (2 * q), across2 = l * l - along * along;
  if (!(across2 >= 0)) throw std::domain_error("a leg cannot reach");
  const S knee(leg.knee == Knee::positive ? 1 : -1);
  const V AR = along / q * AB + knee * sqrt(across2) / q * x.cross(AB), RB = AB - AR;
  M F;
  F << x, u, z;
  const V AR_i = F.transpose() * AR, RB_i = F.transpose() * RB;
  const V x_0 = fixedFrame(u).col(0), z_0 = fixedFrame(u).col(2);

  LegPose pose;
  pose.v(0) = atan2(S(x.dot(z_0)), S(x.dot(x_0)));             // rotates the fixed frame to Fᵢ
  pose.v(1) = atan2(AR_i.z(), AR_i.y());                       // from ŷ to AR, about x
  pose.v(2) = atan2(S(-AR.cross(RB).dot(x)), S(-AR.dot(RB)));  // from RA to RB, about x
  pose.v(3) = q;
  pose.v(4) = -z.dot(AB);
  pose.v.segment<3>(5) = AB;
  pose.v.segment<3>(8) = F.transpose() * AB;
  pose.v.segment<3>(11) = leg.base_point.cast<S>() + S(leg.proximal.center_of_mass) / l * AR;
  pose.v.segment<3>(14) = leg.base_point.cast<S>() + AR + S(leg.distal.center_of_mass) / s * RB;
  pose.v.segment<3>(17) = AR_i / l;
  pose.v.segment<3>(20) = RB_i / s;
  Eigen::Map<M>(pose.v.data() + 23) = F;
  Eigen::Map<M>(pose.v.data() + 32) = linkFrame(x, AR / l);
  Eigen::Map<M>(pose.v.data() + 41) = linkFrame(x, RB / s);
  pose.v.segment<6>(50) << Qb.cross(x), x;
  return pose;
}

ReferencePlatform ReferenceMechanism::platformAt(const S& t) const {
  using Pose = Eigen::Matrix<S, 12, 1>;
  const auto d = differentiated(
      [&](const S& dt) {
        const Motion<S> motion = trajectory_.at(S(t + dt));
        Pose pose;
        pose << motion.p, Eigen::Map<const Eigen::Matrix<S, 9, 1>>(motion.Q.data());
        return pose;
      },
      S(trajectory_.duration() * 1e-5));
  const auto matrix = [](const Pose& pose) { return M(Eigen::Map<const M>(pose.data() + 3)); };
  ReferencePlatform out;
  out.p = d.value.head<3>();
  out.p_dot = d.first.head<3>();
  out.p_ddot = d.second.head<3>();
  out.Q = matrix(d.value);
  out.Q_dot = matrix(d.first);
  out.Q_ddot = matrix(d.second);
  out.omega = spin(out.Q, out.Q_dot);
  out.omega_dot = spinRate(out.Q, out.Q_dot, out.Q_ddot);
  out.rho = manipulator_.platform().center_of_mass.cast<S>();
  out.c = out.p + out.Q * out.rho;
  out.c_dot = out.p_dot + out.Q_dot * out.rho;
  out.c_ddot = out.p_ddot + out.Q_ddot * out.rho;
  return out;
}

ReferenceLeg ReferenceMechanism::legAt(int i, const S& t, const ReferencePlatform& platform) const {
  const Leg& leg = manipulator_.leg(i);
  const LegPose center = legPose(i, platform.p, platform.Q);
  const auto d = differentiated(
      [&](const S& dt) {
        const Motion<S> motion = trajectory_.at(S(t + dt));
        LegPose pose = legPose(i, motion.p, motion.Q);
        unwrap(pose, center);
        return pose.v;
      },
      S(trajectory_.duration() * 1e-5));
  ReferenceLeg out;
  out.a = leg.base_point.cast<S>();
  out.b = leg.platform_point.cast<S>();
  out.l = leg.proximal.length;
  out.s = leg.distal.length;
  out.rho = leg.proximal.center_of_mass;
  out.sigma = leg.distal.center_of_mass;
  out.m_proximal = leg.proximal.mass;
  out.m_distal = leg.distal.mass;
  out.I_proximal = leg.proximal.inertia.cast<S>();
  out.I_distal = leg.distal.inertia.cast<S>();
  out.u = unitAxis(leg);
  out.Q_hat = fixedFrame(out.u);
  out.at.v = d.value;
  out.dot.v = d.first;
  out.ddot.v = d.second;
  return out;
}

/// For poses ξ of the platform, D'Alembert's principle gives Σ (momentum rate − gravity) · ∂twist/∂ξ̇ = (∂φ/∂ξ)ᵀ τ +
/// friction, and T = (∂twist/∂ξ̇) (∂φ/∂ξ)⁻¹.
void ReferenceMechanism::addVirtualWork(ReferenceState& reference) const {
  const ReferencePlatform& platform = reference.platform;
  Eigen::Matrix<S, 6 * body_count, 6> twists = Eigen::Matrix<S, 6 * body_count, 6>::Zero();
  Matrix6<S> phi_by_pose;
  Vector6<S> friction = Vector6<S>::Zero();
  for (int j = 0; j < 6; ++j) {
    const V direction = V::Unit(j % 3);
    const auto moved = [&](int i, const S& h) {
      return j < 3 ? legPose(i, platform.p, rotationAbout(j, h) * platform.Q)
                   : legPose(i, platform.p + h * direction, platform.Q);
    };
    for (int i = 0; i < leg_count; ++i) {
      const ReferenceLeg& leg = reference.legs[static_cast<std::size_t>(i)];
      LegPose d;
      d.v = differentiated(
                [&](const S& h) {
                  LegPose pose = moved(i, h);
                  unwrap(pose, leg.at);
                  return pose.v;
                },
                S(1e-5))
                .first;
      phi_by_pose(i, j) = d.phi();
      twists.block<6, 1>(6 * i, j) << spin(leg.at.G(), d.G()), d.c();
      twists.block<6, 1>(6 * (leg_count + i), j) << spin(leg.at.H(), d.H()), d.d();
      friction(j) += frictionForces(manipulator_.leg(i), leg.dot).dot(d.v.head<3>());
    }
    const V omega = j < 3 ? direction : V(V::Zero());
    twists.block<6, 1>(12 * leg_count, j) << omega, (j < 3 ? V(direction.cross(platform.Q * platform.rho)) : direction);
  }
  Vector6<S> inertial = Vector6<S>::Zero(), gravity = Vector6<S>::Zero();
  for (int k = 0; k < body_count; ++k) {
    const ReferenceBody& body = reference.bodies[static_cast<std::size_t>(k)];
    inertial += twists.middleRows<6>(6 * k).transpose() * body.momentumRate();
    gravity += twists.middleRows<3>(6 * k + 3).transpose() * V(body.mass * reference.gravity);
  }
  const Matrix6<S> pose_by_phi = phi_by_pose.partialPivLu().inverse();
  reference.T = twists * pose_by_phi;
  reference.T_P = pose_by_phi;
  reference.gravity_forces = pose_by_phi.transpose() * gravity;
  reference.friction_forces = pose_by_phi.transpose() * friction;
  reference.torques = pose_by_phi.transpose() * Vector6<S>(inertial - gravity - friction);
}

ReferenceState ReferenceMechanism::at(const S& t) const {
  ReferenceState reference;
  reference.t = t;
  reference.motion = trajectory_.at(t);
  reference.gravity = manipulator_.gravity().cast<S>();
  reference.platform = platformAt(t);
  const ReferencePlatform& platform = reference.platform;
  for (int i = 0; i < leg_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const ReferenceLeg leg = reference.legs[k] = legAt(i, t, platform);
    reference.bodies[k] =
        linkBody(leg.m_proximal, leg.I_proximal, leg.at.G(), leg.dot.G(), leg.ddot.G(), leg.dot.c(), leg.ddot.c());
    reference.bodies[leg_count + k] =
        linkBody(leg.m_distal, leg.I_distal, leg.at.H(), leg.dot.H(), leg.ddot.H(), leg.dot.d(), leg.ddot.d());
  }
  reference.bodies.back() = linkBody(S(manipulator_.platform().mass), manipulator_.platform().inertia.cast<S>(),
                                     platform.Q, platform.Q_dot, platform.Q_ddot, platform.c_dot, platform.c_ddot);
  addVirtualWork(reference);
  return reference;
}

}  // namespace ursula::audit

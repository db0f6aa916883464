#include "model/loops/maximal/maximal_loop.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

namespace ursula {
namespace {

constexpr int rows_per_leg = 12, constraints = rows_per_leg * leg_count, coordinates = 6 * body_count;
constexpr int platform = 2 * leg_count;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Vector3d omegaOf(const BodyMotion<double>& body) { return body.twist.head<3>(); }

/// Rows of a point of one body, from the mass centre by `arm`: v = ċ + ω × arm, times `sign`.
void addPoint(Eigen::MatrixXd& G, int row, int body, const Vector3d& arm, double sign) {
  G.block<3, 3>(row, 6 * body) << 0, arm.z(), -arm.y(), -arm.z(), 0, arm.x(), arm.y(), -arm.x(), 0;
  G.block<3, 3>(row, 6 * body) *= sign;
  G.block<3, 3>(row, 6 * body + 3) = sign * Matrix3d::Identity();
}

Vector3d centripetal(const BodyMotion<double>& body, const Vector3d& arm) {
  return omegaOf(body).cross(omegaOf(body).cross(arm));
}

/// Viscous and smoothed Coulomb friction against a joint's rate.
double friction(double viscous, double coulomb, double speed, double rate) {
  return -viscous * rate - coulomb * std::tanh(rate / speed);
}

/// Where the parts of one leg are: the joint's points and the axis of its knee.
struct LegGeometry {
  Vector3d u, x, A, R, B;
};

LegGeometry geometry(const Leg& leg, const BodyMotion<double>& first, const Motion<double>& motion) {
  return {leg.base_axis.normalized(), first.R.col(0), leg.base_point,
          leg.base_point + leg.proximal.length * first.R.col(2), motion.p + motion.Q * leg.platform_point};
}

}  // namespace

MaximalLoop::MaximalLoop(const Manipulator& manipulator, std::shared_ptr<const Load> load)
    : manipulator_(manipulator), load_(std::move(load)) {}

/// The knee from the law of cosines at A, to the side that the sign of the knee says.
void MaximalLoop::placeLeg(int index, const Motion<double>& motion) {
  const Leg& leg = manipulator_.leg(index);
  const double l = leg.proximal.length, s = leg.distal.length;
  const Vector3d u = leg.base_axis.normalized();
  const Vector3d AB = motion.p + motion.Q * leg.platform_point - leg.base_point;
  const double q = AB.norm();
  const double cosine = (l * l + q * q - s * s) / (2 * l * q);
  if (!(std::abs(cosine) <= 1))
    throw std::domain_error(fmt::format("leg {} cannot reach over {} m at t = {} s", index + 1, q, motion.t));
  const Vector3d x = u.cross(AB).normalized();
  const double angle = (leg.knee == Knee::positive ? 1 : -1) * std::acos(cosine);
  const Vector3d e = Eigen::AngleAxisd(angle, x) * (AB / q);
  const Vector3d d = (AB - l * e).normalized();
  BodyMotion<double>&first = bodies_[at(index)], &second = bodies_[at(leg_count + index)];
  first.R << x, e.cross(x), e;
  second.R << x, d.cross(x), d;
  first.c = leg.base_point + leg.proximal.center_of_mass * e;
  second.c = leg.base_point + l * e + leg.distal.center_of_mass * d;
}

/// Twists and their rates from the constraints and the platform's own.
void MaximalLoop::solveMotion(const Motion<double>& motion) {
  G_.setZero(constraints, coordinates);
  gamma_.setZero(constraints);
  for (int i = 0; i < leg_count; ++i) {
    const BodyMotion<double>&first = bodies_[at(i)], &second = bodies_[at(leg_count + i)];
    const LegGeometry leg = geometry(manipulator_.leg(i), first, motion);
    const int row = rows_per_leg * i;
    addPoint(G_, row, i, leg.A - first.c, 1);
    G_.block<1, 3>(row + 3, 6 * i) = leg.u.cross(leg.x).transpose();
    addPoint(G_, row + 4, i, leg.R - first.c, 1);
    addPoint(G_, row + 4, leg_count + i, leg.R - second.c, -1);
    G_.block<2, 3>(row + 7, 6 * i) = -first.R.rightCols<2>().transpose();
    G_.block<2, 3>(row + 7, 6 * (leg_count + i)) = first.R.rightCols<2>().transpose();
    addPoint(G_, row + 9, leg_count + i, leg.B - second.c, 1);
    addPoint(G_, row + 9, platform, leg.B - bodies_.back().c, -1);
  }
  MatrixX with_platform(coordinates, coordinates);
  with_platform.topRows(constraints) = G_;
  with_platform.bottomRows<6>().setZero();
  with_platform.bottomRightCorner<6, 6>().setIdentity();
  const Eigen::PartialPivLU<MatrixX> factors(with_platform);

  const Vector3d arm = bodies_.back().c - motion.p;
  VectorX right = VectorX::Zero(coordinates);
  right.tail<6>() << motion.omega, motion.p_dot + motion.omega.cross(arm);
  const VectorX t = factors.solve(right);
  for (int b = 0; b < body_count; ++b) bodies_[at(b)].twist = t.segment<6>(6 * b);

  for (int i = 0; i < leg_count; ++i) {
    const BodyMotion<double>&first = bodies_[at(i)], &second = bodies_[at(leg_count + i)];
    const LegGeometry leg = geometry(manipulator_.leg(i), first, motion);
    const int row = rows_per_leg * i;
    const Vector3d omega = omegaOf(first), relative = omegaOf(second) - omega;
    gamma_.segment<3>(row) = -centripetal(first, leg.A - first.c);
    gamma_(row + 3) = -omega.dot(leg.u.cross(omega.cross(leg.x)));
    gamma_.segment<3>(row + 4) = centripetal(second, leg.R - second.c) - centripetal(first, leg.R - first.c);
    gamma_(row + 7) = -relative.dot(omega.cross(Vector3d(first.R.col(1))));
    gamma_(row + 8) = -relative.dot(omega.cross(Vector3d(first.R.col(2))));
    gamma_.segment<3>(row + 9) =
        centripetal(bodies_.back(), leg.B - bodies_.back().c) - centripetal(second, leg.B - second.c);
  }
  right.head(constraints) = gamma_;
  right.tail<6>() << motion.omega_dot,
      motion.p_ddot + motion.omega_dot.cross(arm) + motion.omega.cross(motion.omega.cross(arm));
  const VectorX t_rate = factors.solve(right);
  for (int b = 0; b < body_count; ++b) bodies_[at(b)].twist_rate = t_rate.segment<6>(6 * b);
}

/// Inertia less gravity, friction and load: what constraints and motors must give.
MaximalLoop::VectorX MaximalLoop::unbalanced(const Motion<double>& motion) const {
  VectorX w(coordinates);
  const ManipulatorParameters& machine = manipulator_.parameters();
  for (int b = 0; b < body_count; ++b) {
    const Leg& leg = machine.legs[at(b % leg_count)];
    const Link& link = b < leg_count ? leg.proximal : leg.distal;
    const double mass = b == platform ? machine.platform.mass : link.mass;
    const BodyMotion<double>& body = bodies_[at(b)];
    const Matrix3d I = body.R * (b == platform ? machine.platform.inertia : link.inertia) * body.R.transpose();
    const Vector3d omega = omegaOf(body);
    w.segment<6>(6 * b) << I * body.twist_rate.head<3>() + omega.cross(I * omega),
        mass * (body.twist_rate.tail<3>() - machine.gravity);
  }
  for (int i = 0; i < leg_count; ++i) {
    const Leg& leg = machine.legs[at(i)];
    const Vector3d u = leg.base_axis.normalized(), x = bodies_[at(i)].R.col(0);
    const Vector3d first = omegaOf(bodies_[at(i)]), second = omegaOf(bodies_[at(leg_count + i)]);
    const double speed = leg.coulomb.smoothing_speed;
    const double on_phi = friction(leg.friction.phi, leg.coulomb.phi, speed, -first.dot(u));
    const double on_psi = friction(leg.friction.psi, leg.coulomb.psi, speed, first.dot(x));
    const double on_theta = friction(leg.friction.theta, leg.coulomb.theta, speed, (second - first).dot(x));
    w.segment<3>(6 * i) -= -on_phi * u + (on_psi - on_theta) * x;
    w.segment<3>(6 * (leg_count + i)) -= on_theta * x;
  }
  if (load_) {
    const Wrench<double> load = load_->at(motion.t);
    const Matrix3d to_base = load_->frame == Load::Frame::platform ? motion.Q : Matrix3d(Matrix3d::Identity());
    const Vector3d force = to_base * load.force;
    const Vector3d arm = motion.Q * (load_->point - machine.platform.center_of_mass);
    w.tail<6>() -= (Vector6d() << to_base * load.moment + arm.cross(force), force).finished();
  }
  return w;
}

Vector6d MaximalLoop::inverseDynamics(const Motion<double>& motion) {
  bodies_.back().R = motion.Q;
  bodies_.back().c = motion.p + motion.Q * manipulator_.platform().center_of_mass;
  for (int i = 0; i < leg_count; ++i) placeLeg(i, motion);
  solveMotion(motion);
  // Gᵀλ + Sτ balances the rest; S puts each torque on its proximal link, about −u.
  MatrixX multipliers_and_torques = MatrixX::Zero(coordinates, coordinates);
  multipliers_and_torques.leftCols(constraints) = G_.transpose();
  for (int i = 0; i < leg_count; ++i)
    multipliers_and_torques.block<3, 1>(6 * i, constraints + i) = -manipulator_.leg(i).base_axis.normalized();
  const VectorX solution = multipliers_and_torques.partialPivLu().solve(unbalanced(motion));
  return solution.tail<6>();
}

}  // namespace ursula

#include "parts/engines/leg_motion.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

namespace ursula {
namespace {

/// Carries a body's velocity and acceleration past a joint at `origin` that turns about or slides along `axis`.
void passJoint(const Vector3d& origin, const Vector3d& axis, bool slides, double rate, double rate_of_rate,
               ChainBody& body) {
  body.velocity = body.velocityOf(origin);
  body.acceleration = body.accelerationOf(origin);
  body.frame.translation() = origin;
  if (slides) {
    body.velocity += rate * axis;
    body.acceleration += rate_of_rate * axis + 2 * rate * body.omega.cross(axis);
  } else {
    body.alpha += rate_of_rate * axis + rate * body.omega.cross(axis);
    body.omega += rate * axis;
  }
}

/// Fills the bodies from the other members.
void moveBodies(const LegChain& chain, LegMotion& state) {
  ChainBody body;
  for (int j = 0; j < 3; ++j) {
    const std::size_t k = j, link = chain.linkOf(j);
    passJoint(state.at.anchors[k], state.at.axes[k], chain.slides(j), state.rates(j), state.accelerations(j), body);
    state.bodies[link] = body;
    state.bodies[link].frame = state.at.links[link];
  }
}

}  // namespace

ChainBody platformOf(const Motion<double>& motion) {
  ChainBody out{{}, motion.omega, motion.p_dot, motion.omega_dot, motion.p_ddot};
  out.frame.linear() = motion.Q;
  out.frame.translation() = motion.p;
  return out;
}

Vector3d legCoordinates(const Leg& leg, int index, const Matrix3d& frame, const Motion<double>& motion) {
  const Vector3d AB = motion.p + motion.Q * leg.platform_point - leg.base_point;
  if (const auto q = coordinatesAt(leg, frame, AB)) return *q;
  throw std::domain_error(fmt::format("leg {} cannot reach over {} m at t = {} s", index + 1, AB.norm(), motion.t));
}

LegMotion legState(const LegChain& chain, const Leg& leg, int index, const Motion<double>& motion, bool with_bias) {
  const ChainBody platform = platformOf(motion);
  const Vector3d B = platform.frame * leg.platform_point;
  LegMotion out;
  out.q = legCoordinates(leg, index, chain.frame, motion);
  constexpr int newton_steps = 3;
  for (int step = 0; step < newton_steps; ++step) {
    out.at = placed(chain, out.q);
    out.q -= out.at.J.partialPivLu().solve(out.at.tip - B);
  }
  out.at = placed(chain, out.q);
  const Eigen::PartialPivLU<Matrix3d> factors(out.at.J);
  out.rates = factors.solve(platform.velocityOf(B));
  moveBodies(chain, out);
  const Vector3d wanted = with_bias ? Vector3d(platform.accelerationOf(B) - out.bodies[1].accelerationOf(out.at.tip))
                                    : Vector3d(motion.p_ddot + motion.omega_dot.cross(B - motion.p));
  out.accelerations = factors.solve(wanted);
  moveBodies(chain, out);
  return out;
}

Vector3d frictionOn(const Leg& leg, const Vector3d& rates) {
  Vector3d out;
  for (Eigen::Index j = 0; j < 3; ++j) {
    const Coordinate coordinate = rowOf(leg.kind).coordinates[j];
    out(j) = -leg.friction.on(coordinate) * rates(j) -
             leg.coulomb.on(coordinate) * std::tanh(rates(j) / leg.coulomb.speedOf(coordinate));
  }
  return out;
}

Vector6d loadInBase(const Load* load, double t, const Matrix3d& Q) {
  Vector6d out = Vector6d::Zero();
  if (load == nullptr) return out;
  const Wrench<double> wrench = load->at(t);
  const Matrix3d to_base = load->frame == Load::Frame::platform ? Q : Matrix3d(Matrix3d::Identity());
  const Vector3d force = to_base * wrench.force;
  out << to_base * wrench.moment + (Q * load->point).cross(force), force;
  return out;
}

}  // namespace ursula

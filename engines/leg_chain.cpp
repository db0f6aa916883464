#include "engines/leg_chain.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

#include "base/scalar.h"

namespace ursula {
namespace {

Eigen::Isometry3d placed(const Matrix3d& R, const Vector3d& at) {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() = R;
  out.translation() = at;
  return out;
}

/// The angle between sides a and b of a triangle, by the cosine; Newton's steps restore the digits that it loses.
double angleByCosine(double c, double a, double b) { return std::acos((a * a + b * b - c * c) / (2 * a * b)); }

/// Puts `body` behind a joint that turns or slides.
void passJoint(const LegChain::Joint& joint, double q, double rate, double rate_of_rate, ChainBody& body) {
  const Eigen::Isometry3d at = body.frame * joint.place;
  const Vector3d axis = at.linear() * joint.axis;
  Vector3d origin = at.translation();
  if (joint.slides) origin += q * axis;
  body.velocity = body.velocityOf(origin);
  body.acceleration = body.accelerationOf(origin);
  if (joint.slides) {
    body.velocity += rate * axis;
    body.acceleration += rate_of_rate * axis + 2 * rate * body.omega.cross(axis);
  } else {
    body.alpha += rate_of_rate * axis + rate * body.omega.cross(axis);
    body.omega += rate * axis;
  }
  const Matrix3d turn =
      joint.slides ? Matrix3d(Matrix3d::Identity()) : Eigen::AngleAxisd(q, joint.axis).toRotationMatrix();
  body.frame = placed(at.linear() * turn, origin);
}

}  // namespace

Matrix3d fixedFrame(const Leg& leg) {
  const Vector3d u = leg.base_axis.normalized(), level = u.cross(Vector3d::UnitZ());
  const Vector3d x = (level.norm() < 1e-10 ? u.cross(Vector3d::UnitY()) : level).normalized();
  Matrix3d out;
  out << x, u, x.cross(u);
  return out;
}

Matrix3d alongAxis() { return Eigen::AngleAxisd(-pi / 2, Vector3d::UnitX()).toRotationMatrix(); }

Vector3d legCoordinates(const Leg& leg, int index, const Vector3d& k) {
  const double l = leg.proximal.length, s = leg.distal.length, side = leg.knee == Knee::positive ? 1 : -1;
  const double q = k.norm(), r = std::hypot(k.x(), k.z()), turn = std::atan2(-k.x(), k.z());
  Vector3d out;
  switch (leg.kind) {
    case LegKind::URS:
      out << turn, std::atan2(r, k.y()) + side * angleByCosine(s, l, q), side * angleByCosine(q, l, s);
      break;
    case LegKind::UPS:
      out << turn, std::atan2(r, k.y()), q;
      break;
    case LegKind::RUS: {
      const double c = std::sqrt(s * s - k.y() * k.y());
      out << turn - side * angleByCosine(c, l, r), side * (pi - angleByCosine(r, l, c)), std::atan2(k.y(), c);
      break;
    }
    case LegKind::PUS: {
      const double ahead = side * std::sqrt(s * s - r * r);
      out << k.y() - ahead, turn, std::atan2(r, ahead);
      break;
    }
  }
  if (!out.allFinite()) throw std::domain_error(fmt::format("leg {} cannot reach over {} m", index + 1, q));
  return out;
}

LegChain chainOf(const Leg& leg) {
  const Matrix3d frame = fixedFrame(leg), one = Matrix3d::Identity();
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ(), none = Vector3d::Zero();
  const Eigen::Isometry3d at_A = placed(frame, leg.base_point), turned = placed(frame * alongAxis(), leg.base_point);
  LegChain out{{}, {leg.proximal, leg.distal}, {leg.proximalCenter(), leg.distalCenter()}, leg.distal.length * z};
  switch (leg.kind) {
    case LegKind::URS:  // at zero the distal link is turned by half a turn
      out.joints = {
          {{turned, -z, false, -1},
           {placed(one, none), x, false, 0},
           {placed(Eigen::Quaterniond(0, 1, 0, 0).toRotationMatrix(), leg.proximal.length * z), x, false, 1}}};
      break;
    case LegKind::UPS:
      out.joints = {{{turned, -z, false, -1},
                     {placed(one, none), x, false, 0},
                     {placed(one, -leg.distal.length * z), z, true, 1}}};
      break;
    case LegKind::RUS:
      out.joints = {{{at_A, -y, false, 0},
                     {placed(one, leg.proximal.length * z), -y, false, -1},
                     {placed(one, none), -x, false, 1}}};
      break;
    case LegKind::PUS:
      out.joints = {{{at_A, y, true, 0}, {placed(alongAxis(), none), -z, false, -1}, {placed(one, none), x, false, 1}}};
      break;
  }
  return out;
}

void moveChain(const LegChain& chain, LegState& state) {
  ChainBody body;
  for (std::size_t j = 0; j < 3; ++j) {
    const LegChain::Joint& joint = chain.joints[j];
    const auto k = static_cast<Eigen::Index>(j);
    passJoint(joint, state.q(k), state.rates(k), state.accelerations(k), body);
    state.axes[j] = body.frame.linear() * joint.axis;
    state.anchors[j] = body.frame.translation();
    if (joint.body >= 0) state.bodies[static_cast<std::size_t>(joint.body)] = body;
  }
  state.tip = body.frame * chain.tip;
  for (std::size_t j = 0; j < 3; ++j)
    state.J.col(static_cast<Eigen::Index>(j)) =
        chain.joints[j].slides ? state.axes[j] : state.axes[j].cross(Vector3d(state.tip - state.anchors[j]));
}

ChainBody platformOf(const Motion<double>& motion) {
  return {placed(motion.Q, motion.p), motion.omega, motion.p_dot, motion.omega_dot, motion.p_ddot};
}

LegState legState(const LegChain& chain, const Leg& leg, int index, const Motion<double>& motion, bool with_bias) {
  const ChainBody platform = platformOf(motion);
  const Vector3d B = platform.frame * leg.platform_point;
  LegState out;
  out.q = legCoordinates(leg, index, fixedFrame(leg).transpose() * (B - leg.base_point));
  constexpr int newton_steps = 3;  // geometry loses half the digits if a leg is nearly stretched
  for (int step = 0; step < newton_steps; ++step) {
    moveChain(chain, out);
    out.q -= out.J.partialPivLu().solve(out.tip - B);
  }
  moveChain(chain, out);
  const Eigen::PartialPivLU<Matrix3d> factors(out.J);
  out.rates = factors.solve(platform.velocityOf(B));
  moveChain(chain, out);
  const Vector3d wanted = with_bias ? Vector3d(platform.accelerationOf(B) - out.bodies[1].accelerationOf(out.tip))
                                    : Vector3d(motion.p_ddot + motion.omega_dot.cross(B - motion.p));
  out.accelerations = factors.solve(wanted);
  moveChain(chain, out);
  return out;
}

Vector3d frictionOn(const Leg& leg, const Vector3d& rates) {
  Vector3d out;
  for (Eigen::Index j = 0; j < 3; ++j) {
    const Coordinate coordinate = rowOf(leg.kind).coordinates[static_cast<std::size_t>(j)];
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

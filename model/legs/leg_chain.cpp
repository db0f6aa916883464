#include "model/legs/leg_chain.h"

#include "model/legs/leg_type.h"

namespace ursula {

Matrix3d fixedFrame(const Vector3d& base_axis) {
  const Vector3d u = base_axis.normalized(), level = u.cross(Vector3d::UnitZ());
  const Vector3d x = (level.norm() < 1e-10 ? u.cross(Vector3d::UnitY()) : level).normalized();
  Matrix3d out;
  out << x, u, x.cross(u);
  return out;
}

Matrix3d LegJoint::rotation() const {
  const double w = turn.w();
  const Vector3d v = turn.vec();
  Matrix3d cross;
  cross << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  const Matrix3d scaled = (w * w - v.squaredNorm()) * Matrix3d::Identity() + 2 * (v * v.transpose() + w * cross);
  return scaled / turn.squaredNorm();
}

Eigen::Isometry3d LegChain::place(int j) const {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() = j == 0 ? Matrix3d(frame * joint(j).rotation()) : joint(j).rotation();
  out.translation() = j == 0 ? base_point : joint(j).at;
  return out;
}

LegChain chainOf(const Leg& leg) { return chainOf(leg, fixedFrame(leg.base_axis)); }

LegChain chainOf(const Leg& leg, const Matrix3d& frame) {
  return {rowOf(leg.kind),
          frame,
          leg.base_point,
          typeOf(leg.kind).joints(leg),
          {leg.proximal, leg.distal},
          {leg.proximalCenter(), leg.distalCenter()},
          leg.proximal.length * Vector3d::Unit(leg.proximalLine()),
          leg.distal.length * Vector3d::UnitZ()};
}

std::optional<Vector3d> coordinatesAt(const Leg& leg, const Matrix3d& frame, const Vector3d& AB) {
  const Reach reach = typeOf(leg.kind).reach(leg, spanOf(frame.col(1), AB));
  if (!(reach.least < reach.distance && reach.distance < reach.most)) return std::nullopt;
  return typeOf(leg.kind).coordinates(leg, frame, AB);
}

PlacedChain placed(const LegChain& chain, const Vector3d& q) {
  PlacedChain out;
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  for (int j = 0; j < 3; ++j) {
    const Vector3d& axis = chain.joint(j).axis;
    frame = frame * chain.place(j);
    if (chain.slides(j))
      frame.translation() += q(j) * (frame.linear() * axis);
    else
      frame.linear() = frame.linear() * Eigen::AngleAxisd(q(j), axis).toRotationMatrix();
    out.axes[j] = frame.linear() * axis;
    out.anchors[j] = frame.translation();
    out.links[chain.linkOf(j)] = frame;
  }
  out.tip = frame * chain.tip;
  for (int j = 0; j < 3; ++j) {
    out.J.col(j) = chain.slides(j) ? out.axes[j] : out.axes[j].cross(Vector3d(out.tip - out.anchors[j]));
  }
  return out;
}

}  // namespace ursula

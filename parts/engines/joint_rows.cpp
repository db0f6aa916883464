#include "parts/engines/joint_rows.h"

#include <algorithm>
#include <cmath>

namespace ursula {
namespace {

using Kind = JointRow::Kind;

JointRow rowBetween(const Mechanism& mechanism, std::size_t j, const WeldedMechanism& welded, Kind kind) {
  const MechanismJoint& joint = mechanism.joints()[j];
  JointRow row;
  row.kind = kind;
  row.joint = j;
  row.a = welded.parentOf(joint);
  row.b = welded.childOf(joint);
  row.on_a = joint.centre - welded.welds[row.a].center;
  row.on_b = joint.centre_of_child - welded.welds[row.b].center;
  return row;
}

/// Angle from `from` to `to` about a unit axis.
double turnAbout(const Vector3d& axis, const Vector3d& from, const Vector3d& to) {
  return std::atan2(axis.dot(from.cross(to)), from.dot(to) - axis.dot(from) * axis.dot(to));
}

double angleOf(const JointCoordinate& coordinate, const WeldState& a, const WeldState& b) {
  const MechanismJoint& joint = *coordinate.joint;
  const Matrix3d R = a.R.transpose() * b.R * joint.turn.transpose();
  const Vector3d &first = joint.axis[0], &second = joint.axis[1];
  if (joint.kind == JointKind::universal)  // R turns about the first axis, then about the second
    return coordinate.index == 0 ? turnAbout(first, second, R * second)
                                 : turnAbout(second, R.transpose() * first, first);
  const Vector3d across = first.unitOrthogonal();
  return turnAbout(first, across, R * across);
}

void setDot(const JointRow& row, const WeldState& a, const WeldState& b, JointRowNow& out) {
  const Vector3d u = a.R * row.along, w = b.R * row.with;
  out.value = u.dot(w) - row.constant;
  out.of_b.head<3>() = w.cross(u);
  out.of_a.head<3>() = u.cross(w);
  const Vector3d u_dot = a.w.cross(u), w_dot = b.w.cross(w);
  out.bias = u.dot(b.w.cross(w_dot)) + 2 * u_dot.dot(w_dot) + w.dot(a.w.cross(u_dot));
}

void setTurn(const JointRow& row, const WeldState& a, const WeldState& b, JointRowNow& out) {
  const WeldState& carrier = row.is_on_b ? b : a;
  const Vector3d e = carrier.R * row.along;
  out.of_b.head<3>() = e;
  out.of_a.head<3>() = -e;
  out.bias = carrier.w.cross(e).dot(b.w - a.w);
}

void setPoint(const JointRow& row, const WeldState& a, const WeldState& b, JointRowNow& out) {
  const Vector3d e = a.R * row.along, ra = a.R * row.on_a, rb = b.R * row.on_b;
  const Vector3d apart = (b.c - a.c) + (rb - ra);
  out.value = e.dot(apart);
  out.of_b << rb.cross(e), e;
  out.of_a << e.cross(apart) - ra.cross(e), -e;
  const Vector3d rate = (b.v - a.v) + (b.w.cross(rb) - a.w.cross(ra)), e_dot = a.w.cross(e);
  out.bias =
      e.dot(b.w.cross(b.w.cross(rb)) - a.w.cross(a.w.cross(ra))) + 2 * e_dot.dot(rate) + apart.dot(a.w.cross(e_dot));
}

/// All three components, or those across an axis.
std::vector<Vector3d> axesAcross(const Vector3d* axis) {
  if (axis == nullptr) return {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
  const Vector3d t = axis->unitOrthogonal();
  return {t, axis->cross(t)};
}

}  // namespace

JointRowNow rowNow(const JointRow& row, const WeldState& a, const WeldState& b) {
  JointRowNow out;
  if (row.kind == Kind::point) setPoint(row, a, b, out);
  if (row.kind == Kind::dot) setDot(row, a, b, out);
  if (row.kind == Kind::turn) setTurn(row, a, b, out);
  return out;
}

double valueOf(const JointCoordinate& coordinate, const WeldState& a, const WeldState& b, double near) {
  if (coordinate.row.kind == Kind::point) return coordinate.joint->position + rowNow(coordinate.row, a, b).value;
  const double angle = coordinate.joint->position + angleOf(coordinate, a, b);
  return angle + 2 * pi * std::round((near - angle) / (2 * pi));
}

std::vector<JointRow> rowsOf(const Mechanism& mechanism, std::size_t j, const WeldedMechanism& welded) {
  std::vector<JointRow> out;
  const MechanismJoint& joint = mechanism.joints()[j];
  if (joint.kind == JointKind::free || welded.parentOf(joint) == welded.childOf(joint)) return out;
  const bool slides = joint.slides();
  for (const Vector3d& e : axesAcross(slides ? joint.axis.data() : nullptr)) {
    out.push_back(rowBetween(mechanism, j, welded, Kind::point));
    out.back().along = e;
  }
  const auto addDot = [&](const Vector3d& on_parent, const Vector3d& on_child) {
    out.push_back(rowBetween(mechanism, j, welded, Kind::dot));
    out.back().along = on_parent;
    out.back().with = joint.turn.transpose() * on_child;
    out.back().constant = on_parent.dot(on_child);
  };
  if (joint.kind == JointKind::universal) addDot(joint.axis[0], joint.axis[1]);
  if (joint.kind == JointKind::revolute)
    for (const Vector3d& e : axesAcross(joint.axis.data())) addDot(e, joint.axis[0]);
  if (joint.kind == JointKind::fixed || slides)
    for (int k = 0; k < 3; ++k) addDot(Vector3d::Unit(k), Vector3d::Unit((k + 1) % 3));
  return out;
}

std::vector<JointCoordinate> coordinatesOf(const Mechanism& mechanism, std::size_t j, const WeldedMechanism& welded) {
  std::vector<JointCoordinate> out;
  const MechanismJoint& joint = mechanism.joints()[j];
  const bool has_axes = joint.kind != JointKind::ball && joint.kind != JointKind::free;
  for (int k = 0; k < freedomsOf(joint.kind); ++k) {
    const bool is_linear = joint.slides() || k >= 3;
    JointRow row = rowBetween(mechanism, j, welded, is_linear ? Kind::point : Kind::turn);
    row.is_on_b = !is_linear && (!has_axes || k == 1);
    row.along = has_axes
                    ? joint.axis[k]
                    : Vector3d(mechanism.bodies()[row.is_on_b ? joint.child : joint.parent].frame.linear().col(k % 3));
    if (row.is_on_b && has_axes) row.along = joint.turn.transpose() * row.along;
    out.push_back({&joint, k, row});
  }
  return out;
}

}  // namespace ursula

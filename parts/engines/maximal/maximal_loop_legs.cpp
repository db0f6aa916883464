// Places the links of a leg at a pose of the platform. The formulas are this engine's own: it shares no description of
// the legs' joints with the others, so an error there cannot hide here.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "parts/engines/maximal/maximal_loop.h"

namespace ursula::maximal {
namespace {

struct Ends {
  Vector3d u, A, B, AB;
};

/// AB, split into a part along u and a part across it.
struct Split {
  double along, distance;
  Vector3d outwards;  ///< unit, from u's line to B

  explicit Split(const Ends& ends) : along(ends.u.dot(ends.AB)) {
    const Vector3d across = ends.AB - along * ends.u;
    distance = across.norm();
    outwards = across / distance;
  }
};

void requireReach(bool reaches, int index, double distance, double t) {
  if (!reaches)
    throw std::domain_error(fmt::format("leg {} cannot reach over {} m at t = {} s", index + 1, distance, t));
}

double side(const Leg& leg) { return leg.knee == Knee::positive ? 1 : -1; }

Matrix3d frameOf(const Vector3d& x, const Vector3d& axis) {
  Matrix3d frame;
  frame << x, axis.cross(x), axis;
  return frame;
}

/// Returns [x̂, û, ẑ] with a horizontal x̂.
Matrix3d fixedFrame(const Vector3d& u) {
  Vector3d x = u.cross(Vector3d::UnitZ());
  if (x.squaredNorm() < 1e-20) x = u.cross(Vector3d::UnitY());
  x.normalize();
  Matrix3d frame;
  frame << x, u, x.cross(u);
  return frame;
}

/// Finds the knee from the law of cosines at A, on the side that the knee's sign selects.
void placeKneed(const Leg& leg, int index, const Ends& ends, double t, PlacedLeg& out) {
  const double l = leg.proximal.length, s = leg.distal.length;
  const double q = ends.AB.norm();
  const double cosine = (l * l + q * q - s * s) / (2 * l * q);
  requireReach(std::abs(cosine) <= 1, index, q, t);
  const Vector3d x = ends.u.cross(ends.AB).normalized();
  const double angle = side(leg) * std::acos(cosine);
  const Vector3d e = Eigen::AngleAxisd(angle, x) * (ends.AB / q);
  const Vector3d d = (ends.AB - l * e).normalized();
  const Vector3d R = ends.A + l * e;
  out.R = {frameOf(x, e), frameOf(x, d)};
  out.c = {ends.A + leg.proximal.center_of_mass * e, R + leg.distal.center_of_mass * d};
  out.joints[0].axes = {-ends.u, x};
  out.joints[1].axes[0] = x;
  out.joints[1].across = out.R[0].rightCols<2>();
  out.joints[1].point = R;
}

/// Both links lie on the line AB; the rod's inner end is within the cylinder.
void placeTelescope(const Leg& leg, int index, const Ends& ends, double t, PlacedLeg& out) {
  const double l = leg.proximal.length, s = leg.distal.length;
  const double d = ends.AB.norm();
  requireReach(s < d && d < s + l, index, d, t);
  const Vector3d x = ends.u.cross(ends.AB).normalized(), e = ends.AB / d;
  out.R = {frameOf(x, e), frameOf(x, e)};
  out.c = {ends.A + leg.proximal.center_of_mass * e, ends.B + (leg.distal.center_of_mass - s) * e};
  out.joints[0].axes = {-ends.u, x};
  out.joints[1].axes[0] = e;
  out.joints[1].across = out.R[0].leftCols<2>();
  out.joints[1].point = ends.B;
}

/// R is where the crank's circle meets the sphere of radius s about B. That sphere intersects the circle's plane in a
/// circle.
void placeCrank(const Leg& leg, int index, const Ends& ends, double t, PlacedLeg& out) {
  const double l = leg.proximal.length, s = leg.distal.length;
  const Split B(ends);
  requireReach(std::abs(B.along) < s, index, std::abs(B.along), t);
  const double c = std::sqrt((s - B.along) * (s + B.along));  // projection of the rod along u
  requireReach(B.distance <= l + c && B.distance >= std::abs(l - c), index, B.distance, t);
  const double foot = (B.distance + (l - c) * (l + c) / B.distance) / 2;  // where the circles' chord crosses AB
  const double half_chord = std::sqrt(std::max((l - foot) * (l + foot), 0.0));
  // A positive rod angle turns about −u, so the crank is behind.
  const Vector3d e = (foot * B.outwards + side(leg) * half_chord * ends.u.cross(B.outwards)) / l;
  const Vector3d rod = (ends.AB - l * e).normalized();
  const Vector3d x = ends.u.cross(e).normalized(), x_2 = ends.u.cross(rod).normalized();
  const Vector3d R = ends.A + l * e;
  out.R = {frameOf(x, e), frameOf(x_2, rod)};
  out.c = {ends.A + leg.proximal.center_of_mass * e, R + leg.distal.center_of_mass * rod};
  out.joints[0].axes[0] = -ends.u;
  out.joints[0].across << x, e;
  out.joints[1].axes = {-ends.u, -x_2};
  out.joints[1].point = R;
}

/// The carriage is where the rail meets the sphere of radius s about B; with a positive knee it is behind B.
void placeCarriage(const Leg& leg, int index, const Ends& ends, double t, PlacedLeg& out) {
  const double s = leg.distal.length;
  const Split B(ends);
  requireReach(B.distance <= s, index, B.distance, t);
  const double ahead = side(leg) * std::sqrt((s - B.distance) * (s + B.distance));
  const Vector3d carriage = ends.A + (B.along - ahead) * ends.u;
  const Vector3d rod = (B.distance * B.outwards + ahead * ends.u).normalized();
  const Vector3d x = ends.u.cross(B.outwards).normalized();
  out.R = {fixedFrame(ends.u), frameOf(x, rod)};
  out.c = {carriage + leg.proximal.center_of_mass * ends.u, carriage + leg.distal.center_of_mass * rod};
  out.joints[0].axes[0] = ends.u;
  out.joints[0].across << out.R[0].col(0), out.R[0].col(2);
  out.joints[0].point = carriage;
  out.joints[1].axes = {-ends.u, x};
  out.joints[1].point = carriage;
}

Joint::Type jointOf(const LegKindRow& row, int link) {
  using Type = Joint::Type;
  if ((link == 0) == (row.joints_of_proximal == 2)) return Type::universal;
  return slides(row.coordinates[link == 0 ? 0 : 2]) ? Type::prismatic : Type::revolute;
}

/// Moves mass centres off the links' lines.
void moveCenters(const Leg& leg, PlacedLeg& out) {
  if (!leg.proximal.off_line.isZero(0)) out.c[0] += out.R[0] * leg.proximal.off_line;
  if (!leg.distal.off_line.isZero(0)) out.c[1] += out.R[1] * leg.distal.off_line;
}

}  // namespace

PlacedLeg placeLeg(const Leg& leg, int index, int first, int second, const Motion<double>& motion) {
  const Vector3d B = motion.p + motion.Q * leg.platform_point;
  const Ends ends = {leg.base_axis.normalized(), leg.base_point, B, B - leg.base_point};
  PlacedLeg out;
  out.B = B;
  const LegKindRow& row = rowOf(leg.kind);
  for (int link = 0; link < 2; ++link) out.joints[link].type = jointOf(row, link);
  out.joints[0].child = out.joints[1].parent = first;
  out.joints[1].child = second;
  out.joints[0].point = ends.A;
  if (row.joints_of_proximal == 2)
    (row.isTelescopic() ? placeTelescope : placeKneed)(leg, index, ends, motion.t, out);
  else
    (row.hasCarriage() ? placeCarriage : placeCrank)(leg, index, ends, motion.t, out);
  moveCenters(leg, out);
  return out;
}

}  // namespace ursula::maximal

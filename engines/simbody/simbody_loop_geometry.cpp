// Joint coordinates of a leg for a position of B, by independent vector geometry, without the solver.

#include <Eigen/Geometry>
#include <cmath>

#include "engines/simbody/simbody_loop_internal.h"

namespace ursula {
namespace {

using Geometry = std::optional<std::array<double, 3>>;

/// B relative to A: the parts along u and off the axis; z points off the axis, x = u × z.
struct Place {
  Vector3d u, d, off_axis, z, x;

  Place(const Matrix3d& base, const Vector3d& to_B)
      : u(-Vector3d(base.col(0))), d(to_B), off_axis(d - d.dot(u) * u), z(off_axis.normalized()), x(u.cross(z)) {}
};

double sideOf(const Leg& leg) { return leg.knee == Knee::positive ? 1 : -1; }

/// φ of a leg whose plane has the normal x.
double turnOf(const Vector3d& x, const Matrix3d& base) { return std::atan2(x.dot(base.col(2)), x.dot(base.col(1))); }

/// The plane of the leg contains u and B. The knee R is where the circles about A and B meet in it, on the side that
/// `knee` selects. With a positive knee, RA turns to RB positively about x.
Geometry ofURS(const Leg& leg, const Matrix3d& base, const Place& at) {
  const Vector3d& d = at.d;
  const double l = leg.proximal.length, s = leg.distal.length;
  const double q2 = d.squaredNorm(), q = std::sqrt(q2);
  // Along d from A, and perpendicular to it in the leg's plane.
  const double along = (l * l - s * s + q2) / (2 * q);
  const double off2 = (l - along) * (l + along);
  if (!(off2 >= 0) || !(at.off_axis.norm() > 0)) return std::nullopt;
  const Vector3d R = along * d / q + sideOf(leg) * std::sqrt(off2) * at.x.cross(d / q);
  const Vector3d to_A = -R, to_B = d - R;
  const double psi = std::atan2(R.dot(at.z), R.dot(at.u));
  const double theta = std::atan2(to_A.cross(to_B).dot(at.x), to_A.dot(to_B));
  return {{turnOf(at.x, base), psi, theta}};
}

Geometry ofUPS(const Leg& leg, const Matrix3d& base, const Place& at) {
  const double length = at.d.norm(), off = at.off_axis.norm();
  if (!(length > leg.distal.length && length < leg.distal.length + leg.proximal.length) || !(off > 0))
    return std::nullopt;
  return {{turnOf(at.x, base), std::atan2(off, at.d.dot(at.u)), length}};
}

/// In the view along u, the crank's tip R is where the crank's circle about A meets the projected rod's about B. With a
/// positive knee, AR turns to RB positively about −u.
Geometry ofRUS(const Leg& leg, const Matrix3d& base, const Place& at) {
  const double l = leg.proximal.length, s = leg.distal.length;
  const double height = at.d.dot(at.u), r = at.off_axis.norm();
  const double shadow2 = (s - height) * (s + height);
  if (!(shadow2 > 0) || !(r > 0)) return std::nullopt;
  const double shadow = std::sqrt(shadow2), along = (l * l - shadow2 + r * r) / (2 * r);
  const double off2 = (l - along) * (l + along);
  if (!(off2 >= 0)) return std::nullopt;
  const Vector3d R = along * at.z + sideOf(leg) * std::sqrt(off2) * at.x;
  const Vector3d rod = at.off_axis - R;
  const double phi = std::atan2(-R.dot(base.col(1)), R.dot(base.col(2)));
  return {{phi, std::atan2(-R.cross(rod).dot(at.u), R.dot(rod)), std::atan2(height, shadow)}};
}

/// The carriage is where the rail meets the sphere about B, before or behind B's foot on the rail.
Geometry ofPUS(const Leg& leg, const Matrix3d& base, const Place& at) {
  const double s = leg.distal.length, r = at.off_axis.norm();
  const double along2 = (s - r) * (s + r);
  if (!(along2 >= 0) || !(r > 0)) return std::nullopt;
  const double along = sideOf(leg) * std::sqrt(along2);
  const double psi = std::atan2(-at.z.dot(base.col(1)), at.z.dot(base.col(2)));
  return {{at.d.dot(at.u) - along, psi, std::atan2(r, along)}};
}

}  // namespace

std::optional<std::array<double, 3>> legGeometry(const Leg& leg, const Matrix3d& base, const Vector3d& d) {
  const Place at(base, d);
  switch (leg.kind) {
    case LegKind::UPS:
      return ofUPS(leg, base, at);
    case LegKind::RUS:
      return ofRUS(leg, base, at);
    case LegKind::PUS:
      return ofPUS(leg, base, at);
    case LegKind::URS:
      break;
  }
  return ofURS(leg, base, at);
}

}  // namespace ursula

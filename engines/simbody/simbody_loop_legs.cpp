// Each kind of leg in Simbody: its bodies and joints, the coordinates for a position of B, and the velocity of B by its
// rates. Universal turns about its x, then y; Pin about z; Slider moves along x. For URS φ turns about −u, ψ and θ
// about x. For UPS d moves along e. For RUS φ and ψ turn about −u, θ about −x₂. For PUS d moves along u, ψ turns about
// −u, θ about x. The links' body frames are G = [x, e × x, e] and H = [x, s × x, s] of the paper's (40) (for a carriage
// [x̂, u, ẑ]). Their origins are at the links' first ends, so the raw inertias apply unchanged. Coordinates come from
// vector geometry, without the solver.

#include <Eigen/Geometry>
#include <cmath>

#include "engines/simbody/simbody_loop_internal.h"

namespace ursula {
namespace {

SimTK::Body::Rigid proximalBody(const Leg& leg) {
  return SimTK::Body::Rigid(massProperties(leg.proximal.mass, leg.proximalCenter(), leg.proximal.inertia));
}

SimTK::Body::Rigid distalBody(const Leg& leg) {
  return SimTK::Body::Rigid(massProperties(leg.distal.mass, leg.distalCenter(), leg.distal.inertia));
}

/// Returns the frame with these axes, given in a body.
SimTK::Transform frameOf(const Vector3d& x, const Vector3d& y, const Vector3d& z,
                         const Vector3d& origin = Vector3d::Zero()) {
  Matrix3d R;
  R << x, y, z;
  return {toSimTK(R), toSimTK(origin)};
}

const Vector3d e_x = Vector3d::UnitX(), e_y = Vector3d::UnitY(), e_z = Vector3d::UnitZ();

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

Matrix3d baseFrame(const Vector3d& axis) {
  const Vector3d u = axis.normalized();
  const bool vertical = u.cross(Vector3d::UnitZ()).norm() < 1e-10;
  const Vector3d x = u.cross(vertical ? Vector3d(Vector3d::UnitY()) : Vector3d(Vector3d::UnitZ())).normalized();
  Matrix3d frame;
  frame << -u, x, x.cross(u);
  return frame;
}

void SimbodyLoop::Impl::addLeg(int leg) {
  const Leg& from = parameters.leg(leg);
  switch (from.kind) {
    case LegKind::URS:
    case LegKind::UPS:
      addUniversalLeg(from);
      break;
    case LegKind::RUS:
      addCrank(from);
      break;
    case LegKind::PUS:
      addCarriage(from);
      break;
  }
  mechanism.joints_of_proximal.push_back(rowOf(from.kind).joints_of_proximal);
}

void SimbodyLoop::Impl::addUniversalLeg(const Leg& from) {
  // ψ = 0 lays e along u: Universal's axes −u, x, z are then −e, x, −(e × x).
  SimTK::MobilizedBody::Universal first(matter.Ground(),
                                        SimTK::Transform(toSimTK(baseFrame(from.base_axis)), toSimTK(from.base_point)),
                                        proximalBody(from), frameOf(-e_z, e_x, -e_y));
  mechanism.proximal.push_back(first);
  if (rowOf(from.kind).isTelescopic()) {
    // d = s puts the rod's inner end at A.
    mechanism.distal.push_back(SimTK::MobilizedBody::Slider(first, frameOf(e_z, e_x, e_y, -from.distal.length * e_z),
                                                            distalBody(from), frameOf(e_z, e_x, e_y)));
    return;
  }
  // Pin's z is x of the leg. θ = 0 folds the leg: s = −e.
  mechanism.distal.push_back(SimTK::MobilizedBody::Pin(first, frameOf(e_y, e_z, e_x, from.proximal.length * e_z),
                                                       distalBody(from), frameOf(-e_y, -e_z, e_x)));
}

void SimbodyLoop::Impl::addCrank(const Leg& from) {
  const Matrix3d base = baseFrame(from.base_axis);
  SimTK::MobilizedBody::Pin crank(matter.Ground(), frameOf(base.col(1), base.col(2), base.col(0), from.base_point),
                                  proximalBody(from), frameOf(e_x, e_z, -e_y));
  mechanism.proximal.push_back(crank);
  // ψ = θ = 0 lays the rod along the crank.
  mechanism.distal.push_back(SimTK::MobilizedBody::Universal(
      crank, frameOf(-e_y, -e_x, -e_z, from.proximal.length * e_z), distalBody(from), frameOf(-e_y, -e_x, -e_z)));
}

void SimbodyLoop::Impl::addCarriage(const Leg& from) {
  const Matrix3d base = baseFrame(from.base_axis);
  SimTK::MobilizedBody::Slider carriage(matter.Ground(),
                                        frameOf(-base.col(0), base.col(2), base.col(1), from.base_point),
                                        proximalBody(from), frameOf(e_y, e_z, e_x));
  mechanism.proximal.push_back(carriage);
  // θ = 0 lays the rod along the rail.
  mechanism.distal.push_back(
      SimTK::MobilizedBody::Universal(carriage, frameOf(-e_y, e_x, e_z), distalBody(from), frameOf(-e_z, e_x, -e_y)));
}

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

Matrix3d legJacobian(const Leg& leg, const SimTK::State& state, const SimTK::MobilizedBody& first,
                     const SimTK::MobilizedBody& second, const Vector3d& from_A, const Vector3d& to_B) {
  const auto base = [&](int k) {
    return toEigen(SimTK::Vec3(first.getInboardFrame(state).R().getAxisUnitVec(SimTK::CoordinateAxis(k))));
  };
  const Vector3d x = toEigen(SimTK::Vec3(second.getBodyRotation(state).x()));
  Matrix3d J;
  switch (leg.kind) {
    case LegKind::URS: {
      const Vector3d minus_u = base(0), x_1 = toEigen(SimTK::Vec3(first.getBodyRotation(state).x()));
      J << minus_u.cross(from_A), x_1.cross(from_A), x_1.cross(to_B);
      break;
    }
    case LegKind::UPS:
      J << base(0).cross(from_A), x.cross(from_A), toEigen(SimTK::Vec3(second.getBodyRotation(state).z()));
      break;
    case LegKind::RUS:
      J << base(2).cross(from_A), base(2).cross(to_B), to_B.cross(x);
      break;
    case LegKind::PUS:
      J << base(0), to_B.cross(base(0)), x.cross(to_B);
      break;
  }
  return J;
}

}  // namespace ursula

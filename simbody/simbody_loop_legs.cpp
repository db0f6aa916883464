// This file has the legs in Simbody. model/legs/ describes their bodies and joints. Their coordinates for a position of
// B come from vector geometry of Simbody's own, without the solver. Universal turns about its x, then y; Pin about z;
// Slider moves along x. Links' frames have their origins at the links' first ends, so the raw inertias apply unchanged.

#include <Eigen/Geometry>
#include <cmath>

#include "model/legs/leg_type.h"
#include "simbody/simbody_loop_internal.h"

namespace ursula {
namespace {

using Geometry = std::optional<std::array<double, 3>>;

/// B relative to A, with the part off the axis u; z points off the axis, x = u × z.
struct Place {
  Vector3d u, d, off_axis, z, x;

  Place(const Matrix3d& frame, const Vector3d& to_B)
      : u(frame.col(1)), d(to_B), off_axis(d - d.dot(u) * u), z(off_axis.normalized()), x(u.cross(z)) {}
};

/// Returns φ of a leg whose plane has the normal x.
double turnOf(const Vector3d& x, const Matrix3d& frame) { return std::atan2(x.dot(frame.col(2)), x.dot(frame.col(0))); }

/// The plane of the leg contains u and B. The knee R is where the circles about A and B meet in it, on the side that
/// `knee` selects. With a positive knee, RA turns to RB positively about x.
Geometry ofKneed(const Leg& leg, const Matrix3d& frame, const Place& at) {
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
  return {{turnOf(at.x, frame), psi, theta}};
}

Geometry ofTelescope(const Leg& leg, const Matrix3d& frame, const Place& at) {
  const double length = at.d.norm(), off = at.off_axis.norm();
  if (!(length > leg.distal.length && length < leg.distal.length + leg.proximal.length) || !(off > 0))
    return std::nullopt;
  return {{turnOf(at.x, frame), std::atan2(off, at.d.dot(at.u)), length}};
}

/// In the view along u, the crank's tip R is where the crank's circle about A meets the projected rod's about B. With a
/// positive knee, AR turns to RB positively about −u.
Geometry ofCrank(const Leg& leg, const Matrix3d& frame, const Place& at) {
  const double l = leg.proximal.length, s = leg.distal.length;
  const double height = at.d.dot(at.u), r = at.off_axis.norm();
  const double shadow2 = (s - height) * (s + height);
  if (!(shadow2 > 0) || !(r > 0)) return std::nullopt;
  const double shadow = std::sqrt(shadow2), along = (l * l - shadow2 + r * r) / (2 * r);
  const double off2 = (l - along) * (l + along);
  if (!(off2 >= 0)) return std::nullopt;
  const Vector3d R = along * at.z + sideOf(leg) * std::sqrt(off2) * at.x;
  const Vector3d rod = at.off_axis - R;
  const double phi = std::atan2(-R.dot(frame.col(0)), R.dot(frame.col(2)));
  return {{phi, std::atan2(-R.cross(rod).dot(at.u), R.dot(rod)), std::atan2(height, shadow)}};
}

/// The carriage is where the rail meets the sphere about B, before or behind B's foot on the rail.
Geometry ofCarriage(const Leg& leg, const Matrix3d& frame, const Place& at) {
  const double s = leg.distal.length, r = at.off_axis.norm();
  const double along2 = (s - r) * (s + r);
  if (!(along2 >= 0) || !(r > 0)) return std::nullopt;
  const double along = sideOf(leg) * std::sqrt(along2);
  const double psi = std::atan2(-at.z.dot(frame.col(0)), at.z.dot(frame.col(2)));
  return {{at.d.dot(at.u) - along, psi, std::atan2(r, along)}};
}

}  // namespace

void SimbodyLoop::Impl::addLeg(int leg) {
  chains.push_back(chainOf(parameters.leg(leg)));
  const LegChain& chain = chains.back();
  mechanism.proximal.push_back(addLink(chain, 0, matter.Ground()));
  mechanism.distal.push_back(addLink(chain, 1, mechanism.proximal.back()));
  mechanism.joints_of_proximal.push_back(chain.row.joints_of_proximal);
}

/// Adds a link with its mobilizer. The mobilizer's frames on both bodies have the same axes at zero: those of the
/// joints, completed to a frame.
SimTK::MobilizedBody SimbodyLoop::Impl::addLink(const LegChain& chain, int link, SimTK::MobilizedBody& parent) {
  const int first = chain.firstOf(link);
  const Vector3d& axis = chain.joint(first).axis;
  const bool is_universal = chain.jointsOf(link) == 2, slides = chain.slides(first);
  const Vector3d across = std::abs(axis.x()) > 0.5 ? Vector3d::UnitY() : Vector3d::UnitX();
  const Vector3d next = is_universal ? chain.joint(first + 1).axis : across;
  Matrix3d axes;
  if (is_universal || slides)
    axes << axis, next, axis.cross(next);
  else
    axes << next, axis.cross(next), axis;
  const Eigen::Isometry3d place = chain.place(first);
  const SimTK::Transform on_parent(toSimTK(Matrix3d(place.linear() * axes)), toSimTK(Vector3d(place.translation()))),
      on_child(toSimTK(axes));
  const SimTK::Body::Rigid body(massProperties(chain.links[link].mass, chain.centers[link], chain.links[link].inertia));
  if (is_universal) return SimTK::MobilizedBody::Universal(parent, on_parent, body, on_child);
  if (slides) return SimTK::MobilizedBody::Slider(parent, on_parent, body, on_child);
  return SimTK::MobilizedBody::Pin(parent, on_parent, body, on_child);
}

std::optional<std::array<double, 3>> legGeometry(const Leg& leg, const Matrix3d& frame, const Vector3d& d) {
  const Place at(frame, d);
  const LegKindRow& row = rowOf(leg.kind);
  if (row.joints_of_proximal == 2) return row.isTelescopic() ? ofTelescope(leg, frame, at) : ofKneed(leg, frame, at);
  return row.hasCarriage() ? ofCarriage(leg, frame, at) : ofCrank(leg, frame, at);
}

Matrix3d legJacobian(const LegChain& chain, const SimTK::State& state, const SimTK::MobilizedBody& first,
                     const SimTK::MobilizedBody& second, const Vector3d& from_A, const Vector3d& to_B) {
  Matrix3d J;
  for (int j = 0; j < 3; ++j) {
    const int link = chain.linkOf(j);
    // The parent carries the first axis of a universal joint.
    const bool on_parent = !chain.movesLink(j);
    const Vector3d on_body = on_parent ? chain.place(j).linear() * chain.joint(j).axis : chain.joint(j).axis;
    const SimTK::MobilizedBody& body = (link == 1 && !on_parent) ? second : first;
    const Vector3d axis = on_parent && link == 0 ? on_body : toEigen(body.getBodyRotation(state)) * on_body;
    J.col(j) = chain.slides(j) ? axis : axis.cross(link == 0 ? from_A : to_B);
  }
  return J;
}

}  // namespace ursula

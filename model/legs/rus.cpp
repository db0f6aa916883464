#include <cmath>

#include "base/scalar.h"
#include "model/legs/leg_type.h"

namespace ursula {
namespace {

/// The leg of crank and rod.
class Rus : public LegType {
 public:
  LegJoints joints(const Leg& leg) const override {
    return {
        {{-Vector3d::UnitY()}, {-Vector3d::UnitY(), leg.proximal.length * Vector3d::UnitZ()}, {-Vector3d::UnitX()}}};
  }

  /// Along û the leg appears as a triangle of crank l, rod c and r. φ is the angle nearest to zero.
  Vector3d coordinates(const Leg& leg, const Matrix3d& frame, const Vector3d& AB) const override {
    const Vector3d k = frame.transpose() * AB;
    const double l = leg.proximal.length, s = leg.distal.length, side = sideOf(leg);
    const double c = std::sqrt((s - k.y()) * (s + k.y())), r = std::hypot(k.x(), k.z());
    const double phi = std::atan2(-k.x(), k.z()) - side * angleOpposite(c, l, r);
    return {std::remainder(phi, 2 * pi), side * (pi - angleOpposite(r, l, c)), std::atan2(k.y(), c)};
  }

  /// Checks the distance from the crank's plane first, then the distance within it.
  Reach reach(const Leg& leg, const LegSpan& span) const override {
    const double l = leg.proximal.length, s = leg.distal.length;
    if (span.along > s)
      return {span.along, 0, s, "its platform point is", "m from its crank's plane, and its rod spans"};
    const double c = std::sqrt((s - span.along) * (s + span.along));
    return {span.across, std::abs(l - c), l + c, "its platform point is",
            "m from its crank's axis, and from there crank and rod span"};
  }

  double margin(const Leg& /*leg*/, const JointVariables<double>& q, int i) const override {
    return std::sin(q.psi(i));
  }
  const char* endOfReach(const JointVariables<double>& q, int i) const override {
    return std::cos(q.psi(i)) > 0 ? "stretched" : "folded";
  }

  /// Solves the triangle of URS in the view along the axis; the rod also spans the part along the axis.
  LinkLengths lengths(const LegSpan& span, double angle, double ratio) const override {
    const double c = sideOfTriangle(span.across, angle, ratio);
    return {ratio * c, std::hypot(c, span.along)};
  }

 private:
  const char* measuredFrom() const override { return "from its crank's axis"; }
};

}  // namespace

const LegType& rusLeg() {
  static const Rus type;
  return type;
}

}  // namespace ursula

#include <algorithm>

#include "base/scalar.h"
#include "model/legs/leg_type.h"

namespace ursula {
namespace {

/// The telescopic leg: universal joint, cylinder, rod.
class Ups : public LegType {
 public:
  LegJoints joints(const Leg& leg) const override {
    return {{{-Vector3d::UnitZ(), Vector3d::Zero(), z_to_axis},
             {Vector3d::UnitX()},
             {Vector3d::UnitZ(), -leg.distal.length * Vector3d::UnitZ()}}};
  }

  Vector3d coordinates(const Leg& /*leg*/, const Matrix3d& frame, const Vector3d& AB) const override {
    const auto [phi, psi] = directionOf(frame, AB);
    return {phi, psi, AB.norm()};
  }

  Reach reach(const Leg& leg, const LegSpan& span) const override {
    const double l = leg.proximal.length, s = leg.distal.length;
    return {span.distance, s, l + s, "its base and platform points are", "m apart, and its cylinder and rod span"};
  }

  /// Returns the distance of the rod's inner end from the nearer end of the cylinder, m.
  double margin(const Leg& leg, const JointVariables<double>& q, int i) const override {
    const double out = q.d(i) - leg.distal.length;
    return std::min(out, leg.proximal.length - out);
  }
  const char* endOfReach(const JointVariables<double>& /*q*/, int /*i*/) const override {
    return "at the end of its stroke";
  }

  const char* firstAxis() const override { return "base axis of its universal joint"; }
  const char* firstAngle() const override { return "leg's"; }

  /// Uses the middle 70 % of the stroke.
  LinkLengths lengths(const LegSpan& span, double angle, double ratio) const override {
    return lengthsAtStroke(span.distance, 0.15 + 0.7 * (angle / degree - 20) / 140, ratio);
  }
  bool folds() const override { return false; }
};

}  // namespace

/// d = s + f l, where f is the used share of the stroke.
LinkLengths lengthsAtStroke(double distance, double share, double ratio) {
  const double s = distance / (1 + share * ratio);
  return {ratio * s, s};
}

const LegType& upsLeg() {
  static const Ups type;
  return type;
}

}  // namespace ursula

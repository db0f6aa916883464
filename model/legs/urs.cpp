#include <cmath>

#include "base/scalar.h"
#include "model/legs/leg_type.h"

namespace ursula {
namespace {

/// The paper's leg: universal joint, proximal link, knee, distal link.
class Urs : public LegType {
 public:
  /// At θ = 0 the distal link is folded back onto the proximal one.
  LegJoints joints(const Leg& leg) const override {
    return {{{-Vector3d::UnitZ(), Vector3d::Zero(), z_to_axis},
             {Vector3d::UnitX()},
             {Vector3d::UnitX(), leg.proximal.length * Vector3d::UnitZ(), half_turn}}};
  }

  /// A triangle of l, s and |AB| in the plane of û and B.
  Vector3d coordinates(const Leg& leg, const Matrix3d& frame, const Vector3d& AB) const override {
    const double l = leg.proximal.length, s = leg.distal.length, q = AB.norm(), side = sideOf(leg);
    const auto [phi, psi] = directionOf(frame, AB);
    return {phi, psi + side * angleOpposite(s, l, q), side * angleOpposite(q, l, s)};
  }

  Reach reach(const Leg& leg, const LegSpan& span) const override {
    const double l = leg.proximal.length, s = leg.distal.length;
    return {span.distance, std::abs(l - s), l + s, "its base and platform points are",
            "m apart, and its two links span"};
  }

  double margin(const Leg& /*leg*/, const JointVariables<double>& q, int i) const override {
    return std::sin(q.theta(i));
  }
  const char* endOfReach(const JointVariables<double>& q, int i) const override {
    return std::cos(q.theta(i)) < 0 ? "stretched" : "folded";
  }

  /// |AB|² = l² + s² − 2 l s cos γ, where γ is the angle at the knee.
  LinkLengths lengths(const LegSpan& span, double angle, double ratio) const override {
    const double s = sideOfTriangle(span.distance, angle, ratio);
    return {ratio * s, s};
  }
};

}  // namespace

const LegType& ursLeg() {
  static const Urs type;
  return type;
}

}  // namespace ursula

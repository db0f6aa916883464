#include <fmt/format.h>

#include <cmath>

#include "base/scalar.h"
#include "model/legs/leg_type.h"

namespace ursula {
namespace {

/// s sin θ is the distance of B from the rail; the carriage's length is for drawing only.
LinkLengths rodAt(double theta, double across, double ratio) {
  const double s = across / std::sin(theta);
  return {0.3 * ratio * s, s};
}

/// The leg of carriage and rod.
class Pus : public LegType {
 public:
  LegJoints joints(const Leg& /*leg*/) const override {
    return {{{Vector3d::UnitY()}, {-Vector3d::UnitZ(), Vector3d::Zero(), z_to_axis}, {Vector3d::UnitX()}}};
  }

  /// The rail meets the sphere of radius s about B; with a positive knee the carriage is behind B.
  Vector3d coordinates(const Leg& leg, const Matrix3d& frame, const Vector3d& AB) const override {
    const Vector3d k = frame.transpose() * AB;
    const double s = leg.distal.length, r = std::hypot(k.x(), k.z());
    const double ahead = sideOf(leg) * std::sqrt((s - r) * (s + r));
    return {k.y() - ahead, std::atan2(-k.x(), k.z()), std::atan2(r, ahead)};
  }

  Reach reach(const Leg& leg, const LegSpan& span) const override {
    return {span.across, 0, leg.distal.length, "its platform point is", "m from its rail, and its rod spans"};
  }

  DeadCentre deadCentre(const Reach& reach) const override {
    return {"has its rod across its rail",
            fmt::format("its platform point is {:.6g} m from the rail, {:.3g} m less than the rod is long, and there "
                        "its carriage's speed is not determined",
                        reach.distance, reach.most - reach.distance)};
  }

  double margin(const Leg& /*leg*/, const JointVariables<double>& q, int i) const override {
    return std::cos(q.theta(i));
  }
  const char* endOfReach(const JointVariables<double>& /*q*/, int /*i*/) const override { return "across its rail"; }

  const char* firstAxis() const override { return "rail of its carriage"; }
  const char* firstAngle() const override { return "rod's"; }
  const char* bends() const override { return "rod"; }
  const char* atDeadCentre() const override { return "across its rail"; }

  /// Places the rod at 20° to 70° to its rail.
  LinkLengths lengths(const LegSpan& span, double angle, double ratio) const override {
    return rodAt(20 * degree + (angle - 20 * degree) * 50 / 140, span.across, ratio);
  }
  bool folds() const override { return false; }
  std::optional<LinkLengths> lengthsAtDeadCentre(const LegSpan& span, double angle) const override {
    return rodAt(pi / 2 - angle, span.across, 1);
  }
};

}  // namespace

const LegType& pusLeg() {
  static const Pus type;
  return type;
}

}  // namespace ursula

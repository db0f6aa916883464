#include "parts/exchange/leg_pose.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>

#include "model/legs/leg_type.h"

namespace ursula::exchange {
namespace {

/// √eps: a smaller sine has no correct digit left.
const double smallest_sine = std::sqrt(Eigen::NumTraits<double>::epsilon());

[[noreturn]] void refusePose(int index, const char* what, double value, const char* unit, const std::string& expected) {
  throw UnreachablePose(fmt::format("leg {} {} {}{}, expected {}", index + 1, what, value, unit, expected));
}

/// The sine is that of the solid angle between the tip's velocities at each joint's rate alone.
void requireRegular(const LegPose& pose, int index) {
  double sizes = 1;
  for (int j = 0; j < 3; ++j) sizes *= pose.at.J.col(j).norm();
  const double sine = std::abs(pose.at.J.determinant()) / sizes;
  if (!(sine > smallest_sine))
    refusePose(index, "is singular: its joints move the tip in one plane, sine", sine, "",
               fmt::format("one above {}", smallest_sine));
}

}  // namespace

LegPose legPose(const Leg& leg, int index, const Vector3d& tip) {
  const Vector3d AB = tip - leg.base_point;
  LegPose out{chainOf(leg), {}, {}};
  const LegSpan span = spanOf(out.chain.frame.col(1), AB);
  if (!(span.across > smallest_sine * AB.norm()))
    refusePose(index, "has the platform's point on its axis, distance", span.across, " m", "> 0 m");
  const auto q = coordinatesAt(leg, out.chain.frame, AB);
  if (!q) {
    const Reach reach = typeOf(leg.kind).reach(leg, span);
    refusePose(index, "would have to reach over", reach.distance, " m",
               fmt::format("{} to {} m", reach.least, reach.most));
  }
  out.q = *q;
  out.at = placed(out.chain, out.q);
  requireRegular(out, index);
  return out;
}

}  // namespace ursula::exchange

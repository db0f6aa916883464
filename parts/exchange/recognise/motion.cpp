#include "parts/exchange/recognise/machine.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/scalar.h"
#include "model/legs/leg_type.h"
#include "parts/exchange/leg_pose.h"
#include "parts/exchange/recognise/legs.h"

namespace ursula::exchange {
namespace {

constexpr int waypoint_count = 13, tried_per_motion = 97;
constexpr double least_regular = 1e-5;  // below it rounding hides the sign
constexpr double regular_enough = 1e-3;
constexpr double duration = 3.0;  // s, as for the paper's helix

/// A helix about a vertical axis through p + r [−cos γ, −sin γ, 0]: half a turn that rises by one radius.
struct SmallHelix {
  double radius = 0, start = 0, rise = 1;

  Vector3d offset(double share) const {
    const double s = share * share * share * (10 - 15 * share + 6 * share * share);  // at rest at both ends
    const double turn = pi * s;
    return radius *
           Vector3d(std::cos(start + turn) - std::cos(start), std::sin(start + turn) - std::sin(start), rise * s);
  }
};

Motion<double> poseAt(const ImportedMachine& machine, const SmallHelix& helix, double share) {
  Motion<double> out = machine.initial;
  out.t = duration * share;
  out.p += helix.offset(share);
  return out;
}

/// Returns the margin of a triangle's third side; at either end the triangle is stretched or folded.
double within(double least, double value, double most) {
  return std::min(value - least, most - value) / (most - least);
}

/// Returns the share of a leg's range, up to 1, that is left at a pose of M in B. It is not positive if the leg cannot
/// take the pose.
double reserveOf(const Leg& leg, const Motion<double>& pose) {
  const LegKindRow& row = rowOf(leg.kind);
  const Vector3d AB = pose.p + pose.Q * leg.platform_point - leg.base_point;
  const LegSpan span = spanOf(leg.base_axis, AB);
  const Reach reach = typeOf(leg.kind).reach(leg, span);
  const double own = within(reach.least, reach.distance, reach.most);
  if (row.joints_of_proximal == 2)
    return std::min(own, span.across / (span.distance + span.across));  // distance from the first axis
  return row.hasCarriage() ? own : std::min(own, 1 - span.along / leg.distal.length);
}

double reserveOf(const ImportedMachine& machine, const Motion<double>& pose, std::size_t& worst) {
  double least = 1;
  for (std::size_t i = 0; i < machine.legs.size(); ++i) {
    const double own = reserveOf(machine.legs[i], pose);
    if (own <= least) worst = i;
    least = std::min(least, own);
  }
  return least;
}

/// Returns the rates of the driven coordinates for velocities of P, scaled by `size`, and for rotations of the
/// platform.
Matrix6d driveMap(const ImportedMachine& machine, const Motion<double>& pose, double size) {
  Matrix6d out = Matrix6d::Zero();
  int row = 0;
  for (std::size_t i = 0; i < machine.legs.size(); ++i) {
    const ImportedLeg& leg = machine.legs[i];
    const Vector3d arm = pose.Q * leg.platform_point;
    const LegPose at = legPose(leg, static_cast<int>(i), pose.p + arm);
    Eigen::Matrix<double, 3, 6> tip;
    for (int k = 0; k < 3; ++k) tip.col(k) = size * Vector3d::Unit(k), tip.col(3 + k) = Vector3d::Unit(k).cross(arm);
    const Eigen::Matrix<double, 3, 6> rates = at.at.J.inverse() * tip;
    for (int k = 0; k < 3; ++k)
      if (leg.actuated[k] && row < 6) out.row(row++) = rates.row(k) / (at.chain.slides(k) ? size : 1);
  }
  return out;
}

/// Returns the distance from singularity: the smallest singular value over the largest, with the determinant's sign.
double regularity(const ImportedMachine& machine, const Motion<double>& pose, double size) {
  try {
    const Matrix6d map = driveMap(machine, pose, size);
    const Eigen::JacobiSVD<Matrix6d> svd(map);
    return (map.determinant() < 0 ? -1 : 1) * svd.singularValues()(5) / svd.singularValues()(0);
  } catch (const UnreachablePose&) {  // one leg alone is singular
    return 0;
  }
}

double reserveOf(const ImportedMachine& machine, const SmallHelix& helix, double size) {
  double least = 1;
  std::size_t worst = 0;
  const double at_start = regularity(machine, machine.initial, size);
  for (int k = 0; k < tried_per_motion && least > 0; ++k) {
    const Motion<double> pose = poseAt(machine, helix, k / (tried_per_motion - 1.0));
    least = std::min(least, reserveOf(machine, pose, worst));
    if (least > 0 && std::abs(at_start) > least_regular && !(regularity(machine, pose, size) / at_start > 0.3))
      return 0;
  }
  return least;
}

/// Turns the initial pose by a few degrees, because many symmetric hexapods are singular where they are level.
void turnFromSingular(ImportedMachine& machine, double size) {
  const Motion<double> given = machine.initial;
  for (const double angle : {0.1, -0.1, 0.2, -0.2})
    for (const int axis : {2, 0, 1}) {
      Motion<double> turned = given;
      turned.Q = Eigen::AngleAxisd(angle, Vector3d::Unit(axis)) * given.Q;
      std::size_t worst = 0;
      if (!(reserveOf(machine, turned, worst) > 0.05) ||
          !(std::abs(regularity(machine, turned, size)) > regular_enough))
        continue;
      machine.initial = turned;
      machine.assumptions.push_back(
          {fmt::format("The motion starts turned by this about the {} axis of B", "xyz"[axis]), machine.platform, angle,
           "rad"});
      return;
    }
}

}  // namespace

void proposeMotion(ImportedMachine& machine, double size) {
  std::size_t worst = 0;
  const double at_start = reserveOf(machine, machine.initial, worst);
  if (!(at_start > 0))
    throw ImportError(
        fmt::format("the leg of {} cannot take the file's initial pose (its range is exceeded by {:.3g} of it), "
                    "expected a model whose loops are closed there",
                    machine.legs[worst].joints, -at_start));
  if (const double regular = std::abs(regularity(machine, machine.initial, size)); !(regular > least_regular)) {
    machine.assumptions.push_back({"The file's initial pose is singular, or nearly so: efforts there say little",
                                   machine.platform, regular, "1"});
    turnFromSingular(machine, size);
  }
  SmallHelix best;
  for (double radius = size / 20; best.radius == 0 && radius > 1e-6 * size; radius /= 2) {
    double most = std::min(0.02, at_start / 2);
    for (const double start : {0.0, pi / 2, pi, 3 * pi / 2})
      for (const double rise : {1.0, -1.0}) {
        const double reserve = reserveOf(machine, SmallHelix{radius, start, rise}, size);
        if (reserve > most) {
          most = reserve;
          best = {radius, start, rise};
        }
      }
  }
  if (best.radius == 0)
    throw ImportError(
        fmt::format("no motion starts at the file's initial pose: the leg of {} is at the end of its range there, or a "
                    "singular pose is near, expected another pose",
                    machine.legs[worst].joints));
  machine.motion_radius = best.radius;
  for (int k = 0; k < waypoint_count; ++k) machine.motion.push_back(poseAt(machine, best, k / (waypoint_count - 1.0)));
}

}  // namespace ursula::exchange

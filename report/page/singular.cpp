#include "report/page/singular.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/dense.h"

namespace ursula::report {
namespace {

/// A leg's effect on its point B at one instant.
struct LegAtInstant {
  Vector3d B, normal;  ///< `normal` is the direction of the force at B that the locked motor can resist
  double advance = 0;  ///< advance of B along `normal` per unit rate of the motor, m
};

/// Velocities of B per unit rates of the joints before it: the motor's, then the passive ones. Empty if their number
/// differs.
std::vector<Vector3d> velocitiesOfB(const Picture::Leg& leg, std::size_t k) {
  const Vector3d B = leg.links.back().to[k];
  std::vector<Vector3d> motor, passive;
  for (const Picture::Joint& joint : leg.joints)
    for (std::size_t i = 0; i < joint.axes.size(); ++i)
      (joint.driven && i == 0 ? motor : passive)
          .push_back(joint.slides ? joint.axes[i][k] : joint.axes[i][k].cross(B - joint.at[k]));
  if (motor.size() != 1 || passive.size() != 2) return {};
  return {motor[0], passive[0], passive[1]};
}

std::optional<LegAtInstant> legAt(const Picture::Leg& leg, std::size_t k) {
  const std::vector<Vector3d> velocities = velocitiesOfB(leg, k);
  if (velocities.empty()) return std::nullopt;
  const Vector3d normal = velocities[1].cross(velocities[2]);
  const double size = velocities[1].norm() * velocities[2].norm();
  if (!(normal.norm() > 1e-9 * size)) return std::nullopt;
  LegAtInstant out{leg.links.back().to[k], normal.normalized(), 0};
  out.advance = out.normal.dot(velocities[0]);
  return out;
}

std::optional<WeakDirections> weakAt(const Picture& picture, std::size_t k, double size) {
  Eigen::MatrixXd rows(picture.legs.size(), 6);
  WeakDirections out;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < picture.legs.size(); ++i) {
    const std::optional<LegAtInstant> leg = legAt(picture.legs[i], k);
    if (!leg) return std::nullopt;
    rows.row(static_cast<Eigen::Index>(i)) << (leg->B - picture.p[k]).cross(leg->normal).transpose() / size,
        leg->normal.transpose();
    if (std::abs(leg->advance) >= least) continue;
    least = std::abs(leg->advance);
    out.leg = i;
    out.lost = leg->normal;
  }
  out.yielding = rightSingularVectors(rows).col(5);
  return out;
}

/// The largest distance of a leg's platform point from P.
double sizeOf(const Picture& picture) {
  double size = 0;
  for (const Vector3d& point : picture.platform_points) size = std::max(size, point.norm());
  return size;
}

}  // namespace

std::optional<std::vector<WeakDirections>> weakDirections(const Picture& picture) {
  const double size = sizeOf(picture);
  if (picture.legs.empty() || picture.t.empty() || !(size > 0)) return std::nullopt;
  std::vector<WeakDirections> out;
  for (std::size_t k = 0; k < picture.t.size(); ++k) {
    std::optional<WeakDirections> weak = weakAt(picture, k, size);
    if (!weak) return std::nullopt;
    if (!out.empty() && out.back().yielding.dot(weak->yielding) < 0) weak->yielding = -weak->yielding;
    if (!out.empty() && out.back().leg == weak->leg && out.back().lost.dot(weak->lost) < 0) weak->lost = -weak->lost;
    out.push_back(*weak);
  }
  return out;
}

}  // namespace ursula::report

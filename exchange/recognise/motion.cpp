#include "exchange/recognise/motion.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>

#include "exchange/import_error.h"
#include "exchange/recognise/leg_numbers.h"

namespace ursula::exchange {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr int waypoint_count = 13, tried_per_motion = 97;
constexpr double least_regular = 1e-5;  // below it differences tell nothing of the way out
constexpr double duration = 3.0;        // s, as the paper's helix is taken to have

/// A helix about an upright axis through p + r [−cos γ, −sin γ, 0]: half a turn, rising by a radius.
struct SmallHelix {
  double radius = 0, start = 0, rise = 1;

  Vector3d offset(double share) const {
    const double s = share * share * share * (10 - 15 * share + 6 * share * share);  // at rest at both ends
    const double turn = pi * s;
    return radius *
           Vector3d(std::cos(start + turn) - std::cos(start), std::sin(start + turn) - std::sin(start), rise * s);
  }
};

ImportedPose poseAt(const ImportedMachine& machine, const SmallHelix& helix, double share) {
  return {duration * share, machine.initial.position + helix.offset(share), machine.initial.orientation};
}

double reserveOf(const ImportedMachine& machine, const ImportedPose& pose, std::size_t& worst) {
  double least = 1;
  for (std::size_t i = 0; i < machine.legs.size(); ++i) {
    const double own = ursula::exchange::reserveOf(machine.legs[i], pose);
    if (own <= least) worst = i;
    least = std::min(least, own);
  }
  return least;
}

/// A leg's coordinates in the order of its kind, by the table of docs/legs.md.
std::array<double, 3> coordinatesOf(const ImportedLeg& leg, const ImportedPose& pose) {
  const Vector3d AB = pose.position + pose.orientation * leg.platform_point - leg.base_point;
  const Vector3d k = fixedFrame(leg.base_axis).transpose() * AB;
  const double l = leg.proximal.length, s = leg.distal.length, side = leg.knee_positive ? 1 : -1;
  const double r = std::hypot(k.x(), k.z()), plane = std::atan2(-k.x(), k.z()), q = k.norm();
  switch (leg.kind) {
    case LegKind::UPS:
      return {plane, std::atan2(r, k.y()), q};
    case LegKind::URS: {
      const double theta = side * std::acos((l * l + s * s - q * q) / (2 * l * s));
      return {plane, std::atan2(s * std::sin(theta), l - s * std::cos(theta)) + std::atan2(r, k.y()), theta};
    }
    case LegKind::RUS: {
      const double c = std::sqrt((s - k.y()) * (s + k.y()));
      const double phi = plane - side * std::acos((l * l + r * r - c * c) / (2 * l * r));
      return {phi, side * std::acos((r * r - l * l - c * c) / (2 * l * c)), std::asin(k.y() / s)};
    }
    case LegKind::PUS:
      break;
  }
  const double ahead = side * std::sqrt((s - r) * (s + r));
  return {k.y() - ahead, plane, std::acos(ahead / s)};
}

/// How the driven coordinates move with the platform, lengths over `size`, by central differences.
Matrix6d driveMap(const ImportedMachine& machine, const ImportedPose& pose, double size) {
  constexpr double step = 1e-6;
  Matrix6d out;
  for (int column = 0; column < 6; ++column) {
    std::array<ImportedPose, 2> moved = {pose, pose};
    for (const int end : {0, 1}) {
      const double by = end == 0 ? -step : step;
      if (column < 3)
        moved[static_cast<std::size_t>(end)].position(column) += by * size;
      else
        moved[static_cast<std::size_t>(end)].orientation =
            Eigen::AngleAxisd(by, Vector3d::Unit(column - 3)) * pose.orientation;
    }
    int row = 0;
    for (const ImportedLeg& leg : machine.legs) {
      const auto before = coordinatesOf(leg, moved[0]), after = coordinatesOf(leg, moved[1]);
      for (std::size_t k = 0; k < 3; ++k) {
        if (!leg.actuated[k] || row == 6) continue;
        const bool is_length = slides(rowOf(leg.kind).coordinates[k]);
        const double moves = after[k] - before[k];
        out(row++, column) = (is_length ? moves / size : std::remainder(moves, 2 * pi)) / (2 * step);
      }
    }
  }
  return out;
}

/// How far from singular: the least singular value over the largest, with the sign of the determinant.
double regularity(const ImportedMachine& machine, const ImportedPose& pose, double size) {
  const Matrix6d map = driveMap(machine, pose, size);
  const Eigen::JacobiSVD<Matrix6d> svd(map);
  return (map.determinant() < 0 ? -1 : 1) * svd.singularValues()(5) / svd.singularValues()(0);
}

double reserveOf(const ImportedMachine& machine, const SmallHelix& helix, double size) {
  double least = 1;
  std::size_t worst = 0;
  const double at_start = regularity(machine, machine.initial, size);
  for (int k = 0; k < tried_per_motion && least > 0; ++k) {
    const ImportedPose pose = poseAt(machine, helix, k / (tried_per_motion - 1.0));
    least = std::min(least, reserveOf(machine, pose, worst));
    if (least > 0 && std::abs(at_start) > least_regular && !(regularity(machine, pose, size) / at_start > 0.3))
      return 0;
  }
  return least;
}

/// Between two lengths a triangle's third side is at either end stretched or folded.
double within(double least, double value, double most) {
  return std::min(value - least, most - value) / (most - least);
}

}  // namespace

double reserveOf(const ImportedLeg& leg, const ImportedPose& pose) {
  const Vector3d u = leg.base_axis, AB = pose.position + pose.orientation * leg.platform_point - leg.base_point;
  const double l = leg.proximal.length, s = leg.distal.length;
  const double along = AB.dot(u), distance = (AB - along * u).norm();
  const double off_axis = distance / (AB.norm() + distance);
  switch (leg.kind) {
    case LegKind::UPS:
      return std::min(within(s, AB.norm(), s + l), off_axis);
    case LegKind::URS:
      return std::min(within(std::abs(l - s), AB.norm(), l + s), off_axis);
    case LegKind::RUS: {
      if (!(std::abs(along) < s)) return -1;
      const double c = std::sqrt((s - along) * (s + along));
      return std::min(within(std::abs(l - c), distance, l + c), 1 - std::abs(along) / s);
    }
    case LegKind::PUS:
      break;
  }
  return std::min(1 - distance / s, distance / s);
}

void proposeMotion(ImportedMachine& machine, double size) {
  std::size_t worst = 0;
  const double at_start = reserveOf(machine, machine.initial, worst);
  if (!(at_start > 0))
    throw ImportError(
        fmt::format("the leg of {} cannot take the file's initial pose (its range is exceeded by {:.3g} of "
                    "it), expected a model whose loops are closed there",
                    machine.legs[worst].joints, -at_start));
  if (const double regular = std::abs(regularity(machine, machine.initial, size)); !(regular > least_regular))
    machine.assumptions.push_back({"The file's initial pose is singular, or nearly so: efforts there say little",
                                   machine.platform, regular, "1"});
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

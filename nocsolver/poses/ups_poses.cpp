#include "nocsolver/poses/ups_poses.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "nocsolver/poses/direct_kinematics.h"
#include "nocsolver/poses/ups_poses_newton.h"
#include "nocsolver/poses/ups_poses_roots.h"

namespace ursula {
namespace {

using Points = std::array<Vector3d, 6>;

Vector3d centre(const Points& points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& point : points) sum += point;
  return sum / 6;
}

void requireFinite(const Points& base_points, const Points& platform_points, const Vector6d& lengths) {
  for (const Points* points : {&base_points, &platform_points})
    for (const Vector3d& point : *points)
      if (!point.allFinite()) throw std::invalid_argument("joints' coordinates must be finite");
  if (!lengths.allFinite() || !(lengths.minCoeff() >= 0))
    throw std::invalid_argument("lengths of legs must be finite and not negative");
}

/// The machine with its points relative to their centres in base and platform, in units of its mean length.
struct Centred {
  ups::Legs legs;
  Vector3d a, b;
  double unit = 0;

  Centred(const Points& base_points, const Points& platform_points, const Vector6d& lengths)
      : a(centre(base_points)), b(centre(platform_points)) {
    double sum = lengths.squaredNorm();
    for (std::size_t i = 0; i < 6; ++i)
      sum += (base_points[i] - a).squaredNorm() + (platform_points[i] - b).squaredNorm();
    unit = std::sqrt(sum / 6);
    if (!(unit > 0) || !std::isfinite(unit)) throw UndeterminedPose("the size of the machine, m", unit, 0);
    for (std::size_t i = 0; i < 6; ++i) {
      legs.a[i] = (base_points[i] - a) / unit;
      legs.b[i] = (platform_points[i] - b) / unit;
    }
    legs.d = lengths / unit;
    requireOrientation();
  }

 private:
  /// Distant base points determine the orientation poorly. The terms aᵢᵀ Q bᵢ of the squared lengths must keep half of
  /// the digits.
  void requireOrientation() const {
    double of_base = 0, of_platform = 0;
    for (std::size_t i = 0; i < 6; ++i) {
      of_base += legs.a[i].squaredNorm() / 6;
      of_platform += legs.b[i].squaredNorm() / 6;
    }
    const double spread = std::sqrt(of_base * of_platform), least = std::sqrt(Eigen::NumTraits<double>::epsilon());
    if (!(spread >= least))
      throw UndeterminedPose("joints too close for legs so long, product of their spreads", spread, least);
  }
};

Eigen::Vector4d withPositiveW(const Eigen::Vector4d& q) {
  for (int k = 0; k < 4; ++k)
    if (q(k) != 0) return q(k) < 0 ? Eigen::Vector4d(-q) : q;
  return q;
}

bool listedBefore(const UpsPose& a, const UpsPose& b) {
  const auto key = [](const UpsPose& pose) {
    return std::tuple(-pose.q(0), -pose.q(1), -pose.q(2), -pose.q(3), pose.p(0), pose.p(1), pose.p(2));
  };
  return key(a) < key(b);
}

/// Falls back on tracking paths if the ring fails.
ups::Roots allRoots(const ups::Legs& legs) {
  ups::Roots ring = ups::findRoots(legs);
  if (ring.complete()) return ring;
  ups::Roots tracked = ups::trackRoots(legs);
  if (tracked.free)
    throw UndeterminedPose("the legs leave the platform free to move, pivot ratio", ring.pivot, ups::smallestPivot());
  return tracked.all() > ring.all() ? tracked : ring;
}

}  // namespace

UpsPoses upsPoses(const Points& base_points, const Points& platform_points, const Vector6d& lengths) {
  requireFinite(base_points, platform_points, lengths);
  const Centred machine(base_points, platform_points, lengths);
  const ups::Roots roots = allRoots(machine.legs);

  UpsPoses out;
  out.counted = roots.counted;
  out.at_infinity = roots.at_infinity;
  for (const ups::Root& root : roots.list) {
    if (!root.real) continue;
    ups::Placed<double> placed{root.at.q.real(), root.at.p.real()};
    ups::polish<double>(machine.legs, placed);
    UpsPose pose;
    pose.q = withPositiveW(placed.q);
    pose.Q = ups::rotation<double>(pose.q);
    pose.p = machine.unit * placed.p + machine.a - pose.Q * machine.b;
    pose.multiplicity = root.multiplicity;
    for (std::size_t i = 0; i < 6; ++i) {
      const double distance = (pose.p + pose.Q * platform_points[i] - base_points[i]).norm();
      pose.residual = std::max(pose.residual, std::abs(distance - lengths(static_cast<Eigen::Index>(i))));
    }
    out.list.push_back(pose);
  }
  std::sort(out.list.begin(), out.list.end(), listedBefore);
  return out;
}

bool isStewartGough(const Manipulator& machine) {
  const std::vector<Leg>& legs = machine.parameters().legs;
  return legs.size() == leg_count && std::all_of(legs.begin(), legs.end(), [](const Leg& leg) {
           return leg.kind == LegKind::UPS && leg.actuated == std::array<bool, 3>{false, false, true};
         });
}

UpsPoses upsPoses(const Manipulator& machine, const Vector6d& lengths) {
  Points base, platform;
  for (std::size_t i = 0; i < leg_count; ++i) {
    base[i] = machine.leg(static_cast<int>(i)).base_point;
    platform[i] = machine.leg(static_cast<int>(i)).platform_point;
  }
  return upsPoses(base, platform, lengths);
}

int beyondStroke(const Manipulator& machine, const Vector6d& lengths) {
  for (int i = 0; i < leg_count; ++i) {
    const double s = machine.leg(i).distal.length, l = machine.leg(i).proximal.length;
    if (!(lengths(i) > s && lengths(i) < s + l)) return i;
  }
  return -1;
}

}  // namespace ursula

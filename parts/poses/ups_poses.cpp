#include "parts/poses/ups_poses.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "model/quaternions.h"
#include "nocsolver/legs/fixed_frame.h"
#include "parts/poses/direct_kinematics.h"
#include "parts/poses/ups_poses_parts.h"

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

/// Whether a leg of the kind keeps its platform point on a sphere while its motor holds.
bool holdsSphere(LegKind kind) { return kind == LegKind::UPS || kind == LegKind::RUS || kind == LegKind::PUS; }

/// The sphere of a leg's platform point while its motor holds, and the fixed frame of (2a).
struct Sphere {
  Vector3d centre, x_hat, u, z_hat;
  double radius = 0;

  Sphere(const Leg& leg, double driven) : centre(leg.base_point), radius(leg.distal.length) {
    setFixedFrame<double>(leg.base_axis, x_hat, u, z_hat);
    if (leg.kind == LegKind::UPS) radius = driven;
    if (leg.kind == LegKind::RUS) centre += leg.proximal.length * (std::cos(driven) * z_hat - std::sin(driven) * x_hat);
    if (leg.kind == LegKind::PUS) centre += driven * u;
  }
};

bool isWithinStroke(const Leg& leg, double d) {
  return d > leg.distal.length && d < leg.distal.length + leg.proximal.length;
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

bool tipsAreOnSpheres(const Manipulator& machine) {
  const std::vector<Leg>& legs = machine.parameters().legs;
  return legs.size() == leg_count && std::all_of(legs.begin(), legs.end(), [](const Leg& leg) {
           return holdsSphere(leg.kind) && std::count(leg.actuated.begin(), leg.actuated.end(), true) == 1 &&
                  leg.actuated[rowOf(leg.kind).actuated];
         });
}

UpsPoses upsPoses(const Manipulator& machine, const Vector6d& driven) {
  Points centres, platform;
  Vector6d radii;
  for (int i = 0; i < leg_count; ++i) {
    const Sphere sphere(machine.leg(i), driven(i));
    centres[i] = sphere.centre;
    platform[i] = machine.leg(i).platform_point;
    radii(i) = sphere.radius;
  }
  return upsPoses(centres, platform, radii);
}

bool isOnItsBranch(const Leg& leg, double driven, const UpsPose& pose) {
  if (leg.kind == LegKind::UPS) return isWithinStroke(leg, driven);
  const Sphere sphere(leg, driven);
  const Vector3d along = pose.p + pose.Q * leg.platform_point - sphere.centre;
  // The sign of cos θ, or of sin ψ, where φ + ψ is the rod's angle about −û.
  const double side = leg.kind == LegKind::PUS
                          ? along.dot(sphere.u)
                          : std::sin(std::atan2(-along.dot(sphere.x_hat), along.dot(sphere.z_hat)) - driven);
  return leg.knee == Knee::positive ? side > 0 : side < 0;
}

int beyondStroke(const Manipulator& machine, const Vector6d& driven) {
  for (int i = 0; i < leg_count; ++i)
    if (machine.leg(i).kind == LegKind::UPS && !isWithinStroke(machine.leg(i), driven(i))) return i;
  return -1;
}

}  // namespace ursula

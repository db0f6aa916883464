// Each kind of leg in MuJoCo: its joints, and its coordinates at a pose.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <stdexcept>

#include "base/scalar.h"
#include "engines/mujoco/mujoco_loop_internal.h"

namespace ursula::mujoco {
namespace {

constexpr std::array<KindText, leg_kind_count> kind_texts = {{
    // URS: θ = 0 folds the leg, s = −e: half a turn about x.
    {R"(<joint axis="0 0 -1"/><joint axis="1 0 0"/>)", "0 1 0 0", R"(<joint axis="1 0 0"/>)"},
    {R"(<joint axis="0 0 -1"/><joint axis="1 0 0"/>)", "1 0 0 0", R"(<joint type="slide" axis="0 0 1"/>)"},
    {R"(<joint axis="0 -1 0"/>)", "1 0 0 0", R"(<joint axis="0 -1 0"/><joint axis="-1 0 0"/>)"},
    // PUS: θ = 0 lays the rod along u, the carriage's y: a quarter turn about −x.
    {R"(<joint type="slide" axis="0 1 0"/>)", "1 -1 0 0", R"(<joint axis="0 0 -1"/><joint axis="1 0 0"/>)"},
}};

/// A leg's joints at a pose: AB in the frame where its model's coordinates are zero.
class JointsAt {
 public:
  JointsAt(const Leg& leg, int index, const Motion<double>& motion)
      : l_(leg.proximal.length),
        s_(leg.distal.length),
        side_(leg.knee == Knee::positive ? 1 : -1),
        kind_(leg.kind),
        index_(index),
        t_(motion.t),
        AB_(motion.p + motion.Q * leg.platform_point - leg.base_point),
        zero_(frameAtZero(leg)) {}

  Vector3d coordinates() const {
    switch (kind_) {
      case LegKind::URS:
        return urs();
      case LegKind::UPS:
        return ups();
      case LegKind::RUS:
        return rus();
      case LegKind::PUS:
        break;
    }
    return pus();
  }

 private:
  void requireReach(bool reaches, double distance) const {
    if (!reaches)
      throw std::domain_error(fmt::format("leg {} cannot reach over {} m at t = {} s", index_ + 1, distance, t_));
  }

  /// Returns the angle about −u from the frame's zero, the angle between u and AB, and 0.
  Vector3d universal() const {
    const Vector3d u = zero_.col(2), across = u.cross(AB_);
    return {std::atan2(-across.dot(zero_.col(1)), across.dot(zero_.col(0))), std::atan2(across.norm(), u.dot(AB_)), 0};
  }

  Vector3d urs() const {
    const double q = AB_.norm();
    requireReach(q <= l_ + s_ && q >= std::abs(l_ - s_), q);
    const Vector3d towards_B = universal();
    return {towards_B(0), towards_B(1) + side_ * angleOpposite(s_, l_, q), side_ * angleOpposite(q, l_, s_)};
  }

  Vector3d ups() const {
    const double d = AB_.norm();
    requireReach(s_ < d && d < s_ + l_, d);
    const Vector3d towards_B = universal();
    return {towards_B(0), towards_B(1), d};
  }

  /// Along u the leg appears as a triangle of crank l, rod c and r.
  Vector3d rus() const {
    const Vector3d k = zero_.transpose() * AB_;
    requireReach(std::abs(k.y()) < s_, std::abs(k.y()));
    const double c = std::sqrt((s_ - k.y()) * (s_ + k.y())), r = std::hypot(k.x(), k.z());
    requireReach(r <= l_ + c && r >= std::abs(l_ - c), r);
    return {std::atan2(-k.x(), k.z()) - side_ * angleOpposite(c, l_, r), side_ * (pi - angleOpposite(r, l_, c)),
            std::atan2(k.y(), c)};
  }

  Vector3d pus() const {
    const Vector3d k = zero_.transpose() * AB_;
    const double r = std::hypot(k.x(), k.z());
    requireReach(r <= s_, r);
    const double ahead = side_ * std::sqrt((s_ - r) * (s_ + r));
    return {k.y() - ahead, std::atan2(-k.x(), k.z()), std::atan2(r, ahead)};
  }

  double l_, s_, side_;
  LegKind kind_;
  int index_;
  double t_;
  Vector3d AB_;
  Matrix3d zero_;
};

}  // namespace

const KindText& textOf(LegKind kind) { return kind_texts[static_cast<std::size_t>(kind)]; }

Vector3d coordinatesOf(const Leg& leg, int index, const Motion<double>& motion) {
  return JointsAt(leg, index, motion).coordinates();
}

Matrix3d frameAtZero(const Leg& leg) {
  const Vector3d u = leg.base_axis.normalized();
  Matrix3d frame;
  if (rowOf(leg.kind).joints_of_proximal == 2) {
    const Vector3d x = u.unitOrthogonal();
    frame << x, u.cross(x), u;
    return frame;
  }
  const Vector3d level = u.cross(Vector3d::UnitZ());
  const Vector3d x = level.norm() < 1e-10 ? u.cross(Vector3d::UnitY()).normalized() : level.normalized();
  frame << x, u, x.cross(u);
  return frame;
}

}  // namespace ursula::mujoco

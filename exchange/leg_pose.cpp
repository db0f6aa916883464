#include "exchange/leg_pose.h"

#include <fmt/format.h>

#include <cmath>

#include "base/scalar.h"

namespace ursula::exchange {
namespace {

/// √eps: a smaller sine has no correct digit left.
const double smallest_sine = std::sqrt(Eigen::NumTraits<double>::epsilon());

Eigen::Isometry3d frameAlong(const Vector3d& x, const Vector3d& along, const Vector3d& origin) {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() << x, along.cross(x), along;
  out.translation() = origin;
  return out;
}

/// A leg in its fixed frame F̂ = [x̂, û, ẑ], with k = F̂ᵀ(B − A) and the plane through û and B.
class Placing {
 public:
  Placing(const Leg& leg, int index, const Vector3d& tip)
      : leg_(leg),
        number_(index + 1),
        l_(leg.proximal.length),
        s_(leg.distal.length),
        side_(leg.knee == Knee::positive ? 1 : -1),
        A_(leg.base_point),
        AB_(tip - leg.base_point),
        u_(leg.base_axis.normalized()) {
    const Vector3d level = u_.cross(Vector3d::UnitZ());
    x_hat_ = level.norm() < 1e-10 ? u_.cross(Vector3d::UnitY()).normalized() : level.normalized();
    z_hat_ = x_hat_.cross(u_);
    k_ = {x_hat_.dot(AB_), u_.dot(AB_), z_hat_.dot(AB_)};
    r_ = std::hypot(k_.x(), k_.z());
    const double size = leg.kind == LegKind::PUS ? s_ : l_ + s_;
    if (!(r_ > smallest_sine * size)) refuse("has the platform's point on its axis, distance", r_, " m", "> 0 m");
    x_ = (k_.z() * x_hat_ - k_.x() * z_hat_) / r_;
    z_ = (k_.z() * z_hat_ + k_.x() * x_hat_) / r_;
    plane_ = std::atan2(-k_.x(), k_.z());
    out_.tip = tip;
  }

  LegPose pose() {
    switch (leg_.kind) {
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
  [[noreturn]] void refuse(const char* what, double value, const char* unit, const std::string& expected) const {
    throw UnreachablePose(fmt::format("leg {} {} {}{}, expected {}", number_, what, value, unit, expected));
  }
  void requireWithin(double distance, double low, double high, const char* what = "would have to reach over") const {
    if (!(low <= distance && distance <= high)) refuse(what, distance, " m", fmt::format("{} to {} m", low, high));
  }
  void requireBent(double sine, const char* what) const {
    if (!(std::abs(sine) > smallest_sine)) refuse(what, sine, "", fmt::format("a size above {}", smallest_sine));
  }
  void join(std::size_t k, const Vector3d& centre, const Vector3d& axis, double position) {
    out_.joints[k] = {rowOf(leg_.kind).coordinates[k], centre, axis, position};
  }

  LegPose urs() {
    const double q = AB_.norm();
    requireWithin(q, std::abs(l_ - s_), l_ + s_);
    const double theta = side_ * angleOpposite(q, l_, s_);
    requireBent(std::sin(theta), "is stretched or folded, sin theta");
    const double psi = std::atan2(r_, k_.y()) + side_ * angleOpposite(s_, l_, q);
    const Vector3d e = std::cos(psi) * u_ + std::sin(psi) * z_, R = A_ + l_ * e;
    join(0, A_, -u_, plane_);
    join(1, A_, x_, psi);
    join(2, R, x_, theta);
    return withLinks(frameAlong(x_, e, A_), frameAlong(x_, (out_.tip - R).normalized(), R), R);
  }

  LegPose ups() {
    const double d = AB_.norm();
    if (!(s_ < d && d < s_ + l_))
      refuse("is at the end of its stroke, d =", d, " m", fmt::format("between {} and {} m", s_, s_ + l_));
    const Vector3d e = AB_ / d, inner_end = A_ + (d - s_) * e;
    join(0, A_, -u_, plane_);
    join(1, A_, x_, std::atan2(r_, k_.y()));
    join(2, inner_end, e, d);
    return withLinks(frameAlong(x_, e, A_), frameAlong(x_, e, inner_end), A_ + l_ * e);
  }

  /// Along u the leg appears as a triangle of crank l, rod c and r.
  LegPose rus() {
    if (!(std::abs(k_.y()) < s_))
      refuse("would have to reach along its crank's axis over", std::abs(k_.y()), " m", fmt::format("below {} m", s_));
    const double c = std::sqrt((s_ - k_.y()) * (s_ + k_.y()));
    requireBent(c / s_, "has its rod along the axis of its crank, cos theta");
    requireWithin(r_, std::abs(l_ - c), l_ + c);
    const double psi = side_ * (pi - angleOpposite(r_, l_, c)), phi = plane_ - side_ * angleOpposite(c, l_, r_);
    requireBent(std::sin(psi), "is stretched or folded, sin psi");
    const Vector3d x_1 = std::cos(phi) * x_hat_ + std::sin(phi) * z_hat_, e = x_1.cross(u_), R = A_ + l_ * e;
    const Vector3d along = (out_.tip - R).normalized(), x_2 = u_.cross(along).normalized();
    join(0, A_, -u_, phi);
    join(1, R, -u_, psi);
    join(2, R, -x_2, std::atan2(k_.y(), c));
    return withLinks(frameAlong(x_1, e, A_), frameAlong(x_2, along, R), R);
  }

  LegPose pus() {
    requireWithin(r_, 0, s_);
    const double ahead = side_ * std::sqrt((s_ - r_) * (s_ + r_)), d = k_.y() - ahead;
    requireBent(ahead / s_, "has its rod across its rail, cos theta");
    const Vector3d C = A_ + d * u_;
    join(0, A_, u_, d);
    join(1, C, -u_, plane_);
    join(2, C, x_, std::atan2(r_, ahead));
    Eigen::Isometry3d carriage = frameAlong(x_hat_, z_hat_, C);
    carriage.linear() << x_hat_, u_, z_hat_;
    return withLinks(carriage, frameAlong(x_, (out_.tip - C).normalized(), C), C + l_ * u_);
  }

  LegPose withLinks(const Eigen::Isometry3d& proximal, const Eigen::Isometry3d& distal, const Vector3d& far_end) {
    out_.proximal = proximal;
    out_.distal = distal;
    out_.far_end = far_end;
    return out_;
  }

  const Leg& leg_;
  int number_;
  double l_, s_, side_;
  Vector3d A_, AB_, u_, x_hat_, z_hat_, k_, x_, z_;  ///< x and z of F̂R(α), whose plane contains B at z = r
  double r_ = 0, plane_ = 0;                         ///< r = √(k_x² + k_z²); α
  LegPose out_;
};

}  // namespace

LegPose legPose(const Leg& leg, int index, const Vector3d& tip) { return Placing(leg, index, tip).pose(); }

}  // namespace ursula::exchange

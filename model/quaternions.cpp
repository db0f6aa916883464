#include "model/quaternions.h"

#include <Eigen/Geometry>

#include "base/real50.h"

namespace ursula {

std::vector<Eigen::Vector4d> quaternions(const std::vector<Motion<double>>& motions) {
  std::vector<Eigen::Vector4d> out;
  out.reserve(motions.size());
  for (const Motion<double>& motion : motions) {
    const Eigen::Quaterniond q(motion.Q);
    Eigen::Vector4d next(q.w(), q.x(), q.y(), q.z());
    if (out.empty() ? next(0) < 0 : next.dot(out.back()) < 0) next = -next;
    out.push_back(next);
  }
  return out;
}

namespace {

Real50 inRadians(double degrees) { return Real50(degrees) * acos(Real50(-1)) / 180; }

/// Sets an entry to zero if it is only the rounding error of π's 50 digits.
double entry(const Real50& value) { return abs(value) < Real50(1e-40) ? 0 : static_cast<double>(value); }

}  // namespace

double radians(double degrees) { return static_cast<double>(inRadians(degrees)); }

/// Multiplies q = q_z(yaw) q_y(pitch) q_x(roll) out, with half the angles.
Eigen::Vector4d quaternionOf(const Vector3d& roll_pitch_yaw) {
  Real50 c[3], s[3];
  for (int k = 0; k < 3; ++k) {
    const Real50 half = inRadians(roll_pitch_yaw(k)) / 2;
    c[k] = cos(half);
    s[k] = sin(half);
  }
  return {entry(c[2] * c[1] * c[0] + s[2] * s[1] * s[0]), entry(c[2] * c[1] * s[0] - s[2] * s[1] * c[0]),
          entry(c[2] * s[1] * c[0] + s[2] * c[1] * s[0]), entry(s[2] * c[1] * c[0] - c[2] * s[1] * s[0])};
}

}  // namespace ursula

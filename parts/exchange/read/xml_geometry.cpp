#include "parts/exchange/read/xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace ursula::exchange {

void joinFrames(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, GraphJoint& joint) {
  joint.centre = a.translation();
  joint.centre_of_child = b.translation();
  if (joint.kind == JointKind::fixed) joint.turn = a.linear() * b.linear().transpose();
}

void takeInertia(const Element& inertia, TextOfWord text, const Eigen::Isometry3d& at,
                 const std::function<double(std::size_t, const char*)>& missing, GraphBody& body) {
  constexpr std::array<const char*, 6> names = {"ixx", "iyy", "izz", "ixy", "ixz", "iyz"};
  std::array<double, 6> entries = {};
  for (std::size_t k = 0; k < names.size(); ++k) {
    const std::string word = text(inertia, names[k]);
    entries[k] = word.empty() ? missing(k, names[k]) : numberOf(inertia, word, names[k]);
    body.inertia_rounding = std::max(body.inertia_rounding, halfLastDigit(word));
  }
  body.center_of_mass = at.translation();
  body.inertia = at.linear() * tensorOf({entries[0], entries[1], entries[2]}, {entries[3], entries[4], entries[5]}) *
                 at.linear().transpose();
}

Vector3d directionOf(const Element& at, const Vector3d& vector, const std::string& what) {
  const double norm = vector.stableNorm();
  if (!(norm > 1e-12)) refuse(at, fmt::format("{} is zero, expected a direction", what));
  return vector / norm;
}

Matrix3d rollPitchYaw(const Vector3d& angles) {
  return (Eigen::AngleAxisd(angles.z(), Vector3d::UnitZ()) * Eigen::AngleAxisd(angles.y(), Vector3d::UnitY()) *
          Eigen::AngleAxisd(angles.x(), Vector3d::UnitX()))
      .toRotationMatrix();
}

Eigen::Isometry3d placed(const Vector3d& position, const Matrix3d& rotation) {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() = rotation;
  out.translation() = position;
  return out;
}

Matrix3d tensorOf(const Vector3d& diagonal, const Vector3d& products) {
  Matrix3d out;
  out << diagonal.x(), products.x(), products.y(), products.x(), diagonal.y(), products.z(), products.y(), products.z(),
      diagonal.z();
  return out;
}

}  // namespace ursula::exchange

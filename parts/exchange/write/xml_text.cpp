#include "parts/exchange/write/xml_text.h"

#include <fmt/format.h>

#include <cmath>

namespace ursula::exchange {
namespace {

/// Sets values below the precision of `size` to zero.
Vector3d withoutRounding(const Vector3d& values, double size) {
  const double known = 4 * Eigen::NumTraits<double>::epsilon() * size;
  return (values.array().abs() > known).select(values, 0.0);
}

}  // namespace

std::string numberText(double value) { return fmt::format("{}", value + 0.0); }

std::string numberText(const Vector3d& values) {
  const Vector3d clean = withoutRounding(values, values.cwiseAbs().maxCoeff());
  return numberText(clean.x()) + " " + numberText(clean.y()) + " " + numberText(clean.z());
}

std::string quaternionText(const Matrix3d& rotation) {
  Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
  if (q.w() < 0) q.coeffs() *= -1;
  return numberText(q.w()) + " " + numberText(withoutRounding(q.vec(), 1));
}

/// Removes the yaw before it reads the roll. If rounding determines the yaw, the roll compensates for it.
Vector3d rollPitchYawOf(const Matrix3d& rotation) {
  const double yaw = std::atan2(rotation(1, 0), rotation(0, 0)), c = std::cos(yaw), s = std::sin(yaw);
  const double pitch = std::atan2(-rotation(2, 0), c * rotation(0, 0) + s * rotation(1, 0));
  const double roll = std::atan2(s * rotation(0, 2) - c * rotation(1, 2), c * rotation(1, 1) - s * rotation(0, 1));
  return withoutRounding({roll, pitch, yaw}, 1);
}

std::string poseText(const Eigen::Isometry3d& pose) {
  return numberText(Vector3d(pose.translation())) + " " + numberText(rollPitchYawOf(pose.linear()));
}

Eigen::Isometry3d between(const Vector3d& from, const Vector3d& to) {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  const Vector3d z = (to - from).normalized(), x = z.unitOrthogonal();
  out.linear() << x, z.cross(x), z;
  out.translation() = (from + to) / 2;
  return out;
}

XmlDocument::XmlDocument(const char* root) {
  document_.InsertEndChild(document_.NewDeclaration());
  document_.InsertEndChild(document_.NewElement(root));
}

std::string XmlDocument::text() const {
  tinyxml2::XMLPrinter printer;
  document_.Print(&printer);
  return printer.CStr();
}

}  // namespace ursula::exchange

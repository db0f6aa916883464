#pragma once

#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <array>
#include <string>

#include "base/scalar.h"

namespace ursula::exchange {

/// Attributes that only an import of this program reads. Their prefix is "ursula:".
constexpr const char* own_namespace = "urn:ursula";

/// Returns the shortest digits that parse to the same number; a zero has no sign.
std::string numberText(double value);
/// Returns numbers separated by spaces. An entry within rounding of zero, relative to the others, becomes zero.
std::string numberText(const Vector3d& values);
/// Returns [w, x, y, z], with w not negative.
std::string quaternionText(const Matrix3d& rotation);
/// Returns roll, pitch, yaw, rad: rotations about the fixed x, y and z, in this order. It is exact to rounding even at
/// a pitch of ±π/2.
Vector3d rollPitchYawOf(const Matrix3d& rotation);
/// Returns the position, then roll, pitch and yaw.
std::string poseText(const Eigen::Isometry3d& pose);
/// Returns a frame midway between two points, with z from the first to the second.
Eigen::Isometry3d between(const Vector3d& from, const Vector3d& to);

/// An entry of an inertia tensor in the words of SDF and URDF.
struct InertiaEntry {
  const char* name;
  int row, column;
};
constexpr std::array<InertiaEntry, 6> inertia_entries = {
    {{"ixx", 0, 0}, {"ixy", 0, 1}, {"ixz", 0, 2}, {"iyy", 1, 1}, {"iyz", 1, 2}, {"izz", 2, 2}}};

/// A handle for filling an element. tinyxml2 escapes text.
class Xml {
 public:
  explicit Xml(tinyxml2::XMLElement* element) : element_(element) {}

  Xml add(const char* name) const { return Xml(element_->InsertNewChildElement(name)); }
  /// Adds a child that contains only text.
  Xml add(const char* name, const std::string& text) const {
    const Xml child = add(name);
    child.element_->SetText(text.c_str());
    return child;
  }
  Xml add(const char* name, double value) const { return add(name, numberText(value)); }
  const Xml& with(const char* attribute, const std::string& value) const {
    element_->SetAttribute(attribute, value.c_str());
    return *this;
  }
  const Xml& with(const char* attribute, double value) const { return with(attribute, numberText(value)); }
  const Xml& with(const char* attribute, const Vector3d& values) const { return with(attribute, numberText(values)); }
  void comment(const std::string& text) const { element_->InsertNewComment(text.c_str()); }

 private:
  tinyxml2::XMLElement* element_;
};

/// A document with one root.
class XmlDocument {
 public:
  explicit XmlDocument(const char* root);
  Xml root() { return Xml(document_.RootElement()); }
  std::string text() const;

 private:
  tinyxml2::XMLDocument document_;
};

}  // namespace ursula::exchange

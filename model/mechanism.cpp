#include "model/mechanism.h"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.h"
#include "base/text.h"

namespace ursula {
namespace {

void requireBody(const MechanismBody& body) {
  const std::string place = fmt::format("mechanism.body '{}'", shown(body.name));
  if (!std::isfinite(body.mass) || body.mass < 0)
    throw InvalidParameter(place, fmt::format("mass {}", body.mass), ">= 0");
  if (!body.center_of_mass.allFinite() || !body.inertia.allFinite())
    throw InvalidParameter(place, "a number that is not finite", "finite numbers");
  const double size = body.inertia.cwiseAbs().maxCoeff();
  const double least = body.inertia.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff();
  if (least < -1e-9 * size - body.inertia_rounding)
    throw InvalidParameter(place, fmt::format("a negative principal moment of inertia {}", least), ">= 0");
}

/// Returns the distance of each body from the base, counted in joints.
std::vector<std::size_t> distances(const MechanismParameters& machine) {
  const std::size_t unreached = machine.bodies.size() + 1;
  std::vector<std::size_t> out(machine.bodies.size(), unreached);
  for (std::size_t b = 0; b < machine.bodies.size(); ++b)
    if (machine.bodies[b].fixed) out[b] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (const MechanismJoint& joint : machine.joints) {
      if (joint.kind == JointKind::free) continue;  // it connects nothing
      const std::size_t step = joint.kind == JointKind::fixed ? 0 : 1;
      for (const auto& [from, to] : {std::pair(joint.parent, joint.child), std::pair(joint.child, joint.parent)})
        if (out[from] != unreached && out[from] + step < out[to]) {
          out[to] = out[from] + step;
          changed = true;
        }
    }
  }
  return out;
}

double sizeOf(const MechanismParameters& machine) {
  Eigen::AlignedBox3d box;
  for (const MechanismJoint& joint : machine.joints) {
    box.extend(joint.centre);
    box.extend(joint.centre_of_child);
  }
  for (const MechanismBody& body : machine.bodies)
    if (body.mass > 0 && !body.fixed) box.extend(body.center_of_mass);
  const double size = box.isEmpty() ? 0 : box.diagonal().norm();
  return size > 0 ? size : 1;
}

/// Whether hinges and balls without loads let a body spin about one line, about which it is symmetric: its pose says
/// nothing of the machine. What is left free by longer chains of joints is not looked for.
bool spinsAlone(const MechanismParameters& machine, std::size_t b) {
  const MechanismBody& body = machine.bodies[b];
  Vector3d line = Vector3d::Zero();
  std::vector<Vector3d> arms, axes;
  for (const MechanismJoint& joint : machine.joints) {
    const bool is_child = joint.child == b;
    if ((!is_child && joint.parent != b) || joint.kind == JointKind::free) continue;
    const bool is_motor = std::count(machine.motors.begin(), machine.motors.end(), joint.name) > 0;
    if ((joint.kind != JointKind::revolute && joint.kind != JointKind::ball) || joint.isLoaded() || is_motor)
      return false;
    arms.emplace_back((is_child ? joint.centre_of_child : joint.centre) - body.center_of_mass);
    if (joint.kind == JointKind::revolute)
      axes.emplace_back(is_child ? joint.turn.transpose() * joint.axis[0] : joint.axis[0]);
  }
  for (const Vector3d& arm : arms)
    if (arm.norm() > line.norm()) line = arm;
  if (!axes.empty()) line = axes.front();
  if (arms.empty() || line.isZero(0)) return false;
  line.normalize();
  const auto off = [&](const Vector3d& v) { return line.cross(v).norm(); };
  const Matrix3d &I = body.inertia, along = line * line.transpose();
  const double axial = line.dot(I * line), across = (I.trace() - axial) / 2;
  const Matrix3d symmetric = across * Matrix3d::Identity() + (axial - across) * along;
  return std::all_of(arms.begin(), arms.end(), [&](const auto& arm) { return off(arm) < 1e-7 * sizeOf(machine); }) &&
         std::all_of(axes.begin(), axes.end(), [&](const auto& axis) { return off(axis) < 1e-7; }) &&
         (I - symmetric).cwiseAbs().maxCoeff() <= 1e-6 * I.cwiseAbs().maxCoeff();
}

/// Returns the body farthest from the base that weighs anything, none that spins alone if there is another.
std::size_t farthestBody(const MechanismParameters& machine) {
  const std::vector<std::size_t> far = distances(machine);
  std::size_t best = 0;
  for (const bool spinning_too : {false, true})
    for (std::size_t b = 0; b < far.size() && (!spinning_too || machine.bodies[best].mass == 0); ++b) {
      const bool reached = far[b] <= machine.bodies.size(), has_mass = machine.bodies[b].mass > 0;
      if (!reached || !has_mass || !(machine.bodies[best].mass == 0 || far[b] > far[best])) continue;
      if (spinning_too || !spinsAlone(machine, b)) best = b;
    }
  return best;
}

}  // namespace

int freedomsOf(JointKind kind) {
  switch (kind) {
    case JointKind::fixed:
      return 0;
    case JointKind::revolute:
    case JointKind::prismatic:
      return 1;
    case JointKind::universal:
      return 2;
    case JointKind::ball:
      return 3;
    case JointKind::free:
      return 6;
  }
  return 0;
}

Mechanism::Mechanism(MechanismParameters parameters, const std::string& output) : parameters_(std::move(parameters)) {
  for (const MechanismBody& body : parameters_.bodies) requireBody(body);
  const auto& joints = parameters_.joints;
  for (const std::string& name : parameters_.motors) {
    const auto found =
        std::find_if(joints.begin(), joints.end(), [&](const MechanismJoint& joint) { return joint.name == name; });
    std::vector<std::string> names;
    for (const MechanismJoint& joint : joints)
      if (freedomsOf(joint.kind) == 1) names.push_back(joint.name);
    if (found == joints.end())
      throw InvalidParameter("mechanism.motors", fmt::format("'{}', no joint has that name", shown(name)),
                             fmt::format("a hinge or slide of the file{}", didYouMean(name, names)));
    if (freedomsOf(found->kind) != 1)
      throw InvalidParameter("mechanism.motors",
                             fmt::format("'{}', a joint of {} coordinates", shown(name), freedomsOf(found->kind)),
                             "a hinge or slide");
    const std::size_t index = found - joints.begin();
    if (std::find(motors_.begin(), motors_.end(), index) != motors_.end())
      throw InvalidParameter("mechanism.motors", fmt::format("'{}' twice", shown(name)), "each joint once");
    motors_.push_back(index);
  }
  if (motors_.empty())
    throw InvalidParameter("mechanism.motors", "none, and the file drives no joint", "at least one joint's name");
  output_ = farthestBody(parameters_);
  if (!output.empty()) {
    std::vector<std::string> names;
    for (const MechanismBody& body : parameters_.bodies) names.push_back(body.name);
    const auto found = std::find(names.begin(), names.end(), output);
    if (found == names.end())
      throw InvalidParameter("mechanism.output", fmt::format("'{}', no body has that name", shown(output)),
                             fmt::format("a body of the file{}", didYouMean(output, names)));
    output_ = found - names.begin();
  }
  length_ = sizeOf(parameters_);
}

}  // namespace ursula

#pragma once

#include <string>

#include "model/mechanism.h"

namespace ursula {

/// Adds a wheel that spins freely on a body of the machine about its own line of symmetry. Its centre is `arm` from
/// that body's.
inline void addWheel(MechanismParameters& machine, std::size_t carrier, const Vector3d& axis, const Vector3d& arm,
                     const std::string& name) {
  const Vector3d line = axis.normalized();
  MechanismBody wheel;
  wheel.name = name;
  wheel.mass = 1.5;
  wheel.center_of_mass = machine.bodies[carrier].center_of_mass + arm;
  wheel.frame.translation() = wheel.center_of_mass;
  wheel.inertia = 0.012 * Matrix3d::Identity() + 0.008 * line * line.transpose();
  MechanismJoint hinge;
  hinge.name = name + "_hinge";
  hinge.kind = JointKind::revolute;
  hinge.parent = carrier;
  hinge.child = machine.bodies.size();
  hinge.centre = hinge.centre_of_child = wheel.center_of_mass - 0.03 * line;
  hinge.axis[0] = line;
  machine.bodies.push_back(wheel);
  machine.joints.push_back(hinge);
}

/// Adds a wheel to a body, a second one on the first one's hinge line, and a third with another line.
inline void addWheels(MechanismParameters& machine, std::size_t carrier) {
  const Vector3d line = Vector3d(0.3, -0.5, 0.8).normalized();
  addWheel(machine, carrier, line, {0.11, -0.07, 0.05}, "wheel");
  addWheel(machine, machine.bodies.size() - 1, line, 0.04 * line, "wheel_on_wheel");
  addWheel(machine, carrier, {0.7, 0.6, 0.1}, {-0.03, 0.06, 0.08}, "other_wheel");
}

/// Welds the wheels of addWheels() to what carries them, and takes their axial moments of inertia: a wheel that nothing
/// drives has no angular momentum about its line, and weighs as much.
inline void weldWheels(MechanismParameters& machine) {
  for (MechanismJoint& joint : machine.joints) {
    MechanismBody& wheel = machine.bodies[joint.child];
    if (joint.name != wheel.name + "_hinge" || wheel.name.find("wheel") == std::string::npos) continue;
    joint.kind = JointKind::fixed;
    wheel.inertia -= 0.02 * joint.axis[0] * joint.axis[0].transpose();
    joint.axis[0].setZero();
  }
}

}  // namespace ursula

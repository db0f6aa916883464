#pragma once

// A machine with one loop, by hand, and changes of its description that leave the machine as it is.

#include <Eigen/Geometry>
#include <string>
#include <utility>

#include "model/mechanism.h"

namespace ursula {

inline MechanismBody body(const std::string& name, double mass, const Vector3d& center, const Vector3d& along) {
  MechanismBody out;
  out.name = name;
  out.mass = mass;
  out.center_of_mass = center;
  out.inertia = 0.01 * mass * (along.squaredNorm() * Matrix3d::Identity() - along * along.transpose()) +
                1e-3 * mass * Matrix3d::Identity();
  return out;
}

inline MechanismJoint joint(const std::string& name, JointKind kind, std::size_t parent, std::size_t child,
                            const Vector3d& at, const Vector3d& axis = Vector3d::Zero()) {
  MechanismJoint out;
  out.name = name;
  out.kind = kind;
  out.parent = parent;
  out.child = child;
  out.centre = out.centre_of_child = at;
  out.axis[0] = axis;
  return out;
}

/// A crank about a tilted axis moves a slider on a tilted rail by a rod with a universal joint and a ball.
inline MechanismParameters sliderCrank() {
  const Vector3d A(0, 0, 0), B(0.1, 0.3, 0.2), C(0.9, 0.5, -0.1);
  MechanismParameters out;
  out.gravity = Vector3d(1, -2, -9);
  out.bodies = {body("ground", 0, A, A), body("crank", 1.3, Vector3d(B / 2 + Vector3d(0.02, 0, 0.01)), B),
                body("rod", 0.7, Vector3d((B + C) / 2 + Vector3d(0, 0.03, 0)), Vector3d(C - B)),
                body("slider", 2.1, Vector3d(C + Vector3d(0.05, 0.02, 0.07)), Vector3d(0.3, 0.1, 0.2))};
  out.bodies[0].fixed = true;
  out.joints = {joint("hinge", JointKind::revolute, 0, 1, A, Vector3d(0.6, 0, 0.8)),
                joint("cross", JointKind::universal, 1, 2, B, Vector3d(0, 0.6, 0.8)),
                joint("ball", JointKind::ball, 2, 3, C),
                joint("rail", JointKind::prismatic, 0, 3, C, Vector3d(0.8, 0.48, -0.36))};
  out.joints[1].axis[1] = out.joints[1].axis[0].cross(C - B).normalized();
  out.motors = {"hinge"};
  return out;
}

/// Loads of all kinds at every joint that has them in Simbody.
inline MechanismParameters loaded(MechanismParameters machine) {
  for (std::size_t j = 0; j < machine.joints.size(); ++j) {
    MechanismJoint& at = machine.joints[j];
    const double k = 1 + 0.3 * static_cast<double>(j);
    at.damping = 0.4 * k;
    if (at.kind != JointKind::ball) at.friction = 0.2 * k;  // it acts in the child's axes
    at.smoothing_speed = 0.5;
    at.rotor_inertia = 0.01 * k;
    at.position = at.kind == JointKind::ball ? 0 : 0.1 * k;
    if (at.kind != JointKind::ball) at.stiffness = 3 * k;
    at.spring_reference = 0.2 * k;
  }
  return machine;
}

inline MechanismJoint turnedAround(MechanismJoint at) {
  std::swap(at.parent, at.child);
  if (at.kind == JointKind::universal) std::swap(at.axis[0], at.axis[1]);
  for (Vector3d& axis : at.axis) axis = -axis;
  return at;
}

/// Moves a body of the reference pose, so that the joints at it are open.
inline MechanismParameters displaced(MechanismParameters machine, std::size_t moved, const Eigen::Isometry3d& by) {
  MechanismBody& body = machine.bodies[moved];
  body.center_of_mass = by * body.center_of_mass;
  body.frame = by * body.frame;
  body.inertia = by.linear() * body.inertia * by.linear().transpose();
  for (MechanismJoint& at : machine.joints) {
    if (at.child == moved) {
      at.centre_of_child = by * at.centre_of_child;
      at.turn = by.linear().transpose();
    }
    if (at.parent != moved) continue;
    at.centre = by * at.centre;
    at.turn = by.linear();
    for (Vector3d& axis : at.axis) axis = by.linear() * axis;
  }
  return machine;
}

}  // namespace ursula

// Coordinates of joints in Simbody, whether their joint is a mobilizer or cut: value, rate, and the row of the rate.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "simbody/simbody_mechanism_internal.h"

namespace ursula {
namespace {
using Row = CoordinateInSimbody::Row;
}

double angleAbout(const Vector3d& axis, const Vector3d& from, const Vector3d& to) {
  return std::atan2(axis.dot(from.cross(to)), from.dot(to) - axis.dot(from) * axis.dot(to));
}

void SimbodyMechanism::Impl::addCoordinates() {
  for (const std::size_t motor : mechanism.motors()) addCoordinate(motor);
  for (std::size_t j = 0; j < mechanism.joints().size(); ++j) {
    const auto& motors = mechanism.motors();
    const bool is_motor = std::count(motors.begin(), motors.end(), j) > 0;
    if (mechanism.joints()[j].isLoaded() && !is_motor) addCoordinate(j);
  }
}

void SimbodyMechanism::Impl::addCoordinate(std::size_t j) {
  const MechanismJoint& joint = mechanism.joints()[j];
  const bool has_axes = joint.kind != JointKind::ball && joint.kind != JointKind::free;
  if (joint.stiffness != 0 && !has_axes)
    throw std::domain_error(fmt::format("Simbody's engine has no spring for joint {} with a ball", joint.name));
  const auto step =
      std::find_if(tree.steps.begin(), tree.steps.end(), [&](const auto& each) { return each.joint == j; });
  const int count = freedomsOf(joint.kind);
  for (int k = 0; k < count; ++k) {
    CoordinateInSimbody c{j, k, Row::tree};
    if (has_axes && step != tree.steps.end()) {
      const SimTK::MobilizedBody& body = bodies[step->outboard].mobilizer;
      const int own = step->reversed ? count - 1 - k : k;
      c.u = body.getFirstUIndex(state) + own;
      c.q = body.getFirstQIndex(state) + own;
      c.sign = step->reversed ? -1 : 1;
    } else {
      c.row = joint.kind == JointKind::prismatic || k >= 3 ? Row::linear : Row::angular;
      c.is_on_child = c.row == Row::angular && (!has_axes || k == 1);
      const Matrix3d& of_file = mechanism.bodies()[c.is_on_child ? joint.child : joint.parent].frame.linear();
      c.axis = has_axes ? joint.axis[k] : Vector3d(of_file.col(k % 3));
      if (c.is_on_child && !has_axes) c.axis = joint.turn * c.axis;
    }
    coordinates.push_back(c);
  }
}

Eigen::Isometry3d SimbodyMechanism::Impl::displacement(std::size_t body) const {
  const BodyInSimbody& at = bodies[body];
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() = rotation(body);
  out.translation() = toEigen(at.mobilizer.getBodyOriginLocation(state)) - out.linear() * at.origin;
  return out;
}

Eigen::MatrixXd SimbodyMechanism::Impl::frameJacobian(std::size_t body, const Vector3d& point) const {
  const SimTK::MobilizedBody& at = bodies[body].mobilizer;
  if (at.isGround()) return Eigen::MatrixXd::Zero(6, state.getNU());
  SimTK::Matrix J;
  matter.calcFrameJacobian(state, at.getMobilizedBodyIndex(), at.findStationAtGroundPoint(state, toSimTK(point)), J);
  Eigen::MatrixXd out(6, J.ncol());
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < J.ncol(); ++j) out(i, j) = J(i, j);
  return out;
}

Vector6d SimbodyMechanism::Impl::frameBias(std::size_t body, const Vector3d& point) const {
  const SimTK::MobilizedBody& at = bodies[body].mobilizer;
  if (at.isGround()) return Vector6d::Zero();
  return toEigen(matter.calcBiasForFrameJacobian(state, at.getMobilizedBodyIndex(),
                                                 at.findStationAtGroundPoint(state, toSimTK(point))));
}

Vector3d SimbodyMechanism::Impl::axisNow(const CoordinateInSimbody& c) const {
  const MechanismJoint& joint = jointOf(c);
  if (c.is_on_child) return rotation(joint.child) * (joint.turn.transpose() * c.axis);
  return rotation(joint.parent) * c.axis;
}

double SimbodyMechanism::Impl::angleOfCut(const CoordinateInSimbody& c) const {
  const MechanismJoint& joint = jointOf(c);
  const Matrix3d R = rotation(joint.parent).transpose() * rotation(joint.child) * joint.turn.transpose();
  double angle = 0;
  if (joint.kind == JointKind::revolute) {
    const Vector3d across = anyAcross(c.axis);
    angle = angleAbout(c.axis, across, R * across);
  } else if (joint.kind == JointKind::universal) {  // R turns about the first axis, then about the second
    const Vector3d &first = joint.axis[0], &second = joint.axis[1];
    angle = c.index == 0 ? angleAbout(first, second, R * second) : angleAbout(second, R.transpose() * first, first);
  }
  c.turns_near = angle + 2 * pi * std::round((c.turns_near - angle) / (2 * pi));
  return c.turns_near;
}

double SimbodyMechanism::Impl::value(const CoordinateInSimbody& c) const {
  const MechanismJoint& joint = jointOf(c);
  if (c.row == Row::tree) return joint.position + c.sign * state.getQ()[c.q];
  if (c.row == Row::angular) return joint.position + angleOfCut(c);
  const Vector3d apart = displacement(joint.child) * joint.centre_of_child - displacement(joint.parent) * joint.centre;
  return joint.position + axisNow(c).dot(apart);
}

double SimbodyMechanism::Impl::rate(const CoordinateInSimbody& c) const {
  if (c.row == Row::tree) return c.sign * state.getU()[c.u];
  return row(c, false).J.dot(mapped(state.getU()));
}

CoordinateRow SimbodyMechanism::Impl::row(const CoordinateInSimbody& c, bool with_bias) const {
  CoordinateRow out;
  if (c.row == Row::tree) {
    out.J = Eigen::VectorXd::Unit(state.getNU(), c.u) * c.sign;
    return out;
  }
  const MechanismJoint& joint = jointOf(c);
  const bool is_angular = c.row == Row::angular;
  const Vector3d e = axisNow(c), point = displacement(joint.child) * joint.centre_of_child;
  const Eigen::MatrixXd J = frameJacobian(joint.child, point) - frameJacobian(joint.parent, point);
  out.J = (is_angular ? J.topRows<3>() : J.bottomRows<3>()).transpose() * e;
  if (!with_bias) return out;
  const Vector6d bias = frameBias(joint.child, point) - frameBias(joint.parent, point);
  const Vector6d twist = J * mapped(state.getU());
  const Vector3d omega_of_axis = omega(c.is_on_child ? joint.child : joint.parent);
  if (is_angular)
    out.bias = e.dot(bias.head<3>()) + omega_of_axis.cross(e).dot(twist.head<3>());
  else  // in the parent's frame, with Coriolis' acceleration
    out.bias = e.dot(bias.tail<3>() - 2 * omega_of_axis.cross(twist.tail<3>()));
  return out;
}

Eigen::VectorXd SimbodyMechanism::Impl::motorValues() const {
  Eigen::VectorXd out(motorCount());
  for (Eigen::Index k = 0; k < out.size(); ++k) out(k) = value(coordinates[k]);
  return out;
}

}  // namespace ursula

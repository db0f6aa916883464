// Builds a mechanism in Simbody: a mobilizer for each joint of the spanning tree, constraints for the others.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "simbody/simbody_mechanism_internal.h"

namespace ursula {
namespace {

using Axis = SimTK::UnitVec3;

Axis unit(const Vector3d& v) { return Axis(toSimTK(v)); }

double angleBetween(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// A body without mass but with moments of inertia gets a mass that nothing feels: Simbody keeps their quotient.
double massInSimbody(const MechanismBody& body) {
  return body.mass > 0 ? body.mass : 1e-30 * body.inertia.cwiseAbs().maxCoeff();
}

SimTK::Body::Rigid rigidBody(const MechanismBody& body) try {
  if (isMassless(body)) return SimTK::Body::Rigid(SimTK::MassProperties(0, SimTK::Vec3(0), SimTK::Inertia(0)));
  const Matrix3d& I = body.inertia;
  const SimTK::Inertia inertia(SimTK::Vec3(I(0, 0), I(1, 1), I(2, 2)), SimTK::Vec3(I(0, 1), I(0, 2), I(1, 2)));
  return SimTK::Body::Rigid(SimTK::MassProperties(massInSimbody(body), SimTK::Vec3(0), inertia));
} catch (const SimTK::Exception::Base&) {
  throw std::domain_error(fmt::format(
      "Simbody cannot hold body {}: no body has its moments of inertia, as each is at most the sum of the others",
      body.name));
}

/// Returns axes of which Pin uses the third, Slider the first, Universal the first two.
Matrix3d mobilizerAxes(const MechanismJoint& joint, bool reversed) {
  Matrix3d out = Matrix3d::Identity();
  const Vector3d& axis = joint.axis[reversed && joint.kind == JointKind::universal ? 1 : 0];
  if (joint.kind == JointKind::universal) {
    const Vector3d across = axis.cross(joint.axis[reversed ? 0 : 1]).normalized();
    out << axis, across.cross(axis), across;
  } else if (freedomsOf(joint.kind) == 1) {
    const Vector3d next = anyAcross(axis);
    if (joint.kind == JointKind::prismatic)
      out << axis, next, axis.cross(next);
    else
      out << next, axis.cross(next), axis;
  }
  return out;
}

SimTK::MobilizedBody mobilizer(JointKind kind, SimTK::MobilizedBody& inboard, const SimTK::Transform& F,
                               const SimTK::Body& body, const SimTK::Transform& M) {
  switch (kind) {
    case JointKind::fixed:
      return SimTK::MobilizedBody::Weld(inboard, F, body, M);
    case JointKind::revolute:
      return SimTK::MobilizedBody::Pin(inboard, F, body, M);
    case JointKind::prismatic:
      return SimTK::MobilizedBody::Slider(inboard, F, body, M);
    case JointKind::universal:
      return SimTK::MobilizedBody::Universal(inboard, F, body, M);
    case JointKind::ball:
      return SimTK::MobilizedBody::Ball(inboard, F, body, M);
    case JointKind::free:
      break;
  }
  return SimTK::MobilizedBody::Free(inboard, F, body, M);
}

}  // namespace

Vector3d anyAcross(const Vector3d& axis) {
  Eigen::Index least = 0;
  axis.cwiseAbs().minCoeff(&least);
  return axis.cross(Vector3d::Unit(least)).normalized();
}

SimTK::Transform SimbodyMechanism::Impl::side(std::size_t joint, bool of_child, const Matrix3d& axes) const {
  const MechanismJoint& at = mechanism.joints()[joint];
  if (!of_child) return {toSimTK(axes), toSimTK(Vector3d(at.centre - bodies[at.parent].origin))};
  return {toSimTK(Matrix3d(at.turn.transpose() * axes)),
          toSimTK(Vector3d(at.centre_of_child - bodies[at.child].origin))};
}

void SimbodyMechanism::Impl::addStep(const SpanningTree::Step& step) {
  const MechanismBody& body = mechanism.bodies()[step.outboard];
  BodyInSimbody& to = bodies[step.outboard];
  if (!isMassless(body) && body.mass > 0) to.origin = body.center_of_mass;
  if (step.joint == SpanningTree::none) {
    if (!(body.mass > 0)) to.origin = body.frame.translation();
    to.mobilizer = SimTK::MobilizedBody::Free(matter.Ground(), SimTK::Transform(toSimTK(to.origin)), rigidBody(body),
                                              SimTK::Transform());
    return;
  }
  const MechanismJoint& joint = mechanism.joints()[step.joint];
  if (!(body.mass > 0)) to.origin = step.reversed ? joint.centre : joint.centre_of_child;
  const Matrix3d axes = mobilizerAxes(joint, step.reversed);
  to.mobilizer = mobilizer(joint.kind, bodies[step.inboard].mobilizer, side(step.joint, step.reversed, axes),
                           rigidBody(body), side(step.joint, !step.reversed, axes));
}

void SimbodyMechanism::Impl::addBall(std::size_t joint, std::size_t a, const Vector3d& on_a, std::size_t b,
                                     const Vector3d& on_b) {
  const SimTK::Constraint::Ball ball(bodies[a].mobilizer, toSimTK(Vector3d(on_a - bodies[a].origin)),
                                     bodies[b].mobilizer, toSimTK(Vector3d(on_b - bodies[b].origin)));
  cut_rows.push_back({ball, joint, false});
}

void SimbodyMechanism::Impl::addAngle(std::size_t joint, std::size_t a, const Vector3d& on_a, std::size_t b,
                                      const Vector3d& on_b, double angle) {
  const SimTK::Constraint::ConstantAngle held(bodies[a].mobilizer, unit(on_a), bodies[b].mobilizer, unit(on_b), angle);
  cut_rows.push_back({held, joint, true});
}

void SimbodyMechanism::Impl::addPlane(std::size_t j, const Vector3d& normal) {
  const MechanismJoint& joint = mechanism.joints()[j];
  BodyInSimbody &parent = bodies[joint.parent], &child = bodies[joint.child];
  const SimTK::Constraint::PointInPlane held(parent.mobilizer, unit(normal), normal.dot(joint.centre - parent.origin),
                                             child.mobilizer, toSimTK(Vector3d(joint.centre_of_child - child.origin)));
  cut_rows.push_back({held, j, false});
}

void SimbodyMechanism::Impl::addTurn(std::size_t joint) {
  const MechanismJoint& at = mechanism.joints()[joint];
  const SimTK::Constraint::ConstantOrientation held(bodies[at.parent].mobilizer, SimTK::Rotation(),
                                                    bodies[at.child].mobilizer, toSimTK(Matrix3d(at.turn.transpose())));
  cut_rows.push_back({held, joint, true});
}

void SimbodyMechanism::Impl::addCut(std::size_t j) {
  const MechanismJoint& joint = mechanism.joints()[j];
  const std::size_t p = joint.parent, c = joint.child;
  if (joint.kind == JointKind::free) return;
  if (joint.kind != JointKind::prismatic) addBall(j, p, joint.centre, c, joint.centre_of_child);
  if (joint.kind == JointKind::fixed || joint.kind == JointKind::prismatic) addTurn(j);
  if (joint.kind == JointKind::fixed || joint.kind == JointKind::ball) return;
  const Vector3d &axis = joint.axis[0], across = anyAcross(axis);
  const auto on_child = [&](const Vector3d& v) { return Vector3d(joint.turn.transpose() * v); };
  if (joint.kind == JointKind::universal)
    addAngle(j, p, axis, c, on_child(joint.axis[1]), angleBetween(axis, joint.axis[1]));
  else
    for (const Vector3d& normal : {across, Vector3d(axis.cross(across))})
      joint.slides() ? addPlane(j, normal) : addAngle(j, p, normal, c, on_child(axis), pi / 2);
}

void SimbodyMechanism::Impl::addGimbal(const SpanningTree::Gimbal& gimbal) {
  const Vector3d &first = mechanism.joints()[gimbal.first].axis[0], &second = mechanism.joints()[gimbal.second].axis[0];
  addBall(gimbal.first, gimbal.before, gimbal.centre, gimbal.after, gimbal.centre);
  addAngle(gimbal.first, gimbal.before, first, gimbal.after, second, angleBetween(first, second));
}

void SimbodyMechanism::Impl::addForces() {
  gravity = SimTK::Force::Gravity(forces, matter, toSimTK(mechanism.gravity()));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const MechanismBody& body = mechanism.bodies()[b];
    const bool is_weightless = body.weightless || body.mass == 0;
    if (is_weightless && !body.fixed && !bodies[b].mobilizer.isEmptyHandle())
      gravity.setDefaultBodyIsExcluded(bodies[b].mobilizer.getMobilizedBodyIndex(), true);
  }
  discrete = SimTK::Force::DiscreteForces(forces, matter);
}

void SimbodyMechanism::Impl::addScales() {
  const double length = mechanism.length();
  column_scale = Eigen::VectorXd::Ones(state.getNU());
  for (const SpanningTree::Step& step : tree.steps) {
    const SimTK::MobilizedBody& body = bodies[step.outboard].mobilizer;
    const JointKind kind = step.joint == SpanningTree::none ? JointKind::free : mechanism.joints()[step.joint].kind;
    const Eigen::Index first = body.getNumU(state) > 0 ? static_cast<int>(body.getFirstUIndex(state)) : 0;
    if (kind == JointKind::prismatic) column_scale(first) = length;
    if (kind == JointKind::free) column_scale.segment<3>(first + 3).setConstant(length);
  }
  row_scale = Eigen::VectorXd::Ones(state.getNMultipliers());
  joint_of_row.resize(state.getNMultipliers());
  for (const CutRows& cut : cut_rows) {
    int count = 0, of_velocity = 0, of_acceleration = 0;
    SimTK::MultiplierIndex first, unused, none;
    cut.constraint.getNumConstraintEquationsInUse(state, count, of_velocity, of_acceleration);
    cut.constraint.getIndexOfMultipliersInUse(state, first, unused, none);
    for (int i = first; i < first + count; ++i) {
      if (!cut.angular) row_scale(i) = length;
      joint_of_row[i] = cut.joint;
    }
  }
}

/// A coordinate moves the rows of every constraint on a body that it carries.
void SimbodyMechanism::Impl::addSweeps() {
  moves.setConstant(state.getNMultipliers(), state.getNU(), false);
  for (const CutRows& cut : cut_rows) {
    int count = 0, of_velocity = 0, of_acceleration = 0;
    SimTK::MultiplierIndex first, unused, none;
    cut.constraint.getNumConstraintEquationsInUse(state, count, of_velocity, of_acceleration);
    cut.constraint.getIndexOfMultipliersInUse(state, first, unused, none);
    for (SimTK::ConstrainedBodyIndex c(0); c < cut.constraint.getNumConstrainedBodies(); ++c)
      for (SimTK::MobilizedBody at = cut.constraint.getMobilizedBodyFromConstrainedBody(c); !at.isGround();
           at = at.getParentMobilizedBody())
        if (const int n = at.getNumU(state); n > 0)
          moves.block(static_cast<int>(first), static_cast<int>(at.getFirstUIndex(state)), count, n) = true;
  }
  for (int j = 0; j < state.getNU(); ++j) {
    const auto apart = [&](const std::vector<int>& sweep) {
      return std::none_of(sweep.begin(), sweep.end(), [&](int k) { return (moves.col(j) && moves.col(k)).any(); });
    };
    const auto to = std::find_if(sweeps.begin(), sweeps.end(), apart);
    if (to == sweeps.end())
      sweeps.push_back({j});
    else
      to->push_back(j);
  }
}

void SimbodyMechanism::Impl::setStart() {
  const auto& start = mechanism.start();
  if (start.empty()) return;
  const auto placed = [&](std::size_t b) {
    if (mechanism.bodies()[b].fixed) return SimTK::Transform();
    return SimTK::Transform(toSimTK(Matrix3d(start[b].linear())), toSimTK(Vector3d(start[b] * bodies[b].origin)));
  };
  for (const SpanningTree::Step& step : tree.steps) {
    const SimTK::MobilizedBody& body = bodies[step.outboard].mobilizer;
    const SimTK::Transform F = step.joint == SpanningTree::none ? SimTK::Transform() : placed(step.inboard);
    body.setQToFitTransform(
        state, ~(F * body.getDefaultInboardFrame()) * placed(step.outboard) * body.getDefaultOutboardFrame());
  }
}

SimbodyMechanism::Impl::Impl(const Mechanism& of, Tree kind)
    : matter(system),
      forces(system),
      mechanism(of),
      tree(spanningTree(of, kind == Tree::other)),
      bodies(of.bodies().size()) {
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (mechanism.bodies()[b].fixed) bodies[b].mobilizer = matter.Ground();
  for (const SpanningTree::Step& step : tree.steps) addStep(step);
  for (const std::size_t joint : tree.cuts) addCut(joint);
  for (const SpanningTree::Gimbal& gimbal : tree.gimbals) addGimbal(gimbal);
  addForces();
  state = system.realizeTopology();
  system.realizeModel(state);
  setStart();
  q_of_file = state.getQ();
  u_dot = SimTK::Vector(state.getNU(), 0.0);
  system.realize(state, SimTK::Stage::Instance);
  addScales();
  addSweeps();
  addCoordinates();
  close();
  holdSpins();
  simbodys_own = spins.empty() && simbodyAgrees();
}

}  // namespace ursula

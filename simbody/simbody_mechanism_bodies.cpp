// Motions of a mechanism's bodies, with those that a cut gimbal leaves out of Simbody, and its idle spins.

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "simbody/simbody_mechanism_internal.h"

namespace ursula {
namespace {

/// Returns the twist at a point by that at another of the same body, or the twist rate without its centripetal part.
Vector6d movedTo(const Vector3d& arm, const Vector6d& at) {
  Vector6d out = at;
  out.tail<3>() += at.head<3>().cross(arm);
  return out;
}

/// Bodies that fixed joints weld together, and slides too if asked for: the first of them stands for all.
std::vector<std::size_t> groupsBy(const Mechanism& mechanism, bool slides_too) {
  std::vector<std::size_t> group(mechanism.bodies().size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (const MechanismJoint& joint : mechanism.joints()) {
    const bool joins = joint.kind == JointKind::fixed || (slides_too && joint.slides());
    if (!joins || joint.isOpen()) continue;
    const std::size_t from = std::max(group[joint.parent], group[joint.child]);
    const std::size_t to = std::min(group[joint.parent], group[joint.child]);
    std::replace(group.begin(), group.end(), from, to);
  }
  return group;
}

/// Mass, mass centre and central inertia of a group.
struct WeldedGroup {
  double mass = 0, rounding = 0;
  Vector3d center = Vector3d::Zero();
  Matrix3d inertia = Matrix3d::Zero();
};

WeldedGroup groupOf(const Mechanism& mechanism, const std::vector<std::size_t>& groups, std::size_t group) {
  WeldedGroup out;
  const auto& bodies = mechanism.bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (groups[b] != group) continue;
    out.mass += bodies[b].mass;
    out.center += bodies[b].mass * bodies[b].center_of_mass;
    out.rounding += bodies[b].inertia_rounding;
  }
  if (out.mass > 0) out.center /= out.mass;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (groups[b] != group) continue;
    const Vector3d arm = bodies[b].mass > 0 ? Vector3d(bodies[b].center_of_mass - out.center) : Vector3d::Zero();
    out.inertia +=
        bodies[b].inertia + bodies[b].mass * (arm.squaredNorm() * Matrix3d::Identity() - arm * arm.transpose());
  }
  return out;
}

/// Returns the line between the two balls of a strut, a rod or parts that slide along each other; zero if other joints
/// or loads hold it.
Vector3d lineOf(const Mechanism& mechanism, const std::vector<std::size_t>& struts, std::size_t strut) {
  std::vector<Vector3d> balls;
  bool is_free = true;
  for (std::size_t b = 0; b < struts.size(); ++b)
    is_free = is_free && !(struts[b] == strut && mechanism.bodies()[b].fixed);
  for (const MechanismJoint& joint : mechanism.joints()) {
    const bool of_parent = struts[joint.parent] == strut, of_child = struts[joint.child] == strut;
    if (of_parent == of_child) continue;
    is_free = is_free && joint.kind == JointKind::ball && !joint.isLoaded();
    balls.push_back(of_parent ? joint.centre : joint.centre_of_child);
  }
  if (!is_free || balls.size() != 2 || (balls[1] - balls[0]).norm() < 1e-9 * mechanism.length())
    return Vector3d::Zero();
  const Vector3d line = (balls[1] - balls[0]).normalized();
  for (const MechanismJoint& joint : mechanism.joints())
    if (joint.slides() && struts[joint.parent] == strut && joint.axis[0].cross(line).norm() > 1e-9)
      return Vector3d::Zero();
  return line;
}

/// Whether a turn of the group about the line moves no mass and needs no force.
bool isSymmetricAbout(const WeldedGroup& group, const Vector3d& on_line, const Vector3d& line, double length) {
  constexpr double decimals = 1e-9;  // of a file that rounds its numbers
  if (group.mass > 0 && line.cross(group.center - on_line).norm() > decimals * length) return false;
  const Vector3d a = anyAcross(line), b = line.cross(a);
  const Matrix3d& I = group.inertia;
  const double room = decimals * I.cwiseAbs().maxCoeff() + 2 * group.rounding;
  return std::abs(a.dot(I * a) - b.dot(I * b)) <= room && std::abs(a.dot(I * b)) <= room &&
         std::abs(a.dot(I * line)) <= room && std::abs(b.dot(I * line)) <= room;
}

}  // namespace

std::vector<IdleSpin> idleSpins(const Mechanism& mechanism) {
  const std::vector<std::size_t> groups = groupsBy(mechanism, false), struts = groupsBy(mechanism, true);
  std::vector<IdleSpin> out;
  for (std::size_t strut = 0; strut < struts.size(); ++strut) {
    if (struts[strut] != strut) continue;
    const Vector3d line = lineOf(mechanism, struts, strut);
    if (line.isZero(0)) continue;
    const auto ball =
        std::find_if(mechanism.joints().begin(), mechanism.joints().end(), [&](const MechanismJoint& joint) {
          return joint.kind == JointKind::ball && (struts[joint.parent] == strut || struts[joint.child] == strut);
        });
    const Vector3d on_line = struts[ball->parent] == strut ? ball->centre : ball->centre_of_child;
    bool is_round = true;
    for (std::size_t b = 0; b < groups.size(); ++b)
      if (groups[b] == b && struts[b] == strut)
        is_round = is_round && isSymmetricAbout(groupOf(mechanism, groups, b), on_line, line, mechanism.length());
    if (is_round) out.push_back({strut, line});
  }
  return out;
}

SimbodyMechanism::BodyState SimbodyMechanism::Impl::stateOf(
    std::size_t body, const SimTK::Vector_<SimTK::SpatialVec>& accelerations) const {
  BodyState out;
  const SimTK::MobilizedBody& at = bodies[body].mobilizer;
  if (at.isGround()) return out;
  out.displacement = displacement(body);
  const Vector3d arm = out.displacement.linear() * (mechanism.bodies()[body].center_of_mass - bodies[body].origin);
  const Vector3d w = omega(body);
  out.twist = movedTo(arm, toEigen(at.getBodyVelocity(state)));
  out.twist_rate = movedTo(arm, toEigen(accelerations[at.getMobilizedBodyIndex()]));
  out.twist_rate.tail<3>() += w.cross(w.cross(arm));
  return out;
}

/// The body turns about the first hinge's axis e₁ on its neighbour before, whose neighbour after turns about e₂ on it:
/// ω_after − ω_before = q̇₁e₁ + q̇₂e₂, of which a product with e₂ leaves q̇₁.
SimbodyMechanism::BodyState SimbodyMechanism::Impl::stateOf(const SpanningTree::Gimbal& gimbal,
                                                            const std::vector<BodyState>& states) const {
  const BodyState &before = states[gimbal.before], &after = states[gimbal.after];
  const Vector3d &first = mechanism.joints()[gimbal.first].axis[0], &second = mechanism.joints()[gimbal.second].axis[0];
  const Matrix3d R = before.displacement.linear().transpose() * after.displacement.linear();
  const Eigen::AngleAxisd turn(angleAbout(first, second, R * second), first);
  BodyState out;
  out.displacement =
      before.displacement * Eigen::Translation3d(gimbal.centre) * turn * Eigen::Translation3d(-gimbal.centre);
  const Vector3d e1 = before.displacement.linear() * first, e2 = after.displacement.linear() * second;
  const Vector3d n = e1.cross(e2);
  const auto along_first = [&](const Vector3d& v) { return v.cross(e2).dot(n) / n.squaredNorm(); };
  const auto along_second = [&](const Vector3d& v) { return e1.cross(v).dot(n) / n.squaredNorm(); };
  const Vector3d w0 = before.twist.head<3>(), across = after.twist.head<3>() - w0;
  const Vector3d w = w0 + along_first(across) * e1;
  const Vector3d turning = along_first(across) * w0.cross(e1) + along_second(across) * w.cross(e2);
  const double rate2 = along_first(after.twist_rate.head<3>() - before.twist_rate.head<3>() - turning);
  const Vector3d w_dot = before.twist_rate.head<3>() + rate2 * e1 + along_first(across) * w0.cross(e1);

  const auto& bodies_of_file = mechanism.bodies();
  const Vector3d centre = before.displacement * gimbal.centre;
  const Vector3d arm = before.displacement.linear() * (gimbal.centre - bodies_of_file[gimbal.before].center_of_mass);
  const Vector3d to_own = out.displacement * bodies_of_file[gimbal.body].center_of_mass - centre;
  out.twist << w, movedTo(arm, before.twist).tail<3>();
  out.twist_rate << w_dot, movedTo(arm, before.twist_rate).tail<3>() + w0.cross(w0.cross(arm));
  out.twist = movedTo(to_own, out.twist);
  out.twist_rate = movedTo(to_own, out.twist_rate);
  out.twist_rate.tail<3>() += w.cross(w.cross(to_own));
  return out;
}

std::vector<SimbodyMechanism::BodyState> SimbodyMechanism::bodies() const {
  const Impl& m = *impl_;
  m.realize(SimTK::Stage::Velocity);
  SimTK::Vector_<SimTK::SpatialVec> accelerations;
  m.matter.calcBodyAccelerationFromUDot(m.state, m.u_dot, accelerations);
  std::vector<BodyState> out(m.bodies.size());
  for (std::size_t b = 0; b < out.size(); ++b)
    if (!m.bodies[b].mobilizer.isEmptyHandle()) out[b] = m.stateOf(b, accelerations);
  for (const SpanningTree::Gimbal& gimbal : m.tree.gimbals) out[gimbal.body] = m.stateOf(gimbal, out);
  return out;
}

}  // namespace ursula

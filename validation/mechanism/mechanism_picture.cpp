#include "model/mechanism_picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "model/instants.h"
#include "validation/mechanism/validate_mechanism.h"

namespace ursula {
namespace {

/// Adds a point unless the body has it already.
void addPoint(const Vector3d& point, double length, std::vector<Vector3d>& points) {
  const auto is_same = [&](const Vector3d& other) { return (other - point).norm() <= 1e-6 * length; };
  if (std::none_of(points.begin(), points.end(), is_same)) points.push_back(point);
}

void addBodies(const Mechanism& mechanism, MechanismPicture& out) {
  for (const MechanismBody& body : mechanism.bodies()) {
    out.bodies.push_back({body.name, body.fixed, {}, 0, {}, {}});
    if (!body.fixed) out.mass += body.mass;
  }
  for (const MechanismJoint& joint : mechanism.joints()) {
    if (joint.kind == JointKind::free) continue;
    addPoint(joint.centre, mechanism.length(), out.bodies[joint.parent].points);
    addPoint(joint.centre_of_child, mechanism.length(), out.bodies[joint.child].points);
  }
  for (std::size_t b = 0; b < out.bodies.size(); ++b) {
    MechanismPicture::Body& body = out.bodies[b];
    body.anchors = body.points.size();
    if (!body.fixed && mechanism.bodies()[b].mass > 0)
      addPoint(mechanism.bodies()[b].center_of_mass, mechanism.length(), body.points);
  }
}

void addJoints(const Mechanism& mechanism, MechanismPicture& out) {
  for (const MechanismJoint& joint : mechanism.joints()) {
    MechanismPicture::Joint drawn{
        joint.name, joint.kind, joint.parent, joint.child, joint.centre, joint.centre_of_child, {}, -1, joint.closure};
    const bool has_axis = joint.kind == JointKind::revolute || joint.slides();
    const std::size_t axes = has_axis ? 1 : joint.kind == JointKind::universal ? 2 : 0;
    drawn.axes.assign(joint.axis.begin(), joint.axis.begin() + static_cast<std::ptrdiff_t>(axes));
    out.joints.push_back(std::move(drawn));
  }
  for (std::size_t k = 0; k < mechanism.motorCount(); ++k) {
    out.joints[mechanism.motors()[k]].motor = static_cast<int>(k);
    out.motors.push_back({mechanism.motor(k).name, mechanism.effortUnit(k)});
  }
}

void addPose(const Eigen::Isometry3d& pose, MechanismPicture::Body& body) {
  if (body.fixed && !body.p.empty()) return;
  const Eigen::Quaterniond q(pose.linear());
  const Eigen::Vector4d next(q.w(), q.x(), q.y(), q.z());
  body.p.emplace_back(pose.translation());
  body.q.push_back(body.q.empty() || next.dot(body.q.back()) >= 0 ? next : Eigen::Vector4d(-next));
}

/// What the scenario says, without poses.
MechanismPicture described(const MechanismScenario& scenario) {
  MechanismPicture out;
  const Mechanism& mechanism = *scenario.mechanism;
  addBodies(mechanism, out);
  addJoints(mechanism, out);
  out.output = mechanism.output();
  out.output_point = mechanism.bodies()[out.output].frame.translation();
  out.scenario_file = scenario.file.filename().string();
  out.model_file = scenario.model.filename().string();
  out.motion = scenario.trajectory->kind();
  out.duration = scenario.trajectory->duration();
  out.samples = scenario.simulation.samples;
  out.gravity = mechanism.gravity();
  out.warnings = scenario.read.warnings;
  out.assumptions = scenario.read.assumptions;
  if (!scenario.tolerance) return out;
  if (scenario.tolerance->relative > 0) out.options += fmt::format(" --rtol {}", scenario.tolerance->relative);
  if (scenario.tolerance->absolute > 0) out.options += fmt::format(" --atol {}", scenario.tolerance->absolute);
  if (scenario.tolerance->any) out.options += " --any-tolerance";
  return out;
}

}  // namespace

std::shared_ptr<const MechanismPicture> makePicture(const MechanismScenario& scenario, const MechanismAlong& along,
                                                    int instants) {
  auto out = std::make_shared<MechanismPicture>(described(scenario));
  out->freedoms = along.freedoms().freedoms;
  out->idle = along.freedoms().idleNames();
  out->t = equallySpaced(out->duration, instants);
  LoopWork work;
  for (const double t : out->t) {
    static_cast<void>(along.motion().inverseDynamics(t, work));
    for (std::size_t b = 0; b < out->bodies.size(); ++b) addPose(work.bodies[b].displacement, out->bodies[b]);
  }
  return out;
}

std::shared_ptr<const MechanismPicture> pictureAsRead(const MechanismScenario& scenario) {
  auto out = std::make_shared<MechanismPicture>(described(scenario));
  out->t = {0};
  for (MechanismPicture::Body& body : out->bodies) addPose(Eigen::Isometry3d::Identity(), body);
  return out;
}

}  // namespace ursula

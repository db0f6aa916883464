// Bodies that fixed joints weld together.

#include <algorithm>

#include "parts/engines/joint_rows.h"

namespace ursula {
namespace {

/// Numbers the welds: 0 is the ground, the others follow their first body.
std::vector<std::size_t> numbersOf(const Mechanism& mechanism) {
  const auto& bodies = mechanism.bodies();
  const std::size_t ground = bodies.size();
  std::vector<std::size_t> root(bodies.size());
  for (std::size_t b = 0; b < root.size(); ++b) root[b] = bodies[b].fixed ? ground : b;
  for (const MechanismJoint& joint : mechanism.joints()) {
    if (joint.kind != JointKind::fixed || joint.isOpen()) continue;
    std::size_t keep = root[joint.parent], drop = root[joint.child];
    if (drop == ground) std::swap(keep, drop);
    std::replace(root.begin(), root.end(), drop, keep);
  }
  std::vector<std::size_t> number(bodies.size() + 1, 0), out;
  std::size_t next = 1;
  for (const std::size_t r : root) {
    if (r != ground && number[r] == 0) number[r] = next++;
    out.push_back(number[r]);
  }
  return out;
}

void addBody(const MechanismBody& body, WeldedBodies& weld) {
  if (weld.mass + body.mass > 0) {
    const Vector3d center = (weld.mass * weld.center + body.mass * body.center_of_mass) / (weld.mass + body.mass);
    const auto moved = [](double mass, const Vector3d& arm) -> Matrix3d {
      return mass * (arm.squaredNorm() * Matrix3d::Identity() - arm * arm.transpose());
    };
    weld.inertia += moved(weld.mass, weld.center - center) + moved(body.mass, body.center_of_mass - center);
    weld.center = center;
    weld.mass += body.mass;
  }
  weld.inertia += body.inertia;
}

}  // namespace

WeldedMechanism::WeldedMechanism(const Mechanism& mechanism) : of_body(numbersOf(mechanism)) {
  const auto& bodies = mechanism.bodies();
  welds.resize(1 + *std::max_element(of_body.begin(), of_body.end()));
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (of_body[b] != 0) addBody(bodies[b], welds[of_body[b]]);
  welds[0].fixed = true;
  for (const MechanismJoint& joint : mechanism.joints()) {
    if (welds[parentOf(joint)].mass == 0) welds[parentOf(joint)].center = joint.centre;
    if (welds[childOf(joint)].mass == 0) welds[childOf(joint)].center = joint.centre_of_child;
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    WeldedBodies& weld = welds[of_body[b]];
    if (of_body[b] == 0 || bodies[b].weightless) continue;
    weld.weight += bodies[b].mass;
    weld.weight_arm += bodies[b].mass * (bodies[b].center_of_mass - weld.center);
  }
  for (WeldedBodies& weld : welds)
    if (weld.weight > 0) weld.weight_arm /= weld.weight;
}

}  // namespace ursula

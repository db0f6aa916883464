// The spanning tree of a mechanism, and its text for MuJoCo. Numbers of inertia are placeholders there, which get
// overwritten: MuJoCo refuses bodies without mass, and digits would be lost.

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>

#include "parts/engines/mujoco/mujoco_mechanism_internal.h"

namespace ursula::mujoco {
namespace {

int costOfCutting(const Mechanism& mechanism, std::size_t j) {
  const MechanismJoint& joint = mechanism.joints()[j];
  const auto& motors = mechanism.motors();
  if (std::count(motors.begin(), motors.end(), j) > 0) return 0;
  if (joint.isLoaded()) return 1;
  return joint.closure ? 3 : 2;
}

bool mayBeInTree(const MechanismJoint& joint) {
  return !joint.isOpen() && joint.kind != JointKind::fixed && joint.kind != JointKind::free;
}

std::vector<bool> joined(const Mechanism& mechanism, const WeldedMechanism& welded) {
  const auto& joints = mechanism.joints();
  std::vector<std::size_t> order(joints.size()), part(welded.welds.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::iota(part.begin(), part.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return costOfCutting(mechanism, a) < costOfCutting(mechanism, b);
  });
  std::vector<bool> out(joints.size());
  for (const std::size_t j : order) {
    const std::size_t a = part[welded.parentOf(joints[j])], b = part[welded.childOf(joints[j])];
    if (!mayBeInTree(joints[j]) || a == b) continue;
    out[j] = true;
    std::replace(part.begin(), part.end(), b, a);
  }
  return out;
}

std::string numbers(const Vector3d& v) { return fmt::format("{} {} {}", v.x(), v.y(), v.z()); }

std::string jointText(const MechanismJoint& joint, bool reversed, const Vector3d& center) {
  const std::string at = numbers(joint.centre - center);
  if (joint.kind == JointKind::ball) return fmt::format(R"(<joint type="ball" pos="{}"/>)", at);
  const int count = freedomsOf(joint.kind);
  std::string out;
  for (int k = 0; k < count; ++k) {
    const Vector3d& axis = joint.axis[static_cast<std::size_t>(reversed ? count - 1 - k : k)];
    out +=
        fmt::format(R"(<joint type="{}" pos="{}" axis="{}"/>)", joint.slides() ? "slide" : "hinge", at, numbers(axis));
  }
  return out;
}

std::string bodyText(const Mechanism& mechanism, const WeldedMechanism& welded, const WeldTree& tree,
                     const WeldStep& step) {
  const Vector3d center = welded.welds[step.to].center;
  std::string out = fmt::format(R"(<body name="{}" pos="{}"><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>)",
                                step.to, numbers(center - welded.welds[step.from].center));
  out +=
      step.joint == WeldStep::none ? "<freejoint/>" : jointText(mechanism.joints()[step.joint], step.reversed, center);
  for (const WeldStep& next : tree.steps)
    if (next.from == step.to) out += bodyText(mechanism, welded, tree, next);
  return out + "</body>";
}

/// MuJoCo has principal moments and the rotation to their axes.
void writeInertia(const WeldedBodies& weld, int body, mjModel& model) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(weld.inertia);
  Matrix3d axes = principal.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) *= -1;
  const Eigen::Quaterniond turn = Eigen::Quaterniond(axes).normalized();
  model.body_mass[body] = weld.mass;
  Eigen::Map<Eigen::Vector4d>(model.body_iquat + 4 * body) << turn.w(), turn.x(), turn.y(), turn.z();
  Eigen::Map<Vector3d>(model.body_inertia + 3 * body) = principal.eigenvalues();
}

}  // namespace

WeldTree weldTree(const Mechanism& mechanism, const WeldedMechanism& welded) {
  const auto& joints = mechanism.joints();
  const std::vector<bool> in_tree = joined(mechanism, welded);
  WeldTree out;
  std::vector<bool> reached(welded.welds.size());
  std::vector<std::size_t> queue = {0};
  reached[0] = true;
  for (std::size_t next = 0;; ++next) {
    if (next == queue.size()) {  // a part without ground begins at its heaviest weld
      std::size_t root = 0;
      for (std::size_t w = 1; w < reached.size(); ++w)
        if (!reached[w] && (root == 0 || welded.welds[w].mass > welded.welds[root].mass)) root = w;
      if (root == 0) break;
      out.steps.push_back({WeldStep::none, 0, root, false});
      reached[root] = true;
      queue.push_back(root);
    }
    const std::size_t from = queue[next];
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const std::size_t parent = welded.parentOf(joints[j]), child = welded.childOf(joints[j]);
      if (!in_tree[j] || (parent != from && child != from)) continue;
      const std::size_t to = parent == from ? child : parent;
      if (reached[to]) continue;
      out.steps.push_back({j, from, to, child == from});
      reached[to] = true;
      queue.push_back(to);
    }
  }
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (!in_tree[j]) out.cut.push_back(j);
  return out;
}

int bodyOf(const mjModel& model, std::size_t weld) {
  return mj_name2id(&model, mjOBJ_BODY, std::to_string(weld).c_str());
}

Model treeModel(const Mechanism& mechanism, const WeldedMechanism& welded, const WeldTree& tree) {
  std::string text = R"(<mujoco><compiler angle="radian"/><size nstack="200000"/><worldbody>)";
  for (const WeldStep& step : tree.steps)
    if (step.from == 0) text += bodyText(mechanism, welded, tree, step);
  Model model = parseText(text + "</worldbody></mujoco>");
  // Without shortcuts for frames that coincide and inertias that are diagonal in the text.
  std::fill_n(model->body_sameframe, model->nbody, mjtByte{0});
  std::fill_n(model->body_simple, model->nbody, mjtByte{0});
  std::fill_n(model->dof_simplenum, model->nv, 0);
  Eigen::Map<Vector3d>(model->opt.gravity) = mechanism.gravity();
  for (std::size_t w = 1; w < welded.welds.size(); ++w) writeInertia(welded.welds[w], bodyOf(*model, w), *model);
  std::copy_n(model->body_mass, model->nbody, model->body_subtreemass);
  for (int b = model->nbody - 1; b > 0; --b)
    model->body_subtreemass[model->body_parentid[b]] += model->body_subtreemass[b];
  return model;
}

}  // namespace ursula::mujoco

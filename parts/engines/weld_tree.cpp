#include "parts/engines/weld_tree.h"

#include <algorithm>
#include <numeric>

namespace ursula {
namespace {

int costOfCutting(const Mechanism& mechanism, std::size_t j) {
  const MechanismJoint& joint = mechanism.joints()[j];
  const auto& motors = mechanism.motors();
  if (std::count(motors.begin(), motors.end(), j) > 0) return 0;
  if (joint.isLoaded()) return 1;
  return joint.closure ? 3 : 2;
}

bool mayBeInTree(const Mechanism& mechanism, std::size_t j) {
  const MechanismJoint& joint = mechanism.joints()[j];
  const bool is_closure = costOfCutting(mechanism, j) == 3;
  return !is_closure && !joint.isOpen() && joint.kind != JointKind::fixed && joint.kind != JointKind::free;
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
    if (!mayBeInTree(mechanism, j) || a == b) continue;
    out[j] = true;
    std::replace(part.begin(), part.end(), b, a);
  }
  return out;
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

}  // namespace ursula

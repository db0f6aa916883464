#include "nocsolver/loops/loop_tree.h"

#include <algorithm>
#include <numeric>

namespace ursula::loops {
namespace {

/// Sets of bodies that joints of the tree connect.
class Union {
 public:
  explicit Union(std::size_t count) : root_(count) { std::iota(root_.begin(), root_.end(), std::size_t{0}); }
  std::size_t of(std::size_t i) {
    while (root_[i] != i) i = root_[i] = root_[root_[i]];
    return i;
  }
  /// Returns false if they were connected before.
  bool join(std::size_t a, std::size_t b) {
    const std::size_t x = of(a), y = of(b);
    root_[std::max(x, y)] = std::min(x, y);
    return x != y;
  }

 private:
  std::vector<std::size_t> root_;
};

/// Lower ranks come into the tree first. A joint that is open at the reference pose can only be cut.
int rankOf(const Mechanism& mechanism, std::size_t j) {
  const MechanismJoint& joint = mechanism.joints()[j];
  if (joint.kind == JointKind::fixed && !joint.isOpen() && !joint.closure) return 0;
  const auto& motors = mechanism.motors();
  if (std::find(motors.begin(), motors.end(), j) != motors.end()) return 1;
  if (joint.isLoaded()) return joint.closure ? 3 : 2;
  if (!joint.closure) return 4;
  return joint.kind == JointKind::fixed ? 5 : 6;
}

/// Returns the joints in the tree; the others are cut.
std::vector<char> kept(const Mechanism& mechanism) {
  const auto& joints = mechanism.joints();
  Union sets(mechanism.bodies().size());
  std::size_t ground = mechanism.bodies().size();
  for (std::size_t b = 0; b < mechanism.bodies().size(); ++b) {
    if (!mechanism.bodies()[b].fixed) continue;
    if (ground == mechanism.bodies().size()) ground = b;
    sets.join(ground, b);
  }
  std::vector<std::size_t> order(joints.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rankOf(mechanism, a) < rankOf(mechanism, b); });
  std::vector<char> out(joints.size(), 0);
  for (const std::size_t j : order) {
    if (joints[j].isOpen()) continue;
    // A free joint couples nothing: what it leads to may hang on something else.
    if (joints[j].kind == JointKind::free) continue;
    out[j] = sets.join(joints[j].parent, joints[j].child) ? 1 : 0;
  }
  for (const std::size_t j : order)
    if (joints[j].kind == JointKind::free) out[j] = sets.join(joints[j].parent, joints[j].child) ? 1 : 0;
  return out;
}

}  // namespace

CoordinateLoad loadOf(const MechanismJoint& joint) {
  return {joint.damping,   joint.friction,         joint.smoothing(), joint.rotor_inertia,
          joint.stiffness, joint.spring_reference, joint.position};
}

namespace {

/// Adds the elements of a joint, from `before` outwards; returns the last one.
int addJoint(LoopTree& tree, const MechanismJoint& joint, std::size_t index, bool reversed, int before) {
  const auto add = [&](ElementKind kind, const Vector3d& axis, int axis_of_joint) {
    Element out;
    out.kind = kind;
    out.before = before;
    out.first = tree.rate_count;
    out.joint = index;
    out.reversed = reversed;
    out.axis_of_joint = axis_of_joint;
    out.centre = joint.centre;
    out.axis = reversed ? Vector3d(-axis) : axis;
    out.load = loadOf(joint);
    tree.rate_count += out.rates();
    tree.elements.push_back(out);
    before = static_cast<int>(tree.elements.size()) - 1;
  };
  switch (joint.kind) {
    case JointKind::fixed:
      break;
    case JointKind::revolute:
      add(ElementKind::turn, joint.axis[0], 0);
      break;
    case JointKind::prismatic:
      add(ElementKind::slide, joint.axis[0], 0);
      break;
    case JointKind::universal:
      for (const int k : reversed ? std::array<int, 2>{1, 0} : std::array<int, 2>{0, 1})
        add(ElementKind::turn, joint.axis[k], k);
      break;
    case JointKind::ball:
      add(ElementKind::ball, Vector3d::Zero(), 0);
      break;
    case JointKind::free:
      for (int k = 0; k < 3; ++k) add(ElementKind::slide, Vector3d::Unit(k), k);
      add(ElementKind::ball, Vector3d::Zero(), 0);
      break;
  }
  return before;
}

}  // namespace

LoopTree::LoopTree(const Mechanism& mechanism) : element_of_body(mechanism.bodies().size(), -1) {
  const auto& joints = mechanism.joints();
  const std::vector<char> in_tree = kept(mechanism);
  std::vector<char> placed(mechanism.bodies().size(), 0);
  for (std::size_t b = 0; b < placed.size(); ++b) placed[b] = mechanism.bodies()[b].fixed ? 1 : 0;
  const auto grow = [&] {
    for (bool grown = true; grown;) {
      grown = false;
      for (std::size_t j = 0; j < joints.size(); ++j) {
        const MechanismJoint& joint = joints[j];
        if (in_tree[j] == 0 || placed[joint.parent] == placed[joint.child]) continue;
        const bool reversed = placed[joint.child] != 0;
        const std::size_t from = reversed ? joint.child : joint.parent, to = reversed ? joint.parent : joint.child;
        element_of_body[to] = addJoint(*this, joint, j, reversed, element_of_body[from]);
        placed[to] = 1;
        grown = true;
      }
    }
  };
  grow();
  // What nothing connects with the ground moves freely.
  for (std::size_t b = 0; b < placed.size(); ++b) {
    if (placed[b] != 0) continue;
    MechanismJoint free;
    free.kind = JointKind::free;
    free.centre = mechanism.bodies()[b].center_of_mass;
    element_of_body[b] = addJoint(*this, free, joints.size(), false, -1);
    placed[b] = 1;
    grow();
  }
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (in_tree[j] == 0 && joints[j].kind != JointKind::free) cut.push_back(j);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    path_to.push_back(elements[e].before < 0 ? std::vector<int>() : path_to[elements[e].before]);
    path_to.back().push_back(static_cast<int>(e));
  }
  for (const std::size_t motor : mechanism.motors()) {
    const auto found =
        std::find_if(elements.begin(), elements.end(), [&](const Element& each) { return each.joint == motor; });
    rate_of_motor.push_back(found == elements.end() ? -1 : found->first);
  }
}

}  // namespace ursula::loops

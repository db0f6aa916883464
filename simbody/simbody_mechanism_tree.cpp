// The spanning tree of a mechanism: Kruskal's algorithm over its bodies, with the joints in the order of how much it
// costs to cut them. It is on purpose unlike the file's tree where the machine allows it.

#include "simbody/simbody_mechanism_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace ursula {
namespace {

constexpr std::size_t none = SpanningTree::none;

/// A joint between two bodies, or the two hinges of a gimbal between its neighbours.
struct TreeEdge {
  std::size_t a, b;
  int rank;  ///< the lower, the rather it is in the tree
  std::size_t joint, gimbal = none;
};

class DisjointBodies {
 public:
  explicit DisjointBodies(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Returns whether they were apart.
  bool unite(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    parent_[a] = b;
    return a != b;
  }

 private:
  std::vector<std::size_t> parent_;
};

bool isMotor(const Mechanism& mechanism, std::size_t joint) {
  return std::count(mechanism.motors().begin(), mechanism.motors().end(), joint) > 0;
}

/// Returns where the axes of two hinges meet, if they do and are not nearly parallel.
std::optional<Vector3d> meetingPoint(const MechanismJoint& first, const MechanismJoint& second, double length) {
  const Vector3d &a = first.axis[0], &b = second.axis[0], n = a.cross(b), d = second.centre - first.centre;
  if (n.norm() < 0.1) return std::nullopt;
  const double across = n.squaredNorm();
  const Vector3d on_first = first.centre + d.cross(b).dot(n) / across * a;
  const Vector3d on_second = second.centre + d.cross(a).dot(n) / across * b;
  if ((on_first - on_second).norm() > 1e-13 * length) return std::nullopt;  // decimals of a file, rounded to doubles
  return (on_first + on_second) / 2;
}

std::size_t otherEnd(const MechanismJoint& joint, std::size_t body) {
  return joint.parent == body ? joint.child : joint.parent;
}

std::optional<SpanningTree::Gimbal> gimbalOf(const Mechanism& mechanism, std::size_t body) {
  const auto& joints = mechanism.joints();
  if (!isMassless(mechanism.bodies()[body])) return std::nullopt;
  std::vector<std::size_t> at;
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (joints[j].parent == body || joints[j].child == body) at.push_back(j);
  if (at.size() != 2) return std::nullopt;
  for (const std::size_t j : at) {
    const MechanismJoint& joint = joints[j];
    if (joint.kind != JointKind::revolute || joint.closure || joint.isOpen()) return std::nullopt;
    if (joint.isLoaded() || isMotor(mechanism, j)) return std::nullopt;
  }
  const std::size_t before = otherEnd(joints[at[0]], body), after = otherEnd(joints[at[1]], body);
  const auto centre = meetingPoint(joints[at[0]], joints[at[1]], mechanism.length());
  if (!centre || before == after) return std::nullopt;
  return SpanningTree::Gimbal{body, at[0], at[1], before, after, *centre};
}

/// Returns gimbals of which none is next to another.
std::vector<SpanningTree::Gimbal> gimbalsOf(const Mechanism& mechanism) {
  std::vector<SpanningTree::Gimbal> out;
  for (std::size_t body = 0; body < mechanism.bodies().size(); ++body) {
    const auto found = gimbalOf(mechanism, body);
    const auto is_beside = [&](const SpanningTree::Gimbal& each) {
      return each.body == found->before || each.body == found->after;
    };
    if (found && std::none_of(out.begin(), out.end(), is_beside)) out.push_back(*found);
  }
  return out;
}

int rankOf(const Mechanism& mechanism, std::size_t j, bool keeps_closures) {
  const MechanismJoint& joint = mechanism.joints()[j];
  const auto& bodies = mechanism.bodies();
  const bool at_massless = isMassless(bodies[joint.parent]) || isMassless(bodies[joint.child]);
  if (isMotor(mechanism, j)) return 1;
  if (joint.isLoaded()) return 2;
  if (joint.kind == JointKind::free) return keeps_closures ? 7 : 5;  // cut, it closes nothing
  if (joint.isOpen()) return 6;
  if (joint.kind == JointKind::fixed && !joint.closure) return 0;
  if (at_massless && !joint.closure) return 3;
  if (joint.closure) return keeps_closures ? 4 : 6;
  return 5;
}

std::vector<TreeEdge> edgesOf(const Mechanism& mechanism, bool keeps_closures,
                              const std::vector<SpanningTree::Gimbal>& gimbals) {
  std::vector<TreeEdge> edges;
  std::vector<bool> is_in_gimbal(mechanism.joints().size());
  for (std::size_t g = 0; g < gimbals.size(); ++g) {
    edges.push_back({gimbals[g].before, gimbals[g].after, 5, gimbals[g].first, g});
    is_in_gimbal[gimbals[g].first] = is_in_gimbal[gimbals[g].second] = true;
  }
  for (std::size_t j = 0; j < mechanism.joints().size(); ++j) {
    const MechanismJoint& joint = mechanism.joints()[j];
    if (!is_in_gimbal[j]) edges.push_back({joint.parent, joint.child, rankOf(mechanism, j, keeps_closures), j});
  }
  std::stable_sort(edges.begin(), edges.end(), [](const TreeEdge& a, const TreeEdge& b) {
    return a.rank != b.rank ? a.rank < b.rank : a.joint < b.joint;
  });
  return edges;
}

/// Orders the joints of the tree from the ground outwards. A part without ground begins at its heaviest body.
std::vector<SpanningTree::Step> stepsOf(const Mechanism& mechanism, const std::vector<bool>& in_tree,
                                        std::vector<bool> is_left_out) {
  const auto& bodies = mechanism.bodies();
  std::vector<SpanningTree::Step> steps;
  std::vector<bool> reached = std::move(is_left_out);
  std::vector<std::size_t> queue;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies[b].fixed) queue.push_back(b);
  for (const std::size_t b : queue) reached[b] = true;
  for (std::size_t next = 0;; ++next) {
    if (next == queue.size()) {
      std::size_t root = none;
      for (std::size_t b = 0; b < bodies.size(); ++b)
        if (!reached[b] && (root == none || bodies[b].mass > bodies[root].mass)) root = b;
      if (root == none) return steps;
      steps.push_back({none, none, root, false});
      reached[root] = true;
      queue.push_back(root);
    }
    const std::size_t from = queue[next];
    for (std::size_t j = 0; j < in_tree.size(); ++j) {
      const MechanismJoint& joint = mechanism.joints()[j];
      if (!in_tree[j] || (joint.parent != from && joint.child != from)) continue;
      const std::size_t to = otherEnd(joint, from);
      if (reached[to]) continue;
      steps.push_back({j, from, to, joint.child == from});
      reached[to] = true;
      queue.push_back(to);
    }
  }
}

}  // namespace

bool isMassless(const MechanismBody& body) { return !body.fixed && body.mass == 0 && body.inertia.isZero(0); }

SpanningTree spanningTree(const Mechanism& mechanism, bool keeps_closures) {
  SpanningTree out;
  const auto& bodies = mechanism.bodies();
  std::vector<SpanningTree::Gimbal> gimbals;
  if (keeps_closures) gimbals = gimbalsOf(mechanism);
  DisjointBodies parts(bodies.size());
  std::size_t ground = none;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies[b].fixed) {
      if (ground != none) parts.unite(b, ground);
      ground = b;
    }
  std::vector<bool> in_tree(mechanism.joints().size()), is_left_out(bodies.size());
  for (const TreeEdge& edge : edgesOf(mechanism, keeps_closures, gimbals)) {
    const bool is_kept = parts.unite(edge.a, edge.b);
    if (edge.gimbal == none) {
      in_tree[edge.joint] = is_kept;
      if (!is_kept && !(bodies[edge.a].fixed && bodies[edge.b].fixed)) out.cuts.push_back(edge.joint);
      continue;
    }
    const SpanningTree::Gimbal& gimbal = gimbals[edge.gimbal];
    in_tree[gimbal.first] = in_tree[gimbal.second] = is_kept;
    if (is_kept) continue;
    is_left_out[gimbal.body] = true;
    out.gimbals.push_back(gimbal);
  }
  out.steps = stepsOf(mechanism, in_tree, is_left_out);
  std::sort(out.cuts.begin(), out.cuts.end());
  return out;
}

}  // namespace ursula

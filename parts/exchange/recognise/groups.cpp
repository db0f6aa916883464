#include "parts/exchange/recognise/chains.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "base/text.h"
#include "model/manipulator.h"

namespace ursula::exchange {
namespace {

std::size_t rootOf(std::vector<std::size_t>& parents, std::size_t i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
}

}  // namespace

void refuseBody(const Group& group, const std::string& what) {
  throw ImportError("body " + shown(group.name) + what, group.line);
}

void refuseJoint(const GraphJoint& joint, const std::string& what) {
  throw ImportError("joint " + shown(joint.name) + what, joint.line);
}

void requireWeight(const Group& group) {
  if (group.weightless)
    refuseBody(group,
               " has its gravity switched off (SDF's <gravity>, MJCF's gravcomp, Gazebo's turnGravityOff), which a "
               "[manipulator] has no key for; [mechanism] has");
}

Matrix3d Group::inertiaAbout(const Vector3d& point) const {
  return inertia + pointInertia(mass, center_of_mass - point);
}

void Group::add(double mass_of_it, const Vector3d& center, const Matrix3d& inertia_of_it) {
  if (mass + mass_of_it > 0) {
    const Vector3d apart = center - center_of_mass;
    inertia += pointInertia(mass * (mass_of_it / (mass + mass_of_it)), apart);
    center_of_mass += apart * (mass_of_it / (mass + mass_of_it));
  }
  inertia += inertia_of_it;
  mass += mass_of_it;
}

void Group::move(const Eigen::Isometry3d& by) {
  center_of_mass = by * center_of_mass;
  inertia = (by.linear() * inertia * by.linear().transpose()).eval();
}

Groups::Groups(const ModelGraph& graph)
    : group_of(graph.bodies.size()), moved(graph.bodies.size(), Eigen::Isometry3d::Identity()) {
  unite(graph);
  place(graph);
  for (std::size_t i = 0; i < graph.bodies.size(); ++i) {
    const GraphBody& body = graph.bodies[i];
    Group& group = groups[group_of[i]];
    Group own;
    own.add(body.mass, body.center_of_mass, body.inertia);
    own.move(moved[i]);
    group.fixed = group.fixed || body.fixed;
    group.weightless = group.weightless || (body.weightless && body.mass > 0);
    group.add(own.mass, own.center_of_mass, own.inertia);
    group.inertia_rounding += body.inertia_rounding;
  }
}

void Groups::unite(const ModelGraph& graph) {
  std::vector<std::size_t> parents(graph.bodies.size());
  std::iota(parents.begin(), parents.end(), std::size_t{0});
  std::size_t ground = parents.size();
  const auto join = [&parents](std::size_t a, std::size_t b) {
    const std::size_t x = rootOf(parents, a), y = rootOf(parents, b);
    parents[std::max(x, y)] = std::min(x, y);
  };
  for (std::size_t i = 0; i < graph.bodies.size(); ++i) {
    if (!graph.bodies[i].fixed) continue;
    if (ground == parents.size()) ground = i;
    join(ground, i);
  }
  for (const GraphJoint& joint : graph.joints)
    if (joint.kind == JointKind::fixed) join(joint.parent, joint.child);
  std::vector<std::size_t> index(parents.size(), parents.size());
  std::vector<int> joints_of(graph.bodies.size(), 0);
  for (const GraphJoint& joint : graph.joints)
    if (joint.kind != JointKind::fixed) ++joints_of[joint.parent], ++joints_of[joint.child];
  const auto rank = [&](std::size_t i) { return std::pair(joints_of[i] >= 3, graph.bodies[i].mass); };
  for (std::size_t i = 0; i < parents.size(); ++i) {
    const std::size_t root = rootOf(parents, i);
    if (index[root] == parents.size()) {
      index[root] = groups.size();
      groups.emplace_back();
      groups.back().foremost = i;
    }
    group_of[i] = index[root];
    Group& group = groups[index[root]];
    group.bodies.push_back(i);
    if (rank(i) > rank(group.foremost)) group.foremost = i;
    group.name = graph.bodies[group.foremost].name;
    group.line = graph.bodies[group.foremost].line;
  }
}

void Groups::noteContradiction(const GraphJoint& joint, const Eigen::Isometry3d& off) {
  const char* what = "What holds these two bodies together contradicts itself by this; the first is believed";
  const Vector3d& at = joint.centre_of_child;
  contradictions.push_back({what, joint.name, (off * at - at).norm(), "m"});
  contradictions.push_back({what, joint.name, Eigen::AngleAxisd(off.linear()).angle(), "rad"});
}

void Groups::place(const ModelGraph& graph) {
  std::vector<std::vector<const GraphJoint*>> fixed_at(graph.bodies.size());
  for (const GraphJoint& joint : graph.joints)
    if (joint.kind == JointKind::fixed)
      fixed_at[joint.parent].push_back(&joint), fixed_at[joint.child].push_back(&joint);
  std::vector<char> placed(graph.bodies.size(), 0);
  std::vector<std::size_t> order;
  const auto start = [&](std::size_t body) {
    if (placed[body] == 0) order.push_back(body);
    placed[body] = 1;
  };
  // What stands still has its place; else the foremost body has it.
  for (std::size_t i = 0; i < graph.bodies.size(); ++i)
    if (graph.bodies[i].fixed) start(i);
  for (const Group& group : groups)
    if (std::none_of(group.bodies.begin(), group.bodies.end(), [&](std::size_t i) { return placed[i] != 0; }))
      start(group.foremost);
  for (std::size_t k = 0; k < order.size(); ++k)
    for (const GraphJoint* joint : fixed_at[order[k]]) {
      const bool outwards = joint->parent == order[k];
      const std::size_t other = outwards ? joint->child : joint->parent;
      const Eigen::Isometry3d at = !joint->isOpen()
                                       ? moved[order[k]]
                                       : moved[order[k]] * (outwards ? joint->closing() : joint->closing().inverse());
      if (placed[other] == 0) {
        moved[other] = at;
        start(other);
      } else if (outwards) {
        noteContradiction(*joint, moved[other].inverse() * at);
      }
    }
}

std::size_t bodyNamed(const ModelGraph& graph, const std::string& name, const std::string& option) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < graph.bodies.size(); ++i) {
    if (graph.bodies[i].name == name) return i;
    if (names.size() < 1000) names.push_back(graph.bodies[i].name);
  }
  throw ImportError(fmt::format("{}: no body '{}'{}", option, shown(name), didYouMean(name, names)));
}

bool closeAtFrames(ModelGraph& graph, const std::string& pair,
                   const std::function<std::size_t(const std::string&)>& body) {
  std::size_t colon = pair.find(':');
  // Names of nested models contain two colons.
  while (colon != std::string::npos && pair.compare(colon, 2, "::") == 0) colon = pair.find(':', colon + 2);
  if (colon == std::string::npos || colon == 0 || colon + 1 == pair.size()) return false;
  GraphJoint ball;
  ball.name = "close " + pair;
  ball.kind = JointKind::ball;
  ball.closure = true;
  ball.parent = body(pair.substr(0, colon));
  ball.child = body(pair.substr(colon + 1));
  ball.centre = graph.bodies[ball.parent].frame.translation();
  ball.centre_of_child = graph.bodies[ball.child].frame.translation();
  graph.joints.push_back(ball);
  return true;
}

}  // namespace ursula::exchange

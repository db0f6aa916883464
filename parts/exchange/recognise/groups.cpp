#include "parts/exchange/recognise/chains.h"

#include <fmt/format.h>

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
  if (group.weightless) refuseBody(group, " has its gravity switched off, which a scenario has no key for");
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

Groups::Groups(const ModelGraph& graph) : group_of(graph.bodies.size()) {
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
  // A group takes the name of its heaviest body, preferring bodies with three or more moving joints. A payload may be
  // heavier than the platform.
  std::vector<std::pair<bool, double>> foremost;
  std::vector<int> joints_of(graph.bodies.size(), 0);
  for (const GraphJoint& joint : graph.joints)
    if (joint.kind != JointKind::fixed) ++joints_of[joint.parent], ++joints_of[joint.child];
  for (std::size_t i = 0; i < parents.size(); ++i) {
    const std::size_t root = rootOf(parents, i);
    if (index[root] == parents.size()) {
      index[root] = groups.size();
      groups.emplace_back();
      foremost.emplace_back(false, -1);
    }
    group_of[i] = index[root];
    Group& group = groups[index[root]];
    const GraphBody& body = graph.bodies[i];
    group.bodies.push_back(i);
    if (const std::pair<bool, double> rank(joints_of[i] >= 3, body.mass); rank > foremost[index[root]]) {
      foremost[index[root]] = rank;
      group.name = body.name;
      group.line = body.line;
    }
    group.fixed = group.fixed || body.fixed;
    group.weightless = group.weightless || (body.weightless && body.mass > 0);
    group.add(body.mass, body.center_of_mass, body.inertia);
    group.inertia_rounding += body.inertia_rounding;
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

}  // namespace ursula::exchange

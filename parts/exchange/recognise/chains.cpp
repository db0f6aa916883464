#include "parts/exchange/recognise/chains.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "base/text.h"

namespace ursula::exchange {
namespace {

struct Edge {
  std::size_t joint, to;
};

/// Groups and the moving joints between them.
class Net {
 public:
  Net(const ModelGraph& graph, const Groups& groups) : graph_(graph), groups_(groups), edges_(groups.groups.size()) {
    for (std::size_t j = 0; j < graph.joints.size(); ++j) {
      const GraphJoint& joint = graph.joints[j];
      if (joint.kind == JointKind::fixed || joint.kind == JointKind::free) continue;
      const std::size_t a = groups.group_of[joint.parent], b = groups.group_of[joint.child];
      if (a == b)
        refuseJoint(joint, fmt::format(": both of its sides are fixed to body {}, expected two bodies",
                                       shown(groups.groups[a].name)));
      edges_[a].push_back({j, b});
      edges_[b].push_back({j, a});
    }
  }

  const std::vector<Edge>& at(std::size_t group) const { return edges_[group]; }
  std::string name(std::size_t group) const { return shown(groups_.groups[group].name); }

  /// Removes branches of massless frames that end free. A branch with a mass stays, and walk() or the count of joints
  /// refuses it.
  void trimFrames() {
    std::vector<std::size_t> ends;
    for (std::size_t i = 0; i < edges_.size(); ++i)
      if (isEnd(i)) ends.push_back(i);
    while (!ends.empty()) {
      const std::size_t end = ends.back();
      ends.pop_back();
      if (!isEnd(end)) continue;
      const std::size_t to = edges_[end][0].to, joint = edges_[end][0].joint;
      edges_[end].clear();
      auto& others = edges_[to];
      others.erase(std::remove_if(others.begin(), others.end(), [&](const Edge& e) { return e.joint == joint; }),
                   others.end());
      if (isEnd(to)) ends.push_back(to);
    }
  }

  std::vector<std::size_t> hubs() const {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < edges_.size(); ++i)
      if (edges_[i].size() >= 3) out.push_back(i);
    return out;
  }

  std::string names(const std::vector<std::size_t>& groups) const {
    return listed(groups, [this](std::size_t group) { return name(group); });
  }
  /// Returns the names of the bodies that fixed joints hold together.
  std::string bodiesOf(std::size_t group) const {
    return listed(groups_.groups[group].bodies, [this](std::size_t body) { return shown(graph_.bodies[body].name); });
  }

 private:
  template <class Name>
  static std::string listed(const std::vector<std::size_t>& indices, const Name& name_of) {
    std::vector<std::string> out;
    for (const std::size_t each : indices) out.push_back(name_of(each));
    return exchange::listed(out);
  }
  bool isEnd(std::size_t i) const {
    return edges_[i].size() == 1 && !groups_.groups[i].fixed && groups_.groups[i].isFrame();
  }

  const ModelGraph& graph_;
  const Groups& groups_;
  std::vector<std::vector<Edge>> edges_;
};

/// Returns "; --close A:B closes a loop, …" for a URDF. It offers links without children whose frames coincide.
std::string offeredLoops(const ModelGraph& graph, const Groups& groups) {
  constexpr std::size_t most = 100;
  constexpr double apart = 1e-6;  // m
  if (graph.format != ModelFormat::urdf) return "";
  std::vector<char> has_child(graph.bodies.size(), 0);
  for (const GraphJoint& joint : graph.joints) has_child[joint.parent] = 1;
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i < has_child.size() && ends.size() < most; ++i)
    if (has_child[i] == 0) ends.push_back(i);
  std::string offers;
  for (const std::size_t a : ends)
    for (const std::size_t b : ends)
      if (a < b && groups.group_of[a] != groups.group_of[b] &&
          (graph.bodies[a].frame.translation() - graph.bodies[b].frame.translation()).norm() < apart)
        offers += fmt::format(" --close {}:{}", shown(graph.bodies[a].name), shown(graph.bodies[b].name));
  return "; --close A:B closes a loop" + (offers.empty() ? "" : "; ends that coincide:" + offers);
}

std::size_t findBase(const ModelGraph& graph, const Groups& groups, const Net& net, const ImportChoices& choices) {
  if (!choices.base.empty()) return groups.group_of[bodyNamed(graph, choices.base, "--base")];
  for (std::size_t i = 0; i < groups.groups.size(); ++i)
    if (groups.groups[i].fixed && !net.at(i).empty()) return i;
  const std::vector<std::size_t> hubs = net.hubs();
  if (hubs.empty())
    throw ImportError(
        "no body is joined to the world or to a static body, and none has three joints: the file has no base; --base "
        "BODY names the fixed body");
  throw ImportError(fmt::format(
      "no moving body is joined to the world or to a static body, expected a base; name it with --base BODY: {}",
      net.names(hubs)));
}

std::size_t findPlatform(const ModelGraph& graph, const Groups& groups, const Net& net, const ImportChoices& choices,
                         std::size_t base) {
  if (!choices.platform.empty()) {
    const std::size_t platform = groups.group_of[bodyNamed(graph, choices.platform, "--platform")];
    if (platform == base)
      throw ImportError(
          fmt::format("--platform {}: is the base, expected the body that the legs carry", shown(choices.platform)));
    return platform;
  }
  std::vector<std::size_t> hubs = net.hubs();
  hubs.erase(std::remove(hubs.begin(), hubs.end(), base), hubs.end());
  if (hubs.size() == 1) return hubs[0];
  if (hubs.empty())
    throw ImportError(fmt::format(
        "no platform: no body but those of the base, {}, has three joints, expected one that three to six "
        "legs carry; {}",
        net.bodiesOf(base),
        graph.format == ModelFormat::urdf ? "URDF is a tree" + offeredLoops(graph, groups)
                                          : "are its loops closed, and has the platform a joint of its own?"));
  throw ImportError(
      fmt::format("more than one body has three joints or more: {}; --platform BODY names the one that the legs carry",
                  net.names(hubs)));
}

/// Follows the chain from the base through one joint to the platform.
Chain walk(const ModelGraph& graph, Groups& groups, const Net& net, const Chains& ends, const Edge& first) {
  Chain chain;
  Edge edge = first;
  std::size_t from = ends.base;
  Eigen::Isometry3d beyond = Eigen::Isometry3d::Identity();
  while (true) {
    std::size_t k = chain.primitives.size();
    append(graph, groups, edge.joint, groups.group_of[graph.joints[edge.joint].parent] == from, chain);
    for (; k < chain.primitives.size(); ++k) meet(chain.primitives[k], edge.to == ends.platform, beyond);
    if (edge.to == ends.platform) return chain;
    groups.groups[edge.to].move(beyond);
    const std::vector<Edge>& on = net.at(edge.to);
    const std::string where = fmt::format("the leg from joint {}", shown(graph.joints[first.joint].name));
    if (edge.to == ends.base) throw ImportError(where + " comes back to the base, expected the platform");
    if (on.size() == 1)
      throw ImportError(fmt::format("{} ends at body {} in the air, expected the platform, {}{}", where,
                                    net.name(edge.to), net.name(ends.platform), offeredLoops(graph, groups)),
                        groups.groups[edge.to].line);
    if (on.size() > 2)
      throw ImportError(
          fmt::format("{} branches at body {}, which has {} joints, expected legs that join base and platform only",
                      where, net.name(edge.to), on.size()),
          groups.groups[edge.to].line);
    chain.primitives.back().behind = edge.to;
    from = edge.to;
    edge = on[0].joint == edge.joint ? on[1] : on[0];
    if (chain.primitives.size() > 12)
      throw ImportError(fmt::format("{} has more than 12 freedoms, expected six", where));
  }
}

/// Returns whether the chain constrains nothing: massless frames with six undriven, frictionless joints. Some files
/// attach a free platform this way.
bool holdsNothing(const ModelGraph& graph, const Groups& groups, const Chain& chain) {
  std::size_t freedoms = 0, slides = 0;
  for (const Primitive& p : chain.primitives) {
    const GraphJoint& joint = graph.joints[p.joint];
    if (p.behind && !groups.groups[*p.behind].isFrame()) return false;
    if (joint.driven || joint.isLoaded()) return false;
    freedoms += p.kind == Primitive::Kind::S ? 3 : 1;
    slides += p.kind == Primitive::Kind::P ? 1 : 0;
  }
  return freedoms == 6 && slides == 3;
}

/// Returns the place of a leg: that of its first motor among the file's or the user's, then that of its first joint.
/// Efforts go leg by leg, so they come in the order of the motors.
std::pair<std::size_t, std::size_t> placeOf(const ModelGraph& graph, const Chain& chain) {
  const auto begin = graph.motors.begin(), end = graph.motors.end();
  std::pair<std::size_t, std::size_t> first(graph.motors.size(), graph.joints.size());
  for (const Primitive& primitive : chain.primitives) {
    const auto motor = std::find(begin, end, graph.joints[primitive.joint].name);
    first = {std::min(first.first, static_cast<std::size_t>(motor - begin)), std::min(first.second, primitive.joint)};
  }
  return first;
}

/// Reports bodies of the file that are not in the machine, with their mass.
void sayWhatIsApart(const Groups& groups, const Chains& chains, Assumptions& assumptions) {
  std::set<std::size_t> used = {chains.base, chains.platform};
  for (const Chain& chain : chains.legs)
    for (const Primitive& p : chain.primitives)
      if (p.behind) used.insert(*p.behind);
  for (std::size_t i = 0; i < groups.groups.size(); ++i) {
    const Group& group = groups.groups[i];
    if (used.count(i) != 0 || group.fixed || group.isFrame()) continue;
    assumptions.push_back({"This body does not belong to the machine and is left out", group.name, group.mass, "kg"});
    if (assumptions.size() > 200)
      throw ImportError("more than 200 bodies are not of the machine, expected a model of the machine alone");
  }
}

}  // namespace

std::string Chain::place(const ModelGraph& graph) const {
  std::vector<std::string> names;
  for (const Primitive& primitive : primitives) {
    const std::string name = shown(graph.joints[primitive.joint].name);
    if (names.empty() || names.back() != name) names.push_back(name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

Chains findChains(const ModelGraph& graph, Groups& groups, const ImportChoices& choices, Assumptions& assumptions) {
  Net net(graph, groups);
  net.trimFrames();
  Chains out;
  out.base = findBase(graph, groups, net, choices);
  out.platform = findPlatform(graph, groups, net, choices, out.base);
  if (groups.groups[out.platform].fixed && choices.base.empty())
    throw ImportError(fmt::format("the platform, {}, is static, expected a body that moves", net.name(out.platform)));
  std::size_t arriving = net.at(out.platform).size();
  if (net.at(out.base).size() <= 12)
    for (const Edge& edge : net.at(out.base)) {
      Chain chain = walk(graph, groups, net, out, edge);
      if (holdsNothing(graph, groups, chain)) {
        assumptions.push_back({"These joints leave the platform free and are left out", chain.place(graph), 6, "1"});
        --arriving;
      } else {
        out.legs.push_back(std::move(chain));
      }
    }
  const std::size_t count = out.legs.empty() ? net.at(out.base).size() : out.legs.size();
  if (count < 3 || count > 6)
    throw ImportError(fmt::format("{} joint{} at the base, {}, expected three to six legs", count,
                                  count == 1 ? "" : "s", net.name(out.base)));
  if (arriving != count)
    throw ImportError(fmt::format("{} joints at the base, {}, and {} at the platform, {}, expected one a leg at either",
                                  count, net.name(out.base), arriving, net.name(out.platform)));
  std::sort(out.legs.begin(), out.legs.end(),
            [&graph](const Chain& a, const Chain& b) { return placeOf(graph, a) < placeOf(graph, b); });
  sayWhatIsApart(groups, out, assumptions);
  return out;
}

}  // namespace ursula::exchange

#include "parts/exchange/read/mjcf_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/text.h"

namespace ursula::exchange {
namespace {

template <class Map>
const typename Map::mapped_type& find(const Element& at, const Map& map, const std::string& name, const char* what) {
  if (const auto found = map.find(name); found != map.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [each, index] : map)
    if (names.size() < 1000) names.push_back(each);
  std::sort(names.begin(), names.end());
  refuse(at, fmt::format("{} '{}': nothing has that name{}", what, shown(name), didYouMean(name, names)));
}

void joinSites(const Element& element, const std::string& first, const MjcfNamed& named, GraphJoint& joint) {
  for (const char* name : {"anchor", "relpose"})
    if (!attribute(element, name).empty())
      refuse(element, fmt::format("both sites and {}, expected one of them", name));
  const MjcfSite& a = find(element, named.sites, first, "site1");
  const std::string second = requiredAttribute(element, "site2");
  const MjcfSite& b = find(element, named.sites, second, "site2");
  joint.parent = a.body;
  joint.child = b.body;
  joinFrames(a.frame, b.frame, joint);
}

void joinBodies(const Element& element, const MjcfNamed& named, const ModelGraph& graph, GraphJoint& joint) {
  const std::string second = attribute(element, "body2"), relative = attribute(element, "relpose");
  joint.parent = find(element, named.bodies, requiredAttribute(element, "body1"), "body1");
  joint.child = second.empty() ? 0 : find(element, named.bodies, second, "body2");
  const Eigen::Isometry3d &a = graph.bodies[joint.parent].frame, &b = graph.bodies[joint.child].frame;
  const bool connects = std::string(element.Name()) == "connect";
  const std::string anchor = connects ? requiredAttribute(element, "anchor") : attribute(element, "anchor");
  const Vector3d point = anchor.empty() ? Vector3d::Zero() : vectorOf(element, anchor, "anchor");
  joint.centre = joint.centre_of_child = (connects ? a : b) * point;
  if (connects || relative.empty()) return;
  const std::vector<double> v = numbersOf(element, relative, 7, "relpose");
  const Eigen::Quaterniond q(v[3], v[4], v[5], v[6]);
  // A zero quaternion stands for the file's own pose. With an anchor, which is in body 2, relpose is the anchor's pose.
  if (q.norm() > 1e-12)
    joinFrames(a * placed({v[0], v[1], v[2]}, q.normalized().toRotationMatrix()),
               b * placed(point, Matrix3d::Identity()), joint);
}

const std::set<std::string> known_of_connect =
    wordsOf("name class active body1 body2 site1 site2 anchor solref solimp");
const std::set<std::string> known_of_weld =
    wordsOf("name class active body1 body2 site1 site2 anchor relpose torquescale solref solimp");

void readEquality(const Element& element, const MjcfDefaults& defaults, MjcfNamed& named, ModelGraph& graph) {
  const std::string kind = element.Name();
  const auto get = [&](const char* name) { return defaults.get(element, "", name, "equality"); };
  std::string name = named.nameOf(element, shown(kind));
  if (named.joints.count(name) != 0) name = fmt::format("{} {}", shown(kind), name);
  if (get("active") == "false") {
    graph.assumptions.push_back({"This constraint is switched off in the file and is left out", name});
    return;
  }
  if (kind != "connect" && kind != "weld")
    refuse(element, fmt::format("couples what it names ({}), as a gear does, which a scenario has no words for, "
                                "expected connect or weld; {}",
                                shown(kind), without_it));
  listUnknownAttributes(element, kind == "weld" ? known_of_weld : known_of_connect, graph.assumptions);
  const std::string scale = attribute(element, "torquescale");
  const bool holds_turn = kind == "weld" && (scale.empty() || numberOf(element, scale, "torquescale") != 0);
  GraphJoint joint = jointAt(element, name, holds_turn ? JointKind::fixed : JointKind::ball);
  joint.closure = true;
  if (const std::string site = attribute(element, "site1"); !site.empty())
    joinSites(element, site, named, joint);
  else
    joinBodies(element, named, graph, joint);
  graph.joints.push_back(joint);
}

void readActuator(const Element& element, const MjcfDefaults& defaults, const MjcfNamed& named, ModelGraph& graph) {
  const std::string kind = element.Name();
  const auto get = [&](const char* name) {
    const std::string own = defaults.get(element, "", name);
    return own.empty() ? defaults.get(element, "", name, "general") : own;
  };
  const std::string target = get("joint").empty() ? get("jointinparent") : get("joint");
  const bool known = kind == "motor" || kind == "position" || kind == "velocity" || kind == "general" ||
                     kind == "intvelocity" || kind == "cylinder" || kind == "dcmotor";
  if (!known || target.empty()) {
    std::string on = target.empty() ? "no joint" : "joint " + shown(target);
    for (const char* name : {"tendon", "site", "body", "cranksite"})
      if (const std::string other = get(name); !other.empty() && target.empty())
        on = fmt::format("{} {}", name, shown(other));
    refuse(element, fmt::format("a {} that acts on {}, expected a motor, position, velocity or general actuator on a "
                                "joint, whose effort is the joint's own",
                                shown(kind), on));
  }
  GraphJoint& joint = graph.joints[find(element, named.joints, target, "joint")];
  if (joint.driven)
    graph.assumptions.push_back({"Several actuators drive this joint: its effort is their sum", joint.name, 1, "1"});
  else
    graph.motors.push_back(joint.name);
  joint.driven = true;
  for (const char* more : {"armature", "damping"})
    if (const std::string value = get(more); !value.empty() && numberOf(element, value, more) != 0)
      refuse(element, fmt::format("{} {} of an actuator, which is not read; expected it at the joint", more, value));
  const std::string gear = get("gear");
  const double ratio = gear.empty() ? 1 : numbersOf(element, gear, 0, "gear").at(0);
  if (freedomsOf(joint.kind) != 1) return;  // a direction, for which a later refusal has the words
  if (ratio == 0) refuse(element, "a gear of zero, expected another");
  if (ratio != 1)
    graph.assumptions.push_back(
        {"The actuator's gear is left out: efforts are the joint's own", joint.name, ratio, "1"});
  if (kind != "motor" && kind != "general")
    graph.assumptions.push_back(
        {fmt::format("The {} servo is taken as a motor: its gains are the controller's", kind), joint.name, 1, "1"});
}

}  // namespace

std::string MjcfNamed::nameOf(const Element& element, const std::string& kind) {
  const std::string name = nameOr(element, kind);
  const int k = attribute(element, "name").empty() ? ++unnamed[name] : 1;
  return k == 1 ? name : fmt::format("{} ({})", name, k);
}

void readMjcfClosures(const Element& root, const MjcfDefaults& defaults, MjcfNamed& named, ModelGraph& graph) {
  eachChild(root, "equality", [&](const Element& e) {
    eachChild(e, nullptr, [&](const Element& c) { readEquality(c, defaults, named, graph); });
  });
}

void readMjcfActuators(const Element& root, const MjcfDefaults& defaults, const MjcfNamed& named, ModelGraph& graph) {
  eachChild(root, "actuator", [&](const Element& e) {
    eachChild(e, nullptr, [&](const Element& c) { readActuator(c, defaults, named, graph); });
  });
}

}  // namespace ursula::exchange

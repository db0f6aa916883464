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

constexpr double most_turned = 0.1;  ///< rad; more is no small gap but another pose

void sayGap(const std::string& name, const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, ModelGraph& graph) {
  const double gap = (a.translation() - b.translation()).norm();
  const double angle = Eigen::AngleAxisd(Matrix3d(a.linear().transpose() * b.linear())).angle();
  if (angle > most_turned)
    throw ImportError(fmt::format(
        "{} is turned by {:.3g} rad at the file's initial pose, expected the pose in which its bodies are one",
        shown(name), angle));
  if (gap > 1e-12) graph.assumptions.push_back({"This weld is open at the file's initial pose", name, gap, "m"});
  if (angle > 1e-9) graph.assumptions.push_back({"This weld is turned at the file's initial pose", name, angle, "rad"});
}

void joinSites(const Element& element, const std::string& first, const MjcfNamed& named, GraphJoint& joint,
               ModelGraph& graph) {
  const MjcfSite& a = find(element, named.sites, first, "site1");
  const MjcfSite& b = find(element, named.sites, requiredAttribute(element, "site2"), "site2");
  joint.parent = a.body;
  joint.child = b.body;
  joint.centre = a.frame.translation();
  joint.centre_of_child = b.frame.translation();
  if (joint.kind == JointKind::fixed) sayGap(joint.name, a.frame, b.frame, graph);
}

void joinBodies(const Element& element, const MjcfNamed& named, GraphJoint& joint, ModelGraph& graph) {
  const std::string second = attribute(element, "body2");
  joint.parent = find(element, named.bodies, requiredAttribute(element, "body1"), "body1");
  joint.child = second.empty() ? 0 : find(element, named.bodies, second, "body2");
  const Eigen::Isometry3d &a = graph.bodies[joint.parent].frame, &b = graph.bodies[joint.child].frame;
  if (joint.kind == JointKind::ball) {
    joint.centre = joint.centre_of_child = a * vectorOf(element, requiredAttribute(element, "anchor"), "anchor");
    return;
  }
  joint.centre = joint.centre_of_child = b.translation();
  const std::string relative = attribute(element, "relpose");
  if (relative.empty()) return;
  const std::vector<double> v = numbersOf(element, relative, 7, "relpose");
  const Eigen::Quaterniond q(v[3], v[4], v[5], v[6]);
  // A zero quaternion stands for the file's own pose.
  if (q.norm() > 1e-12) sayGap(joint.name, a * placed({v[0], v[1], v[2]}, q.normalized().toRotationMatrix()), b, graph);
}

const std::set<std::string> known_of_connect =
    wordsOf("name class active body1 body2 site1 site2 anchor solref solimp");
const std::set<std::string> known_of_weld =
    wordsOf("name class active body1 body2 site1 site2 anchor relpose torquescale solref solimp");

void readEquality(const Element& element, const MjcfDefaults& defaults, const MjcfNamed& named, ModelGraph& graph) {
  const std::string kind = element.Name();
  const auto get = [&](const char* name) { return defaults.get(element, "", name, "equality"); };
  const std::string name = nameOr(element, shown(kind));
  if (get("active") == "false") {
    graph.assumptions.push_back({"This constraint is switched off in the file and is left out", name});
    return;
  }
  if (kind != "connect" && kind != "weld")
    refuse(
        element,
        fmt::format(
            "couples what it names ({}), as a gear does, which a scenario has no words for, expected connect or weld",
            shown(kind)));
  listUnknownAttributes(element, kind == "weld" ? known_of_weld : known_of_connect, graph.assumptions);
  GraphJoint joint = jointAt(element, name, kind == "connect" ? JointKind::ball : JointKind::fixed);
  joint.closure = true;
  if (const std::string site = attribute(element, "site1"); !site.empty())
    joinSites(element, site, named, joint, graph);
  else
    joinBodies(element, named, joint, graph);
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
  if (!known || target.empty())
    refuse(element,
           fmt::format("a {} that acts on {}, expected a motor, position, velocity or general actuator on a joint",
                       shown(kind), target.empty() ? "no joint" : "joint " + shown(target)));
  GraphJoint& joint = graph.joints[find(element, named.joints, target, "joint")];
  if (joint.driven)
    graph.assumptions.push_back({"Several actuators drive this joint: its effort is their sum", joint.name, 1, "1"});
  else
    graph.motors.push_back(joint.name);
  joint.driven = true;
  const std::string gear = get("gear");
  const double ratio = gear.empty() ? 1 : numbersOf(element, gear, 0, "gear").at(0);
  if (ratio == 0) refuse(element, "a gear of zero, expected another");
  if (ratio != 1)
    graph.assumptions.push_back(
        {"The actuator's gear is left out: efforts are the joint's own", joint.name, ratio, "1"});
  if (kind != "motor" && kind != "general")
    graph.assumptions.push_back(
        {fmt::format("The {} servo is taken as a motor: its gains are the controller's", kind), joint.name, 1, "1"});
}

}  // namespace

void readMjcfClosures(const Element& root, const MjcfDefaults& defaults, const MjcfNamed& named, ModelGraph& graph) {
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

// Reads URDF: a tree of links, motors by transmissions or ros2_control, and closures by extensions.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "base/text.h"
#include "parts/exchange/read/sdf_parts.h"
#include "parts/exchange/read/urdf_parts.h"

namespace ursula::exchange {
namespace {

Eigen::Isometry3d originOf(const Element& element) {
  const Element* origin = onlyChild(element, "origin");
  if (origin == nullptr) return Eigen::Isometry3d::Identity();
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  for (const tinyxml2::XMLAttribute* a = origin->FirstAttribute(); a != nullptr; a = a->Next()) {
    const std::string name = a->Name();
    if (name == "xyz")
      out.translation() = vectorOf(*origin, a->Value(), "xyz");
    else if (name == "rpy")
      out.linear() = rollPitchYaw(vectorOf(*origin, a->Value(), "rpy"));
    else
      refuse(*origin, fmt::format("{}, which is not read, expected xyz and rpy", shown(name)));
  }
  return out;
}

const std::set<std::string> known_in_robot = wordsOf(
    "link joint drake:joint loop_joint constraint drake:ball_constraint material transmission ros2_control gazebo "
    "mujoco sensor frame");
const std::set<std::string> known_in_urdf_link =
    wordsOf("inertial visual collision self_collision_checking contact sensor");

const std::map<std::string, JointKind> kinds_of_joint = {
    {"fixed", JointKind::fixed},         {"floating", JointKind::free},       {"ball", JointKind::ball},
    {"spherical", JointKind::ball},      {"revolute", JointKind::revolute},   {"continuous", JointKind::revolute},
    {"prismatic", JointKind::prismatic}, {"universal", JointKind::universal},
};

class UrdfReader {
 public:
  UrdfReader(const Element& root, const std::filesystem::path& file) : root_(root), file_(file) {
    graph_.format = ModelFormat::urdf;
    graph_.name = attribute(root, "name");
  }

  ModelGraph read() {
    takeLinks();
    listUnknown(root_, known_in_robot, graph_.assumptions);
    eachChild(root_, "joint", [this](const Element& e) { takeJoint(e); });
    eachChild(root_, "drake:joint", [this](const Element& e) { takeJoint(e); });
    refuseCouplings(root_, known_in_robot,
                    [this](const std::string& word) { return links_.count(word) + joints_.count(word) != 0; });
    placeTree();
    for (const Element* element : elements_) readJoint(*element);
    readUrdfClosures(root_, file_, links_, graph_);
    readMotors();
    readUrdfGazebo(root_, links_, graph_);
    readUrdfMujoco(root_, link_elements_, graph_);
    return graph_;
  }

 private:
  void takeLinks() {
    eachChild(root_, "link", [this](const Element& e) {
      GraphBody body;
      body.name = requiredAttribute(e, "name");
      body.line = e.GetLineNum();
      if (!links_.emplace(body.name, graph_.bodies.size()).second)
        refuse(e, "a second link of that name, expected names of their own");
      listUnknown(e, known_in_urdf_link, graph_.assumptions);
      graph_.bodies.push_back(body);
      link_elements_.push_back(&e);
    });
    if (graph_.bodies.empty()) refuse(root_, "no <link>, expected some");
  }

  std::size_t linkOf(const Element& joint, const char* side) const {
    const Element* child = onlyChild(joint, side);
    const std::string name = child == nullptr ? "" : attribute(*child, "link");
    if (const auto found = links_.find(name); found != links_.end()) return found->second;
    std::vector<std::string> names;
    for (const GraphBody& body : graph_.bodies)
      if (names.size() < 1000) names.push_back(body.name);
    refuse(joint, fmt::format("<{}> '{}': no link has that name{}", side, shown(name), didYouMean(name, names)));
  }

  void takeJoint(const Element& element) {
    const std::string name = requiredAttribute(element, "name");
    if (!joints_.emplace(name, elements_.size()).second)
      refuse(element, "a second joint of that name, expected names of their own");
    elements_.push_back(&element);
    ends_.emplace_back(linkOf(element, "parent"), linkOf(element, "child"));
  }

  /// Places the links from the root on. Throws ImportError unless every other link is the child of one joint.
  void placeTree() {
    std::vector<std::size_t> joint_of(graph_.bodies.size(), elements_.size());
    std::vector<std::vector<std::size_t>> children(graph_.bodies.size());
    for (std::size_t j = 0; j < elements_.size(); ++j) {
      const auto [parent, child] = ends_[j];
      if (joint_of[child] != elements_.size())
        refuse(*elements_[j], fmt::format("link {} is the child of two joints, expected a tree; a loop is closed by an "
                                          "extension, or by --close A:B",
                                          shown(graph_.bodies[child].name)));
      joint_of[child] = j;
      children[parent].push_back(j);
    }
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < joint_of.size(); ++i)
      if (joint_of[i] == elements_.size()) order.push_back(i);
    if (order.size() != 1)
      refuse(root_, order.empty()
                        ? "its joints go in a circle, expected a tree"
                        : fmt::format("{} links have no parent ({}, {}, …), expected one root", order.size(),
                                      shown(graph_.bodies[order[0]].name), shown(graph_.bodies[order[1]].name)));
    graph_.bodies[order[0]].fixed = true;
    if (graph_.bodies[order[0]].name != "world")
      graph_.assumptions.push_back(
          {fmt::format("{}: the file does not say what does", root_stands_still), graph_.bodies[order[0]].name});
    for (std::size_t k = 0; k < order.size(); ++k)
      for (const std::size_t j : children[order[k]]) {
        graph_.bodies[ends_[j].second].frame = graph_.bodies[order[k]].frame * originOf(*elements_[j]);
        order.push_back(ends_[j].second);
      }
    if (order.size() != graph_.bodies.size()) refuse(root_, "some of its joints go in a circle, expected a tree");
    for (std::size_t i = 0; i < graph_.bodies.size(); ++i) readInertial(*link_elements_[i], graph_.bodies[i]);
  }

  void readInertial(const Element& link, GraphBody& body) {
    const Element* inertial = onlyChild(link, "inertial");
    body.center_of_mass = body.frame.translation();
    if (inertial == nullptr) return;
    const Element* mass = onlyChild(*inertial, "mass");
    const Element* inertia = onlyChild(*inertial, "inertia");
    listUnknown(*inertial, {"origin", "mass", "inertia"}, graph_.assumptions);
    if (mass == nullptr || inertia == nullptr)
      refuse(link, fmt::format("no <{}> in <inertial>, expected one", mass == nullptr ? "mass" : "inertia"));
    body.mass = numberOf(*mass, requiredAttribute(*mass, "value"), "mass");
    if (body.mass < 0) refuse(*mass, fmt::format("a mass of {}, expected none below zero", body.mass));
    const auto missing = [&](std::size_t k, const char* name) {
      if (k < 3) requiredAttribute(*inertia, name);
      graph_.assumptions.push_back({fmt::format("The file gives no {}: zero was taken", name), body.name, 0, "kg·m²"});
      return 0.0;
    };
    takeInertia(*inertia, attribute, body.frame * originOf(*inertial), missing, body);
  }

  void readJoint(const Element& element) {
    const std::size_t index = joints_.at(attribute(element, "name"));
    listUnknown(element,
                {"parent", "child", "origin", "axis", "limit", "dynamics", "mimic", "safety_controller", "calibration"},
                graph_.assumptions);
    const std::string type = requiredAttribute(element, "type");
    GraphJoint joint = jointAt(element, attribute(element, "name"));
    joint.parent = ends_[index].first;
    joint.child = ends_[index].second;
    const Eigen::Isometry3d& at = graph_.bodies[joint.child].frame;
    joint.centre = joint.centre_of_child = at.translation();
    joint.rotor_inertia = drakeRotorInertia(element);
    if (element.FirstChildElement("mimic") || element.FirstChildElement("drake:mimic"))
      refuse(element,
             fmt::format("mimic: it follows another joint, which a scenario has no words for; {}", without_it));
    const auto kind = kinds_of_joint.find(type);
    if (kind == kinds_of_joint.end())
      refuse(element,
             fmt::format(
                 "a {} joint, which a scenario has no words for, expected revolute, continuous, prismatic or fixed{}",
                 shown(type),
                 type == "planar" ? "; two slides and a hinge are the same" : fmt::format("; {}", without_it)));
    joint.kind = kind->second;
    const Element* axis = onlyChild(element, "axis");
    const std::string xyz = axis == nullptr ? "" : attribute(*axis, "xyz");
    if (axis != nullptr) listUnknownAttributes(*axis, {"xyz"}, graph_.assumptions);
    const Vector3d given = xyz.empty() ? Vector3d::UnitX() : vectorOf(*axis, xyz, "axis");
    // Other joints have no axis, whatever the file gives them; CAD writes zero for fixed ones.
    const bool has_axis = joint.kind == JointKind::revolute || joint.kind == JointKind::prismatic;
    joint.axis = {has_axis ? Vector3d(at.linear() * directionOf(element, given, "axis")) : at.linear().col(0),
                  at.linear().col(1)};
    takeLimits(element, type, joint);
    index_of_.emplace(joint.name, graph_.joints.size());
    graph_.joints.push_back(joint);
  }

  void takeLimits(const Element& element, const std::string& type, GraphJoint& joint) {
    if (const Element* limit = onlyChild(element, "limit"); limit != nullptr && type != "continuous") {
      // URDF's default for both is zero, so a joint that cannot move is one without given limits.
      joint.lower = joint.upper = 0;
      takeRange(*limit, attribute, joint);
      requireRange(element, joint);
      if (joint.lower == joint.upper && !attribute(*limit, "lower").empty())
        graph_.assumptions.push_back(
            {"The file's limits hold this joint where it is; it was taken as free to move", joint.name});
      if (joint.lower == joint.upper) joint.lower = -(joint.upper = std::numeric_limits<double>::infinity());
    }
    const Element* dynamics = onlyChild(element, "dynamics");
    if (dynamics == nullptr) return;
    listUnknownAttributes(*dynamics, {"damping", "friction", "ursula:smoothing_speed"}, graph_.assumptions);
    takeRubbing(element, *dynamics, attribute, joint);
  }

  /// Reads transmissions, and ros2_control joints that take commands.
  void readMotors() {
    eachChild(root_, "transmission", [this](const Element& e) {
      const Element* actuator = e.FirstChildElement("actuator");
      for (const char* part : {"joint", "actuator"})
        if (const Element* first = e.FirstChildElement(part);
            first != nullptr && first->NextSiblingElement(part) != nullptr)
          refuse(e, fmt::format("a second <{}>: it couples joints, which a scenario has no words for", part));
      eachChild(e, "joint", [&](const Element& of) {
        GraphJoint& joint = driven(of, attribute(of, "name"));
        if (actuator == nullptr) return;
        if (const double rotor = drakeRotorInertia(*actuator); rotor != 0) joint.rotor_inertia = rotor;
        const Element* reduction = onlyChild(*actuator, "mechanicalReduction");
        const double ratio = reduction == nullptr || textOf(*reduction).empty()
                                 ? 1
                                 : numberOf(*reduction, textOf(*reduction), "mechanicalReduction");
        if (ratio != 1)
          graph_.assumptions.push_back(
              {"The transmission's reduction is left out: efforts are the joint's own", joint.name, ratio, "1"});
      });
    });
    eachChild(root_, "ros2_control", [this](const Element& e) {
      eachChild(e, "joint", [this](const Element& of) {
        eachChild(of, "param", [&](const Element& param) {
          if (attribute(param, "name") == "mimic" && attribute(of, "mimic") != "false")
            refuse(of,
                   fmt::format("mimic: it follows another joint, which a scenario has no words for; {}", without_it));
        });
        if (of.FirstChildElement("command_interface") != nullptr) driven(of, attribute(of, "name"));
      });
    });
  }

  GraphJoint& driven(const Element& at, const std::string& name) {
    const auto found = index_of_.find(name);
    if (found == index_of_.end()) refuse(at, fmt::format("joint '{}': no joint has that name", shown(name)));
    GraphJoint& joint = graph_.joints[found->second];
    if (!joint.driven) graph_.motors.push_back(joint.name);
    joint.driven = true;
    return joint;
  }

  const Element& root_;
  const std::filesystem::path& file_;
  UrdfLinks links_;
  std::vector<const Element*> link_elements_, elements_;
  std::vector<std::pair<std::size_t, std::size_t>> ends_;
  std::unordered_map<std::string, std::size_t> joints_, index_of_;
  ModelGraph graph_;
};

}  // namespace

ModelGraph readUrdf(const Element& root, const std::filesystem::path& file) { return UrdfReader(root, file).read(); }

}  // namespace ursula::exchange

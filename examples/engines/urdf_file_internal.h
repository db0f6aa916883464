#pragma once

// The machine of a file that `ursula export --format urdf` wrote: bodies, joints, the points that close its loops, and
// its motors in order. Links without inertia stay without, unlike in many readers. URDF has no gravity: that is read
// from the scenario, whose path is in the environment.

#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace closed_chain {

struct UrdfLink {
  std::string name;
  double mass = 0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the mass centre, in the link's axes
};

struct UrdfJoint {
  std::string name, type;
  int parent = -1, child = -1;
  Eigen::Isometry3d origin = Eigen::Isometry3d::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  double damping = 0, friction = 0, rotor = 0;
  int coordinate = -1;  ///< −1: a fixed joint
};

/// Points of two bodies that coincide, each in its body's frame.
struct UrdfClosure {
  std::array<int, 2> body{};
  std::array<Eigen::Vector3d, 2> point;
};

class UrdfFile {
 public:
  /// Throws std::runtime_error.
  explicit UrdfFile(const std::string& file) {
    if (document_.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS) throw std::runtime_error(document_.ErrorStr());
    const tinyxml2::XMLElement* robot = document_.FirstChildElement("robot");
    if (robot == nullptr) throw std::runtime_error(file + ": expected <robot>");
    each(*robot, "link", [this](const Element& link) { links.push_back(linkOf(link)); });
    each(*robot, "joint", [this](const Element& joint) { joints.push_back(jointOf(joint)); });
    fromTheBaseOutwards();
    each(*robot, "transmission", [this](const Element& transmission) { addMotor(transmission); });
    each(*robot, "drake:ball_constraint", [this](const Element& closure) { closures.push_back(closureOf(closure)); });
    platform = linkNamed("platform");
  }

  std::vector<UrdfLink> links;
  std::vector<UrdfJoint> joints;  ///< a joint stands after the one that carries it
  std::vector<UrdfClosure> closures;
  std::vector<int> motors;  ///< joints, in the order of the transmissions
  int platform = -1, coordinates = 0;

  int linkNamed(const std::string& name) const {
    const auto found = std::find_if(links.begin(), links.end(), [&name](const UrdfLink& l) { return l.name == name; });
    if (found == links.end()) throw std::runtime_error("no link " + name);
    return static_cast<int>(found - links.begin());
  }

 private:
  using Element = tinyxml2::XMLElement;

  template <class Visit>
  static void each(const Element& parent, const char* name, Visit visit) {
    for (const Element* at = parent.FirstChildElement(name); at; at = at->NextSiblingElement(name)) visit(*at);
  }

  static const Element& child(const Element& of, const char* name) {
    if (const Element* found = of.FirstChildElement(name)) return *found;
    throw std::runtime_error(std::string(of.Name()) + ": expected <" + name + ">");
  }

  static std::string text(const Element& of, const char* name) {
    if (const char* found = of.Attribute(name)) return found;
    throw std::runtime_error(std::string(of.Name()) + ": expected the attribute " + name);
  }

  static Eigen::Vector3d vector(const Element& of, const char* name) {
    Eigen::Vector3d out;
    std::istringstream words(text(of, name));
    if (!(words >> out(0) >> out(1) >> out(2))) throw std::runtime_error(std::string(of.Name()) + ": expected numbers");
    return out;
  }

  /// Roll, pitch and yaw turn about fixed axes, in this order.
  static Eigen::Isometry3d pose(const Element& of) {
    using Eigen::AngleAxisd, Eigen::Vector3d;
    Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
    const Element* origin = of.FirstChildElement("origin");
    if (origin == nullptr) return out;
    const Vector3d turn = vector(*origin, "rpy");
    out.linear() = (AngleAxisd(turn(2), Vector3d::UnitZ()) * AngleAxisd(turn(1), Vector3d::UnitY()) *
                    AngleAxisd(turn(0), Vector3d::UnitX()))
                       .toRotationMatrix();
    out.translation() = vector(*origin, "xyz");
    return out;
  }

  static UrdfLink linkOf(const Element& link) {
    UrdfLink out;
    out.name = text(link, "name");
    const Element* inertial = link.FirstChildElement("inertial");
    if (inertial == nullptr) return out;
    const Eigen::Isometry3d at = pose(*inertial);
    const Element& i = child(*inertial, "inertia");
    const auto entry = [&i](const char* name) { return i.DoubleAttribute(name); };
    Eigen::Matrix3d inertia;
    inertia << entry("ixx"), entry("ixy"), entry("ixz"), entry("ixy"), entry("iyy"), entry("iyz"), entry("ixz"),
        entry("iyz"), entry("izz");
    out.mass = child(*inertial, "mass").DoubleAttribute("value");
    out.center = at.translation();
    out.inertia = at.linear() * inertia * at.linear().transpose();
    return out;
  }

  UrdfJoint jointOf(const Element& joint) const {
    UrdfJoint out;
    out.name = text(joint, "name");
    out.type = text(joint, "type");
    out.parent = linkNamed(text(child(joint, "parent"), "link"));
    out.child = linkNamed(text(child(joint, "child"), "link"));
    out.origin = pose(joint);
    if (const Element* axis = joint.FirstChildElement("axis")) out.axis = vector(*axis, "xyz").normalized();
    if (const Element* dynamics = joint.FirstChildElement("dynamics")) {
      out.damping = dynamics->DoubleAttribute("damping");
      out.friction = dynamics->DoubleAttribute("friction");
    }
    return out;
  }

  void fromTheBaseOutwards() {
    std::vector<UrdfJoint> sorted;
    std::vector<int> waiting(links.size(), 0);
    for (const UrdfJoint& joint : joints) ++waiting[static_cast<std::size_t>(joint.child)];
    while (!joints.empty()) {
      const auto next = std::find_if(joints.begin(), joints.end(), [&waiting](const UrdfJoint& joint) {
        return waiting[static_cast<std::size_t>(joint.parent)] == 0;
      });
      if (next == joints.end()) throw std::runtime_error("expected a tree of links");
      --waiting[static_cast<std::size_t>(next->child)];
      if (next->type != "fixed") next->coordinate = coordinates++;
      sorted.push_back(*next);
      joints.erase(next);
    }
    joints = sorted;
  }

  void addMotor(const Element& transmission) {
    const std::string name = text(child(transmission, "joint"), "name");
    const auto joint =
        std::find_if(joints.begin(), joints.end(), [&name](const UrdfJoint& j) { return j.name == name; });
    if (joint == joints.end() || joint->coordinate < 0) throw std::runtime_error("no motor can drive " + name);
    const Element* rotor = child(transmission, "actuator").FirstChildElement("drake:rotor_inertia");
    if (rotor != nullptr) joint->rotor = rotor->DoubleAttribute("value");
    motors.push_back(static_cast<int>(joint - joints.begin()));
  }

  UrdfClosure closureOf(const Element& closure) const {
    UrdfClosure out;
    out.body = {linkNamed(text(child(closure, "drake:ball_constraint_body_A"), "name")),
                linkNamed(text(child(closure, "drake:ball_constraint_body_B"), "name"))};
    out.point = {vector(child(closure, "drake:ball_constraint_p_AP"), "value"),
                 vector(child(closure, "drake:ball_constraint_p_BQ"), "value")};
    return out;
  }

  tinyxml2::XMLDocument document_;
};

/// `gravity = [x, y, z]` of the scenario that is judged; without one, 9.81 m/s² downwards.
inline Eigen::Vector3d gravityOfScenario() {
  Eigen::Vector3d out(0, 0, -9.81);
  const char* path = std::getenv("URSULA_SCENARIO");
  std::ifstream file(path == nullptr ? "" : path);
  static const std::regex pattern(R"(^\s*gravity\s*=\s*\[([^\]]*)\])");
  std::smatch found;
  for (std::string line; std::getline(file, line);) {
    if (!std::regex_search(line, found, pattern)) continue;
    std::string numbers = found[1];
    std::replace(numbers.begin(), numbers.end(), ',', ' ');
    std::istringstream words(numbers);
    if (!(words >> out(0) >> out(1) >> out(2))) throw std::runtime_error("expected three numbers for gravity: " + line);
  }
  return out;
}

}  // namespace closed_chain

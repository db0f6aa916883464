#include "parts/exchange/read/urdf_parts.h"

#include <fmt/format.h>
#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "base/text.h"
#include "base/text_source.h"
#include "parts/exchange/read/sdf_parts.h"

namespace ursula::exchange {
namespace {

/// The few forms of YAML in a robot.yaml: `key: word`, `key: [a, [b, c]]`, and lists of `- a` below a key. Nested lists
/// are flattened.
using SmallYaml = std::map<std::string, std::vector<std::string>>;

/// Splits at brackets, commas, list dashes and white space; drops quotes.
void appendWords(const std::string& text, std::vector<std::string>& out) {
  std::string word;
  char quote = 0;
  const auto end = [&] {
    if (!word.empty() && word != "-") out.push_back(word);
    word.clear();
  };
  for (const char c : text) {
    if (quote != 0) {
      if (c == quote)
        quote = 0;
      else
        word += c;
    } else if (c == '\'' || c == '"') {
      quote = c;
    } else if (c == '#') {
      break;
    } else if (c == '[' || c == ']' || c == ',' || c == ' ' || c == '\t' || c == '\r') {
      end();
    } else {
      word += c;
    }
  }
  end();
}

/// Throws ImportError for any other form.
SmallYaml readSmallYaml(const std::string& text, const std::string& name) {
  SmallYaml out;
  std::istringstream lines(text);
  std::string line, key;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::size_t from = line.find_first_not_of(" \t\r");
    if (from == std::string::npos || line[from] == '#' || line.compare(0, 3, "---") == 0) continue;
    if (line.find_first_of("{&*|>!") != std::string::npos)
      throw ImportError(
          fmt::format("{}:{}: '{}' is neither a list nor a word, expected `key: [a, b]`", name, number, shown(line)));
    const std::size_t colon = line.find(':');
    if (from == 0 && line[0] != '-' && line[0] != '[' && colon != std::string::npos) {
      key = line.substr(0, colon);
      out[key];
      appendWords(line.substr(colon + 1), out[key]);
    } else if (key.empty()) {
      throw ImportError(fmt::format("{}:{}: '{}' is of no key, expected `key: [a, b]`", name, number, shown(line)));
    } else {
      appendWords(line, out[key]);
    }
  }
  return out;
}

const std::map<std::string, JointKind> kinds_of_closure = {{"ball", JointKind::ball},
                                                           {"fixed", JointKind::fixed},
                                                           {"revolute", JointKind::revolute},
                                                           {"continuous", JointKind::revolute},
                                                           {"prismatic", JointKind::prismatic}};

class Closer {
 public:
  Closer(const UrdfLinks& links, ModelGraph& graph) : links_(links), graph_(graph) {}

  std::size_t link(const Element& at, const std::string& name) const {
    const auto found = links_.find(name);
    if (found == links_.end()) refuse(at, fmt::format("link '{}': no link has that name", shown(name)));
    return found->second;
  }

  void isaac(const Element& element) {
    const std::string type = requiredAttribute(element, "type");
    if (type != "spherical") refuse(element, fmt::format("a {} loop joint, expected a spherical one", shown(type)));
    // Isaac Sim's own documentation writes link1 twice.
    const Element* first = element.FirstChildElement("link1");
    const Element* second = element.FirstChildElement("link2");
    if (first != nullptr && second == nullptr) second = first->NextSiblingElement("link1");
    if (first == nullptr || second == nullptr) refuse(element, "no <link1> or no <link2>, expected both");
    GraphJoint ball = closure(element, JointKind::ball);
    const auto side = [&](const Element& e, std::size_t& body, Vector3d& centre) {
      body = link(e, requiredAttribute(e, "link"));
      const std::string xyz = attribute(e, "xyz");
      centre = graph_.bodies[body].frame * (xyz.empty() ? Vector3d::Zero() : vectorOf(e, xyz, "xyz"));
    };
    side(*first, ball.parent, ball.centre);
    side(*second, ball.child, ball.centre_of_child);
    graph_.joints.push_back(ball);
  }

  /// Reads the joint as in SDF 1.7, to which URDF is converted today: the pose is in the child, the axis in the joint's
  /// frame.
  void gazebo(const Element& element) {
    const std::string type = requiredAttribute(element, "type");
    const auto kind = kinds_of_closure.find(type);
    if (kind == kinds_of_closure.end())
      refuse(element,
             fmt::format("a {} joint that closes a loop, expected ball, revolute, prismatic or fixed", shown(type)));
    GraphJoint joint = closure(element, kind->second);
    joint.parent = link(element, childText(element, "parent"));
    joint.child = link(element, childText(element, "child"));
    Eigen::Isometry3d at = graph_.bodies[joint.child].frame;
    if (const std::string pose = childText(element, "pose"); !pose.empty()) {
      const std::vector<double> v = numbersOf(element, pose, 6, "<pose>");
      at = at * placed({v[0], v[1], v[2]}, rollPitchYaw({v[3], v[4], v[5]}));
    }
    joint.centre = joint.centre_of_child = at.translation();
    if (joint.kind == JointKind::revolute || joint.kind == JointKind::prismatic) {
      const Element* axis = element.FirstChildElement("axis");
      const std::string xyz = axis == nullptr ? "" : childText(*axis, "xyz");
      if (xyz.empty()) refuse(element, "no <axis> with <xyz>, expected one");
      const Vector3d given = directionOf(element, vectorOf(element, xyz, "<xyz>"), "<xyz>");
      joint.axis[0] = at.linear() * given;
      if (!joint.axis[0].isApprox(given, 1e-9))
        graph_.assumptions.push_back(
            {"The axis is taken in the joint's frame, as SDF 1.7 has it; in the model's, as before 1.5, it would turn "
             "by this",
             joint.name, std::acos(std::clamp(joint.axis[0].dot(given), -1.0, 1.0)), "rad"});
    }
    graph_.joints.push_back(joint);
  }

  /// Reads `closed_loop: [[A, B], …]`, `type: [3d, …]`, `name_mot: TEXT`.
  void yaml(const std::filesystem::path& file) {
    SmallYaml text = readSmallYaml(readText(file, {1 << 20, "robot.yaml"}), file.filename().string());
    const std::vector<std::string> types = text["type"], ends = text["closed_loop"];
    if (ends.size() % 2 != 0) throw ImportError("robot.yaml: closed_loop has an odd number of frames, expected pairs");
    for (std::size_t k = 0; k + 1 < ends.size(); k += 2) {
      const std::string type = types.empty() ? "6d" : types[std::min(k / 2, types.size() - 1)];
      if (type != "3d" && type != "3D" && type != "6d" && type != "6D")
        throw ImportError(fmt::format("robot.yaml: type '{}', expected 3d or 6d", shown(type)));
      pair(ends[k], ends[k + 1], type[0] == '3' ? JointKind::ball : JointKind::fixed, "robot.yaml");
    }
    takeMotors(text["name_mot"]);
  }

  /// Marks the driven joints. A single word is a part of the motors' names; in a list each word is a full name, and the
  /// list is the motors' order.
  void takeMotors(const std::vector<std::string>& motors) {
    for (const std::string& motor : motors) {
      bool found = false;
      for (GraphJoint& joint : graph_.joints) {
        const bool is_meant = motors.size() > 1 ? joint.name == motor : joint.name.find(motor) != std::string::npos;
        if (joint.closure || motor.empty() || !is_meant) continue;
        if (motors.size() > 1 && !joint.driven) graph_.motors.push_back(joint.name);
        joint.driven = found = true;
      }
      if (!found) throw ImportError(fmt::format("robot.yaml: name_mot '{}': no joint has that name", shown(motor)));
    }
  }

  /// Joins the links closing_NAME_1 and closing_NAME_2 by a ball.
  void named() {
    std::set<std::string> first;
    for (const auto& [name, index] : links_)
      if (name.rfind("closing_", 0) == 0 && name.size() > 10 && name.compare(name.size() - 2, 2, "_1") == 0)
        first.insert(name.substr(0, name.size() - 2));
    for (const std::string& name : first)
      if (links_.count(name + "_2") != 0) pair(name + "_1", name + "_2", JointKind::ball, "by their names");
  }

 private:
  static GraphJoint closure(const Element& element, JointKind kind) {
    GraphJoint out = jointAt(element, nameOr(element, "closure"), kind);
    out.closure = true;
    return out;
  }

  void pair(const std::string& a, const std::string& b, JointKind kind, const char* from) {
    for (const std::string& name : {a, b})
      if (links_.count(name) == 0) throw ImportError(fmt::format("{}: no link has the name '{}'", from, shown(name)));
    GraphJoint joint;
    joint.name = a + ":" + b;
    joint.kind = kind;
    joint.closure = true;
    joint.parent = links_.at(a);
    joint.child = links_.at(b);
    joint.centre = graph_.bodies[joint.parent].frame.translation();
    joint.centre_of_child = graph_.bodies[joint.child].frame.translation();
    joint.line = graph_.bodies[joint.child].line;
    graph_.assumptions.push_back(
        {fmt::format("These frames are joined, {}, as {}", from, kind == JointKind::ball ? "a ball" : "one body"),
         joint.name, (joint.centre - joint.centre_of_child).norm(), "m"});
    graph_.joints.push_back(joint);
  }

  const UrdfLinks& links_;
  ModelGraph& graph_;
};

/// Reads closures that a second tool repeats: known ones are skipped, others are refused.
template <class Read>
void passOver(ModelGraph& graph, const UrdfLinks& links, std::size_t first, const Read& read) {
  ModelGraph other = graph;
  Closer closer(links, other);
  read(closer);
  for (std::size_t k = graph.joints.size(); k < other.joints.size(); ++k) {
    const GraphJoint& joint = other.joints[k];
    const auto is_there = [&](const GraphJoint& one) {
      return std::minmax(one.parent, one.child) == std::minmax(joint.parent, joint.child) && one.kind == joint.kind;
    };
    if (std::none_of(graph.joints.begin() + static_cast<std::ptrdiff_t>(first), graph.joints.end(), is_there))
      throw ImportError(
          fmt::format("joint {} closes a loop between {} and {} in the words of a second tool, which others of the "
                      "file do not; expected every loop to be closed in the same words",
                      shown(joint.name), shown(graph.bodies[joint.parent].name), shown(graph.bodies[joint.child].name)),
          joint.line);
    graph.assumptions.push_back(
        {"This joint closes a loop that the file closes in another tool's words as well, and is left out", joint.name,
         1, "1"});
  }
}

}  // namespace

void readUrdfClosures(const Element& robot, const std::filesystem::path& file, const UrdfLinks& links,
                      ModelGraph& graph) {
  Closer closer(links, graph);
  const std::size_t before = graph.joints.size();
  const auto found = [&] { return graph.joints.size() > before; };
  readDrakeConstraints(robot, graph, [&](const Element& at, const std::string& name) { return closer.link(at, name); });
  const auto isaac = [&](Closer& by) { eachChild(robot, "loop_joint", [&](const Element& e) { by.isaac(e); }); };
  const auto gazebo = [&](Closer& by) {
    eachChild(robot, "gazebo",
              [&](const Element& e) { eachChild(e, "joint", [&](const Element& joint) { by.gazebo(joint); }); });
  };
  const std::size_t after_drake = graph.joints.size();
  if (!found()) isaac(closer);
  const std::size_t after_isaac = graph.joints.size();
  if (!found()) gazebo(closer);
  if (after_drake > before) passOver(graph, links, before, isaac);
  if (after_isaac > before) passOver(graph, links, before, gazebo);
  const std::filesystem::path yaml = file.parent_path() / "robot.yaml";
  std::error_code none;
  if (!found() && std::filesystem::is_regular_file(yaml, none)) closer.yaml(yaml);
  if (!found()) closer.named();
}

}  // namespace ursula::exchange

#include "parts/exchange/read/urdf_parts.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/text.h"
#include "parts/exchange/read/sdf_parts.h"

namespace ursula::exchange {
namespace {

const std::map<std::string, JointKind> kinds_of_closure = {{"ball", JointKind::ball},
                                                           {"fixed", JointKind::fixed},
                                                           {"revolute", JointKind::revolute},
                                                           {"continuous", JointKind::revolute},
                                                           {"prismatic", JointKind::prismatic}};

const std::set<std::string> known_in_yaml = wordsOf("name closed_loop type name_mot joint_name joint_type");

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
    std::vector<const Element*> ends;
    eachChild(element, nullptr, [&](const Element& e) {
      // Isaac Sim's own documentation writes link1 twice.
      if (std::string(e.Name()) == "link1" || std::string(e.Name()) == "link2") ends.push_back(&e);
    });
    if (ends.size() != 2) refuse(element, fmt::format("{} of <link1> and <link2>, expected both", ends.size()));
    const auto frame = [&](const Element& e) { return frameOn(e, attribute(e, "xyz"), attribute(e, "rpy")); };
    join(element, JointKind::ball, frame(*ends[0]), frame(*ends[1]));
  }

  /// Reads the proposed <constraint>: parent_origin in the parent and child_origin in the child are one frame.
  void constraint(const Element& element) {
    const std::string type = requiredAttribute(element, "type");
    if (type != "spherical" && type != "fixed")
      refuse(element, fmt::format("a {} constraint, expected a spherical or a fixed one", shown(type)));
    listUnknown(element, {"parent", "parent_origin", "child", "child_origin"}, graph_.assumptions);
    const auto frame = [&](const char* side, const char* origin) {
      const Element* at = onlyChild(element, side);
      const Element* of = onlyChild(element, origin);
      if (at == nullptr) refuse(element, fmt::format("no <{}>, expected one", side));
      return of == nullptr ? frameOn(*at, "", "") : frameOn(*at, attribute(*of, "xyz"), attribute(*of, "rpy"));
    };
    join(element, type == "fixed" ? JointKind::fixed : JointKind::ball, frame("parent", "parent_origin"),
         frame("child", "child_origin"));
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
    const Element* pose = onlyChild(element, "pose");
    const Element* axis = onlyChild(element, "axis");
    const Element* given_xyz = axis == nullptr ? nullptr : onlyChild(*axis, "xyz");
    for (const auto& [of, name] :
         {std::pair(pose, "relative_to"), std::pair(pose, "frame"), std::pair(given_xyz, "expressed_in")})
      if (of != nullptr && !attribute(*of, name).empty())
        refuse(element,
               fmt::format("{}='{}', which is not read in <gazebo>, expected none", name, shown(attribute(*of, name))));
    if (axis != nullptr && axis->FirstChildElement("use_parent_model_frame") != nullptr)
      refuse(element, "use_parent_model_frame, which SDF 1.7 has no more, expected an axis in the joint's frame");
    const Eigen::Isometry3d at = graph_.bodies[joint.child].frame * sdfPoseOf(element);
    joint.centre = joint.centre_of_child = at.translation();
    if (joint.kind == JointKind::revolute || joint.kind == JointKind::prismatic) {
      const std::string xyz = axis == nullptr ? "" : childText(*axis, "xyz");
      if (xyz.empty()) refuse(element, "no <axis> with <xyz>, expected one");
      const Vector3d given = directionOf(element, vectorOf(element, xyz, "<xyz>"), "<xyz>");
      joint.axis[0] = at.linear() * given;
      if (!joint.axis[0].isApprox(given, 1e-9))
        graph_.assumptions.push_back(
            {"The axis is taken in the joint's frame, as SDF 1.7 has it; in the model's, as before 1.5, it would turn "
             "by this",
             joint.name, std::acos(std::clamp(joint.axis[0].dot(given), -1.0, 1.0)), "rad"});
      takeSdfMotion(element, *axis, type == "continuous", joint, graph_.assumptions);
    }
    graph_.joints.push_back(joint);
  }

  /// Reads `closed_loop: [[A, B], …]`, `type: [3d, …]`, `joint_name: [A, …]`, `joint_type: [SPHERICAL, …]`,
  /// `name_mot: TEXT`.
  void yaml(const std::filesystem::path& file) {
    SmallYaml text = readSmallYaml(file);
    const std::vector<std::string> types = text["type"], ends = text["closed_loop"];
    if (ends.size() % 2 != 0) throw ImportError("robot.yaml: closed_loop has an odd number of frames, expected pairs");
    for (std::size_t k = 0; k + 1 < ends.size(); k += 2) {
      const std::string type = types.empty() ? "6d" : types[std::min(k / 2, types.size() - 1)];
      if (type != "3d" && type != "3D" && type != "6d" && type != "6D")
        throw ImportError(fmt::format("robot.yaml: type '{}', expected 3d or 6d", shown(type)));
      pair(ends[k], ends[k + 1], type[0] == '3' ? JointKind::ball : JointKind::fixed, "robot.yaml");
    }
    takeTypes(text["joint_name"], text["joint_type"]);
    takeMotors(text["name_mot"]);
    for (const auto& [key, words] : text)
      if (known_in_yaml.count(key) == 0)
        graph_.assumptions.push_back(
            {fmt::format("Nothing is known of {}, which is left out", shown(key)), "robot.yaml"});
  }

  /// Lets joints of the file be what robot.yaml says: a ball, a universal joint about two axes of its frame, none.
  void takeTypes(const std::vector<std::string>& names, const std::vector<std::string>& types) {
    if (names.size() != types.size())
      throw ImportError(fmt::format("robot.yaml: {} names in joint_name and {} types in joint_type, expected as many",
                                    names.size(), types.size()));
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto joint = std::find_if(graph_.joints.begin(), graph_.joints.end(),
                                      [&](const GraphJoint& each) { return each.name == names[k] && !each.closure; });
      if (joint == graph_.joints.end()) {
        // The format's own loader passes over it.
        std::vector<std::string> known;
        for (const GraphJoint& each : graph_.joints)
          if (known.size() < 1000) known.push_back(each.name);
        graph_.assumptions.push_back(
            {fmt::format("joint_name has a joint that the URDF does not have, and its type, {}, "
                         "is left out{}",
                         shown(types[k]), didYouMean(names[k], known)),
             "robot.yaml: " + names[k], 1, "1", true});
        continue;
      }
      become(types[k], *joint);
      graph_.assumptions.push_back(
          {fmt::format("This joint is another one than in the URDF, as robot.yaml says: {}", types[k]), joint->name, 1,
           "1"});
    }
  }

  void become(const std::string& type, GraphJoint& joint) const {
    const Matrix3d axes = graph_.bodies[joint.child].frame.linear();
    // "UJOINT_XY", with the two axes in its last letters.
    const std::string letters = type.rfind("UJOINT", 0) == 0 ? type.substr(type[6] == '_' ? 7 : 6) : "";
    if (letters.size() == 2 && letters.find_first_not_of("XYZ") == std::string::npos && letters[0] != letters[1]) {
      joint.kind = JointKind::universal;
      joint.axis = {axes.col(letters[0] - 'X'), axes.col(letters[1] - 'X')};
    } else if (type == "SPHERICAL" || type == "FIXED") {
      joint.kind = type == "FIXED" ? JointKind::fixed : JointKind::ball;
      joint.axis = {axes.col(0), axes.col(1)};
    } else {
      throw ImportError(
          fmt::format("robot.yaml: joint_type '{}' of {}, expected SPHERICAL, FIXED or UJOINT with two "
                      "letters of X, Y and Z",
                      shown(type), shown(joint.name)));
    }
    joint.upper = HUGE_VAL;
    joint.lower = -HUGE_VAL;
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

  struct FrameOn {
    std::size_t body;
    Eigen::Isometry3d at;  ///< in the world
  };

  /// Returns the frame on the link that `element` names.
  FrameOn frameOn(const Element& element, const std::string& xyz, const std::string& rpy) const {
    const std::size_t body = link(element, requiredAttribute(element, "link"));
    const Vector3d position = xyz.empty() ? Vector3d::Zero() : vectorOf(element, xyz, "xyz");
    const Vector3d angles = rpy.empty() ? Vector3d::Zero() : vectorOf(element, rpy, "rpy");
    return {body, graph_.bodies[body].frame * placed(position, rollPitchYaw(angles))};
  }

  void join(const Element& element, JointKind kind, const FrameOn& parent, const FrameOn& child) {
    GraphJoint joint = closure(element, kind);
    joint.parent = parent.body;
    joint.child = child.body;
    joinFrames(parent.at, child.at, joint);
    graph_.joints.push_back(joint);
  }

  void pair(const std::string& a, const std::string& b, JointKind kind, const char* from) {
    // Pinocchio's frames are links, and joints, which are at their children.
    const auto body = [&](const std::string& name) {
      if (const auto found = links_.find(name); found != links_.end()) return found->second;
      for (const GraphJoint& joint : graph_.joints)
        if (joint.name == name) return joint.child;
      throw ImportError(fmt::format("{}: no link and no joint has the name '{}'", from, shown(name)));
    };
    GraphJoint joint;
    joint.name = a + ":" + b;
    joint.kind = kind;
    joint.closure = true;
    joint.parent = body(a);
    joint.child = body(b);
    joinFrames(graph_.bodies[joint.parent].frame, graph_.bodies[joint.child].frame, joint);
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
  const auto proposed = [&](Closer& by) {
    eachChild(robot, "constraint", [&](const Element& e) { by.constraint(e); });
  };
  const auto gazebo = [&](Closer& by) {
    eachChild(robot, "gazebo",
              [&](const Element& e) { eachChild(e, "joint", [&](const Element& joint) { by.gazebo(joint); }); });
  };
  for (const std::function<void(Closer&)>& read : std::vector<std::function<void(Closer&)>>{isaac, proposed, gazebo})
    if (found())
      passOver(graph, links, before, read);
    else
      read(closer);
  const std::filesystem::path yaml = file.parent_path() / "robot.yaml";
  std::error_code none;
  if (!found() && std::filesystem::is_regular_file(yaml, none)) closer.yaml(yaml);
  if (!found()) closer.named();
}

}  // namespace ursula::exchange

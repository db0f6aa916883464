// Writes URDF. The first leg carries the platform by three hinges through one point. A <drake:ball_constraint> closes
// each further leg; massless frames mark the place for readers without it. A link's frame is that of its joint, which
// is zero at the file's pose. A body with another frame is fixed to such a link.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "parts/exchange/write/export.h"
#include "parts/exchange/write/xml_text.h"

namespace ursula::exchange {
namespace {

/// A value for numbers that URDF requires and the machine does not bound.
constexpr double no_limit = 1e9;

class UrdfWriter {
 public:
  explicit UrdfWriter(const MachineModel& machine) : machine_(machine), graph_(machine.graph), document_("robot") {}

  std::string text() {
    root_.with("name", graph_.name).with("xmlns:drake", "http://drake.mit.edu").with("xmlns:ursula", own_namespace);
    root_.add("mujoco").add("option").with("gravity", graph_.gravity);
    for (std::size_t body = 0; body < graph_.bodies.size(); ++body) addLink(body);
    for (const GraphJoint& joint : graph_.joints)
      if (!joint.closure) addJoint(joint);
    for (const GraphJoint& joint : graph_.joints)
      if (joint.closure) addClosure(joint);
    for (const GraphJoint& joint : graph_.joints)
      if (joint.driven) addMotor(joint);
    return document_.text();
  }

 private:
  void addLink(std::size_t index) {
    const GraphBody& body = graph_.bodies[index];
    const OwnNumbers& own = machine_.own[index];
    const Xml link = root_.add("link").with("name", body.name);
    if (body.mass != 0) {
      const Xml inertial = link.add("inertial");
      inertial.add("origin").with("xyz", own.center_of_mass).with("rpy", "0 0 0");
      inertial.add("mass").with("value", body.mass);
      const Xml inertia = inertial.add("inertia");
      for (const auto& [name, row, column] : inertia_entries) inertia.with(name, own.inertia(row, column));
    }
    for (const DrawnRod& rod : machine_.rods) {
      if (rod.body != index) continue;
      const Xml visual = link.add("visual");
      addOrigin(visual, body.frame.inverse() * between(rod.from, rod.to));
      visual.add("geometry").add("cylinder").with("radius", rod.radius).with("length", (rod.to - rod.from).norm());
    }
  }

  static void addOrigin(const Xml& xml, const Eigen::Isometry3d& frame) {
    xml.add("origin").with("xyz", Vector3d(frame.translation())).with("rpy", rollPitchYawOf(frame.linear()));
  }

  Xml addJoint(const std::string& name, const char* type, const std::string& parent, const std::string& child,
               const Eigen::Isometry3d& origin) {
    const Xml element = root_.add("joint").with("name", name).with("type", type);
    addOrigin(element, origin);
    element.add("parent").with("link", parent);
    element.add("child").with("link", child);
    return element;
  }

  void addJoint(const GraphJoint& joint) {
    const GraphBody &parent = graph_.bodies[joint.parent], &child = graph_.bodies[joint.child];
    Eigen::Isometry3d at_joint = child.frame;
    at_joint.translation() = joint.centre_of_child;
    const Eigen::Isometry3d origin = parent.frame.inverse() * at_joint;
    const bool apart = joint.centre_of_child != Vector3d(child.frame.translation());
    const std::string carried = apart ? joint.name + "_frame" : child.name;
    if (apart) {
      addFrame(carried);
      addJoint(carried + "_fixed", "fixed", carried, child.name, at_joint.inverse() * child.frame);
    }
    if (joint.kind == JointKind::ball) return addBall(joint, parent.name, carried, origin);
    addCoordinate(joint,
                  addJoint(joint.name, joint.kind == JointKind::prismatic ? "prismatic" : "continuous", parent.name,
                           carried, origin),
                  at_joint.linear().transpose() * joint.axis[0]);
  }

  void addFrame(const std::string& name) { root_.add("link").with("name", name); }

  static void addCoordinate(const GraphJoint& joint, const Xml& element, const Vector3d& axis) {
    element.add("axis").with("xyz", axis);
    if (joint.damping != 0 || joint.friction != 0) {
      const Xml dynamics = element.add("dynamics").with("damping", joint.damping).with("friction", joint.friction);
      if (joint.friction != 0) dynamics.with("ursula:smoothing_speed", joint.smoothing_speed);
    }
    const Xml limit = element.add("limit").with("effort", joint.driven ? no_limit : 0).with("velocity", no_limit);
    if (joint.kind != JointKind::prismatic) return;
    const bool limited = std::isfinite(joint.lower) && std::isfinite(joint.upper);
    limit.with("lower", limited ? joint.lower - joint.position : -no_limit)
        .with("upper", limited ? joint.upper - joint.position : no_limit);
  }

  void addBall(const GraphJoint& joint, const std::string& parent, const std::string& child,
               const Eigen::Isometry3d& origin) {
    constexpr std::array<const char*, 3> axes = {"_x", "_y", "_z"};
    std::string from = parent;
    for (int k = 0; k < 3; ++k) {
      const std::string name = joint.name + axes[k], to = k == 2 ? child : name + "_frame";
      if (k < 2) addFrame(to);
      const Xml hinge = addJoint(name, "continuous", from, to, k == 0 ? origin : Eigen::Isometry3d::Identity());
      hinge.add("axis").with("xyz", Vector3d(Vector3d::Unit(k)));
      hinge.add("limit").with("effort", 0.0).with("velocity", no_limit);
      from = to;
    }
  }

  void addClosure(const GraphJoint& joint) {
    const GraphBody &leg = graph_.bodies[joint.parent], &platform = graph_.bodies[joint.child];
    const Vector3d on_leg = leg.frame.inverse() * joint.centre,
                   on_platform = platform.frame.inverse() * joint.centre_of_child;
    const Xml constraint = root_.add("drake:ball_constraint");
    constraint.add("drake:ball_constraint_body_A").with("name", leg.name);
    constraint.add("drake:ball_constraint_body_B").with("name", platform.name);
    constraint.add("drake:ball_constraint_p_AP").with("value", on_leg);
    constraint.add("drake:ball_constraint_p_BQ").with("value", on_platform);
    addClosingFrame("closing_" + joint.name + "_1", leg.name, on_leg);
    addClosingFrame("closing_" + joint.name + "_2", platform.name, on_platform);
  }

  void addClosingFrame(const std::string& name, const std::string& parent, const Vector3d& at) {
    addFrame(name);
    Eigen::Isometry3d origin = Eigen::Isometry3d::Identity();
    origin.translation() = at;
    addJoint(name + "_fixed", "fixed", parent, name, origin);
  }

  void addMotor(const GraphJoint& joint) {
    const Xml transmission = root_.add("transmission").with("name", joint.name + "_transmission");
    transmission.add("type", "transmission_interface/SimpleTransmission");
    const char* interface = "hardware_interface/EffortJointInterface";
    transmission.add("joint").with("name", joint.name).add("hardwareInterface", interface);
    const Xml actuator = transmission.add("actuator").with("name", joint.name + "_motor");
    actuator.add("hardwareInterface", interface);
    actuator.add("mechanicalReduction", 1.0);
    if (joint.rotor_inertia == 0) return;
    actuator.add("drake:rotor_inertia").with("value", joint.rotor_inertia);
    actuator.add("drake:gear_ratio").with("value", 1.0);
  }

  const MachineModel& machine_;
  const ModelGraph& graph_;
  XmlDocument document_;
  Xml root_{document_.root()};
};

}  // namespace

std::string urdfText(const MachineModel& machine, Assumptions& notes) {
  const Vector3d& gravity = machine.graph.gravity;
  notes.push_back(
      {fmt::format("URDF has no gravity: but for MuJoCo and an import, set [{}, {}, {}], in the base's axes",
                   gravity.x(), gravity.y(), gravity.z()),
       "manipulator.gravity", gravity.norm(), "m/s2"});
  const auto& joints = machine.graph.joints;
  const auto closures = std::count_if(joints.begin(), joints.end(), [](const GraphJoint& it) { return it.closure; });
  notes.push_back({"URDF is a tree: loops are closed by <drake:ball_constraint>; elsewhere join closing_…_1 and _2",
                   "platform", static_cast<double>(closures), "closures"});
  return UrdfWriter(machine).text();
}

}  // namespace ursula::exchange

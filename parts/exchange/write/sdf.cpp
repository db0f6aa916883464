// Writes SDF 1.7, which Gazebo 11 and its successors read. The platform is the child of a ball at each leg. Gazebo
// closes loops by such joints whose child already has a parent. All coordinates are zero at the file's pose.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "parts/exchange/write/export.h"
#include "parts/exchange/write/xml_text.h"

namespace ursula::exchange {
namespace {

constexpr double max_step = 0.0005;  ///< s

class SdfWriter {
 public:
  SdfWriter(const MachineModel& machine, Assumptions& notes)
      : machine_(machine), graph_(machine.graph), notes_(notes), document_("sdf") {}

  std::string text() {
    const Xml root = document_.root();
    root.with("version", "1.7").with("xmlns:drake", "http://drake.mit.edu").with("xmlns:ursula", own_namespace);
    const Xml world = root.add("world");
    world.with("name", graph_.name).add("gravity", numberText(graph_.gravity));
    const Xml physics = world.add("physics").with("name", "small_steps").with("type", "ode");
    physics.add("max_step_size", max_step);
    physics.add("real_time_factor", 1.0);
    physics.add("real_time_update_rate", 1 / max_step);
    const Xml model = world.add("model").with("name", graph_.name);
    const std::string motors = motorNames();
    model.comment(fmt::format(" motors drive {}; no motor has effort 0 ", motors));
    notes_.push_back(
        {"SDF has no motors. ursula:driven marks them for an import; of a file without it, say --actuated " + motors,
         motors, 6, "motors"});
    for (std::size_t body = 0; body < graph_.bodies.size(); ++body)
      if (!graph_.bodies[body].fixed && graph_.bodies[body].mass != 0) addLink(model, body);
    for (const TreeBody& tree_body : treeBodiesOf(graph_)) addTreeBody(model, tree_body);
    for (const GraphJoint& joint : graph_.joints)
      if (joint.closure) addBall(model, joint.name, joint.parent, joint);
    return document_.text();
  }

 private:
  /// Returns the names of the motors' joints in this file. An axis of a two-axis joint has the name that the import
  /// gives it.
  std::string motorNames() {
    constexpr const char* axes[] = {"/axis", "/axis2"};
    std::string out;
    for (const TreeBody& tree_body : treeBodiesOf(graph_))
      for (std::size_t k = 0; k < tree_body.joints.size(); ++k)
        if (graph_.joints[tree_body.joints[k]].driven)
          out += (out.empty() ? "" : ",") + nameOf(tree_body) + (tree_body.joints.size() == 2 ? axes[k] : "");
    return out;
  }

  /// Returns "leg_1_phi_psi" for leg_1_phi and leg_1_psi.
  std::string nameOf(const TreeBody& tree_body) const {
    std::string out = graph_.joints[tree_body.joints.front()].name;
    for (std::size_t k = 1; k < tree_body.joints.size(); ++k) {
      const std::string& name = graph_.joints[tree_body.joints[k]].name;
      out += name.substr(name.rfind('_'));
    }
    return out;
  }

  void addLink(const Xml& model, std::size_t index) const {
    const GraphBody& body = graph_.bodies[index];
    const OwnNumbers& own = machine_.own[index];
    const Xml link = model.add("link").with("name", body.name);
    link.add("pose", poseText(body.frame));
    const Xml inertial = link.add("inertial");
    inertial.add("pose", numberText(own.center_of_mass) + " 0 0 0");
    inertial.add("mass", body.mass);
    const Xml inertia = inertial.add("inertia");
    for (const auto& [name, row, column] : inertia_entries) inertia.add(name, own.inertia(row, column));
    int drawn = 0;
    for (const DrawnRod& rod : machine_.rods) {
      if (rod.body != index) continue;
      const Xml visual = link.add("visual").with("name", fmt::format("{}_{}", body.name, ++drawn));
      visual.add("pose", poseText(body.frame.inverse() * between(rod.from, rod.to)));
      const Xml cylinder = visual.add("geometry").add("cylinder");
      cylinder.add("radius", rod.radius);
      cylinder.add("length", (rod.to - rod.from).norm());
    }
  }

  void addTreeBody(const Xml& model, const TreeBody& tree_body) {
    const GraphJoint& last = graph_.joints[tree_body.joints.back()];
    if (last.kind == JointKind::ball || tree_body.joints.size() > 2) {
      for (const std::size_t joint : tree_body.joints) noteBall(graph_.joints[joint]);
      return addBall(model, nameOf(tree_body), tree_body.parent, last);
    }
    const char* type = tree_body.joints.size() == 2        ? "universal"
                       : last.kind == JointKind::prismatic ? "prismatic"
                                                           : "revolute";
    const Xml element = addJoint(model, nameOf(tree_body), type, tree_body.parent, last);
    for (std::size_t k = 0; k < tree_body.joints.size(); ++k)
      addAxis(element.add(k == 0 ? "axis" : "axis2"), graph_.joints[tree_body.joints[k]], tree_body.joints.size() == 2);
    if (tree_body.joints.size() == 1 && last.rotor_inertia != 0) element.add("drake:rotor_inertia", last.rotor_inertia);
  }

  /// Three hinges through one point become a ball, which has no axes for friction or rotors.
  void noteBall(const GraphJoint& joint) {
    if (joint.damping != 0 || joint.friction != 0)
      notes_.push_back({"Friction on one axis of a ball is left out", joint.name,
                        std::max(joint.damping, joint.friction), "N m s or N m"});
    noteRotor(joint, "it is left out");
  }

  void noteRotor(const GraphJoint& joint, const char* what) {
    if (joint.rotor_inertia != 0)
      notes_.push_back({fmt::format("SDF has no rotor inertia: {}", what), joint.name, joint.rotor_inertia,
                        joint.kind == JointKind::prismatic ? "kg" : "kg m2"});
  }

  void addBall(const Xml& model, const std::string& name, std::size_t parent, const GraphJoint& joint) const {
    addJoint(model, name, "ball", parent, joint);
  }

  /// The joint's frame has the model's axes, so both give the same numbers.
  Xml addJoint(const Xml& model, const std::string& name, const char* type, std::size_t parent,
               const GraphJoint& joint) const {
    const Xml element = model.add("joint").with("name", name).with("type", type);
    const GraphBody& from = graph_.bodies[parent];
    element.add("parent", from.fixed ? "world" : from.name);
    element.add("child", graph_.bodies[joint.child].name);
    element.add("pose", numberText(joint.centre) + " 0 0 0").with("relative_to", "__model__");
    return element;
  }

  /// Drake's rotor belongs to a joint of one axis; of two axes only an import knows whose it is.
  void addAxis(const Xml& axis, const GraphJoint& joint, bool is_of_two) {
    if (is_of_two && joint.rotor_inertia != 0) axis.with("ursula:rotor_inertia", joint.rotor_inertia);
    if (joint.driven) axis.with("ursula:driven", "true");
    axis.add("xyz", numberText(joint.axis[0]));
    if (joint.damping != 0 || joint.friction != 0) {
      const Xml dynamics = axis.add("dynamics");
      if (joint.friction != 0) dynamics.with("ursula:smoothing_speed", joint.smoothing_speed);
      dynamics.add("damping", joint.damping);
      dynamics.add("friction", joint.friction);
    }
    const bool limited = std::isfinite(joint.lower) && std::isfinite(joint.upper);
    if (limited || !joint.driven) {
      const Xml limit = axis.add("limit");
      limit.add("lower", limited ? joint.lower - joint.position : -1e16);
      limit.add("upper", limited ? joint.upper - joint.position : 1e16);
      if (!joint.driven) limit.add("effort", 0.0);
    }
    noteRotor(joint, is_of_two ? "only an import reads it" : "only Drake and an import read it");
  }

  const MachineModel& machine_;
  const ModelGraph& graph_;
  Assumptions& notes_;
  XmlDocument document_;
};

}  // namespace

std::string sdfText(const MachineModel& machine, Assumptions& notes) { return SdfWriter(machine, notes).text(); }

}  // namespace ursula::exchange

// Writes MJCF for MuJoCo 2.2 and later. The platform floats; each leg is its own tree and is connected to it.
// Coordinates have the scenario's values: `ref` gives them at the file's pose.

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "parts/exchange/write/export.h"
#include "parts/exchange/write/xml_text.h"

namespace ursula::exchange {
namespace {

/// Time constant, s, with which a gap closes. The step is a quarter of it; MuJoCo asks for half or less.
constexpr double closing_time = 0.002, step = closing_time / 4;
/// The share of the closing acceleration that MuJoCo applies, at its maximum. A closure yields in proportion to the
/// remainder.
constexpr double impedance = 0.9999;

class MjcfWriter {
 public:
  explicit MjcfWriter(const MachineModel& machine)
      : machine_(machine), graph_(machine.graph), tree_bodies_(treeBodiesOf(graph_)), document_("mujoco") {
    for (const GraphJoint& joint : graph_.joints)
      if (joint.closure) platform_ = joint.child;
  }

  std::string text() {
    const Xml root = document_.root();
    root.with("model", graph_.name);
    root.add("compiler").with("angle", "radian").with("inertiafromgeom", "false");
    root.add("option")
        .with("gravity", graph_.gravity)
        .with("timestep", step)
        .with("integrator", "RK4")
        .with("solver", "Newton")
        .with("tolerance", 1e-14);
    root.add("default")
        .add("geom")
        .with("type", "capsule")
        .with("contype", "0")
        .with("conaffinity", "0")
        .with("mass", "0");
    const Xml world = root.add("worldbody");
    world.add("light").with("pos", "0 0 10").with("dir", "0 0 -1").with("directional", "true");
    addChildren(world, 0);
    addClosures(root.add("equality"));
    const Xml actuators = root.add("actuator");
    for (const GraphJoint& joint : graph_.joints)
      if (joint.driven) actuators.add("motor").with("name", joint.name).with("joint", joint.name).with("gear", "1");
    addSmoothing(root);
    return document_.text();
  }

 private:
  /// MuJoCo's schema takes no further attributes of joints.
  void addSmoothing(const Xml& root) const {
    const auto has_friction = [](const GraphJoint& joint) { return joint.friction != 0; };
    if (std::none_of(graph_.joints.begin(), graph_.joints.end(), has_friction)) return;
    const Xml custom = root.add("custom");
    for (const GraphJoint& joint : graph_.joints)
      if (has_friction(joint))
        custom.add("numeric").with("name", joint.name + "_smoothing_speed").with("data", joint.smoothing_speed);
  }

  bool floats(const TreeBody& tree_body) const { return tree_body.child == platform_; }

  void addChildren(const Xml& xml, std::size_t parent) {
    for (const TreeBody& tree_body : tree_bodies_)
      if ((floats(tree_body) ? 0 : tree_body.parent) == parent) addBody(xml, tree_body, parent);
  }

  void addBody(const Xml& xml, const TreeBody& tree_body, std::size_t parent) {
    const GraphBody& body = graph_.bodies[tree_body.child];
    const Eigen::Isometry3d in_parent = graph_.bodies[parent].frame.inverse() * body.frame;
    const Xml element = xml.add("body");
    element.with("name", body.name)
        .with("pos", Vector3d(in_parent.translation()))
        .with("quat", quaternionText(in_parent.linear()));
    if (floats(tree_body)) element.add("freejoint").with("name", body.name);
    for (const std::size_t joint : tree_body.joints)
      if (!floats(tree_body)) addJoint(element, graph_.joints[joint], body.frame);
    addInertial(element.add("inertial"), tree_body.child);
    const Eigen::Isometry3d to_own = body.frame.inverse();
    for (const DrawnRod& rod : machine_.rods)
      if (rod.body == tree_body.child)
        element.add("geom")
            .with("size", rod.radius)
            .with("fromto", numberText(to_own * rod.from) + " " + numberText(to_own * rod.to));
    addChildren(element, tree_body.child);
  }

  static void addJoint(const Xml& xml, const GraphJoint& joint, const Eigen::Isometry3d& frame) {
    const Xml element = xml.add("joint");
    element.with("name", joint.name)
        .with("type", joint.kind == JointKind::prismatic ? "slide"
                      : joint.kind == JointKind::ball    ? "ball"
                                                         : "hinge")
        .with("pos", Vector3d(frame.inverse() * joint.centre_of_child));
    if (joint.kind == JointKind::ball) return;
    element.with("axis", Vector3d(frame.linear().transpose() * joint.axis[0])).with("ref", joint.position);
    if (std::isfinite(joint.lower) && std::isfinite(joint.upper))
      element.with("limited", "true").with("range", numberText(joint.lower) + " " + numberText(joint.upper));
    if (joint.damping != 0) element.with("damping", joint.damping);
    if (joint.friction != 0) element.with("frictionloss", joint.friction);
    if (joint.rotor_inertia != 0) element.with("armature", joint.rotor_inertia);
  }

  /// MuJoCo stores principal moments. It refuses a largest moment above the sum of the others, which rounding may cause
  /// for a plate.
  void addInertial(const Xml& xml, std::size_t body) const {
    const OwnNumbers& own = machine_.own[body];
    xml.with("pos", own.center_of_mass).with("mass", graph_.bodies[body].mass);
    Vector3d moments = own.inertia.diagonal();
    if (!own.inertia.isDiagonal(0)) {
      const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(own.inertia);
      Matrix3d axes = principal.eigenvectors();
      if (axes.determinant() < 0) axes.col(0) *= -1;
      moments = principal.eigenvalues();
      xml.with("quat", quaternionText(axes));
    }
    constexpr double least_moment =
        1e-14;  // MuJoCo refuses moving bodies below 1e-15; a thin rod has none about its line
    moments = moments.cwiseMax(least_moment);
    Eigen::Index last = 0;
    const double largest = moments.maxCoeff(&last), others = moments.sum() - largest;
    if (largest > others) moments(last) = std::nextafter(std::min(largest, others), 0);
    xml.with("diaginertia", moments);
  }

  /// The anchor is in the platform; MuJoCo takes the leg's point from the file's pose.
  void addClosures(const Xml& xml) const {
    for (const GraphJoint& joint : graph_.joints) {
      if (joint.kind != JointKind::ball || joint.child != platform_) continue;
      const GraphBody& platform = graph_.bodies[joint.child];
      xml.add("connect")
          .with("name", joint.name)
          .with("body1", platform.name)
          .with("body2", graph_.bodies[joint.parent].name)
          .with("anchor", Vector3d(platform.frame.inverse() * joint.centre_of_child))
          .with("solref", numberText(closing_time) + " 1")
          .with("solimp", numberText(impedance) + " " + numberText(impedance) + " 0.001");
    }
  }

  const MachineModel& machine_;
  const ModelGraph& graph_;
  std::vector<TreeBody> tree_bodies_;
  std::size_t platform_ = 0;  ///< the body where the loops close
  XmlDocument document_;
};

}  // namespace

std::string mjcfText(const MachineModel& machine, Assumptions&) { return MjcfWriter(machine).text(); }

}  // namespace ursula::exchange

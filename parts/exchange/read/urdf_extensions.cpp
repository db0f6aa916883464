#include "parts/exchange/read/urdf_parts.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "parts/exchange/read/mjcf_parts.h"
#include "parts/exchange/read/sdf_parts.h"

namespace ursula::exchange {
namespace {

using FromGeom = MjcfCompiler::FromGeom;

/// MuJoCo gives mass to collision shapes, but not to visual ones.
void refuseMassOfShapes(const Element& link, const MjcfCompiler& compiler) {
  const bool has_inertial = link.FirstChildElement("inertial") != nullptr;
  const bool from_shapes =
      compiler.from_geom == FromGeom::yes || (compiler.from_geom == FromGeom::automatic && !has_inertial);
  if (from_shapes && link.FirstChildElement("collision") != nullptr)
    refuse(link,
           "a mass that MuJoCo takes from its <collision>, as the file has <mujoco>; expected an <inertial>, and "
           "inertiafromgeom=\"auto\" or \"false\"");
}

/// What a <gazebo> of a link or a joint may say without a change of the dynamics.
const std::set<std::string> known_in_gazebo = wordsOf(
    "gravity turnGravityOff kinematic static springStiffness springReference material mu1 mu2 kp kd fdir1 maxVel "
    "minDepth maxContacts selfCollide self_collide laserRetro sensor plugin visual collision provideFeedback "
    "implicitSpringDamper stopCfm stopErp cfmDamping fudgeFactor joint disableFixedJointLumping preserveFixedJoint");

/// Reads the spring of the joint `of`.
void takeGazeboSpring(const Element& gazebo, const std::string& of, ModelGraph& graph) {
  const std::string stiffness = childText(gazebo, "springStiffness"), reference = childText(gazebo, "springReference");
  if (stiffness.empty() && reference.empty()) return;
  const auto joint =
      std::find_if(graph.joints.begin(), graph.joints.end(), [&](const GraphJoint& each) { return each.name == of; });
  if (joint == graph.joints.end()) refuse(gazebo, fmt::format("a spring in '{}': no joint has that name", shown(of)));
  takeSpring(gazebo, stiffness, reference, *joint);
}

}  // namespace

void readUrdfMujoco(const Element& robot, const std::vector<const Element*>& links, ModelGraph& graph) {
  const Element* mujoco = onlyChild(robot, "mujoco");
  bool has_gravity = false;
  if (mujoco != nullptr) {
    listUnknown(*mujoco, {"compiler", "option", "size"}, graph.assumptions);
    eachChild(*mujoco, "option", [&](const Element& e) { has_gravity = has_gravity || e.Attribute("gravity"); });
    readMjcfOptions(*mujoco, graph);
    MjcfCompiler compiler;
    eachChild(*mujoco, "compiler", [&](const Element& e) { compiler.read(e); });
    if (compiler.total_mass > 0)
      refuse(*mujoco, fmt::format("settotalmass {}, which scales all masses; expected the masses themselves",
                                  compiler.total_mass));
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (graph.bodies[i].fixed) continue;
      refuseMassOfShapes(*links[i], compiler);
      boundInertia(*links[i], compiler, graph.bodies[i], graph.assumptions);
    }
  }
  if (!has_gravity)
    graph.assumptions.push_back(
        {"URDF has no gravity: 9.81 m/s² along −z of the root link was taken", "<robot>", 9.81, "m/s²"});
}

void readUrdfGazebo(const Element& robot, const UrdfLinks& links, ModelGraph& graph) {
  eachChild(robot, "gazebo", [&](const Element& e) {
    const std::string of = attribute(e, "reference"), on = childText(e, "gravity"),
                      off = childText(e, "turnGravityOff");
    const auto link = links.find(of);
    listUnknown(e, known_in_gazebo, graph.assumptions);
    listPlugins(e, of.empty() ? graph.name : of, graph.assumptions);
    for (const char* word : {"axis", "axis2", "inertial", "link", "model", "include", "drake:mimic"})
      if (const Element* more = e.FirstChildElement(word))
        refuse(*more, fmt::format("in <gazebo> of {}, which changes the machine there; expected it in URDF's own words",
                                  of.empty() ? "the model" : shown(of)));
    refuseSdfDecay(e, childText(e, "dampingFactor"));
    for (const char* word : {"static", "kinematic"})
      if (const std::string text = childText(e, word); !text.empty() && truthOf(e, text, word))
        refuse(e, fmt::format("<{}> holds {} where it is, expected a machine that moves", word,
                              of.empty() ? "the model" : shown(of)));
    if (link != links.end() &&
        ((!on.empty() && !truthOf(e, on, "<gravity>")) || (!off.empty() && truthOf(e, off, "<turnGravityOff>"))))
      graph.bodies[link->second].weightless = true;
    takeGazeboSpring(e, of, graph);
  });
}

}  // namespace ursula::exchange

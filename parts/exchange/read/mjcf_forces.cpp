// What acts in an MJCF besides bodies and joints: gravity, fluids, springs, friction, gravity compensation.

#include <fmt/format.h>

#include <cmath>

#include "base/text.h"
#include "parts/exchange/read/mjcf_parts.h"

namespace ursula::exchange {
namespace {

double notNegative(const Element& element, const MjcfGet& get, const char* name) {
  const std::string text = get(name);
  const double value = text.empty() ? 0 : numberOf(element, text, name);
  if (value < 0) refuse(element, fmt::format("{} {}, expected none below zero", name, value));
  return value;
}

/// MuJoCo makes stiffness and damping of springdamper by the inertia of the whole compiled model.
void refuseSpringDamper(const Element& element, const MjcfGet& get) {
  const std::string text = get("springdamper");
  if (text.empty()) return;
  for (const double value : numbersOf(element, text, 2, "springdamper"))
    if (value != 0)
      refuse(element,
             fmt::format("springdamper {}: a spring, which a scenario has no words for; expected its stiffness "
                         "and damping, which MuJoCo's compiled model has (jnt_stiffness, dof_damping)",
                         shown(text)));
}

void takeRange(const Element& element, const MjcfCompiler& compiler, const MjcfGet& get, GraphJoint& joint) {
  const std::string limited = get("limited"), range = get("range");
  if (range.empty() || limited == "false" || (limited != "true" && !compiler.auto_limits)) return;
  const std::vector<double> ends = numbersOf(element, range, 2, "range", HUGE_VAL);
  if (ends[0] == 0 && ends[1] == 0) return;  // MuJoCo's default
  if (!(ends[0] < ends[1])) refuse(element, fmt::format("range {}, expected its first number below the second", range));
  const bool turns = joint.kind == JointKind::revolute;
  joint.lower = turns ? compiler.angle(ends[0]) : ends[0];
  joint.upper = turns ? compiler.angle(ends[1]) : ends[1];
}

}  // namespace

void readMjcfOptions(const Element& root, ModelGraph& graph) {
  bool is_off = false;
  eachChild(root, "option", [&](const Element& option) {
    if (const std::string gravity = attribute(option, "gravity"); !gravity.empty())
      graph.gravity = vectorOf(option, gravity, "gravity");
    for (const char* name : {"density", "viscosity"})
      if (const std::string value = attribute(option, name); !value.empty() && numberOf(option, value, name) != 0)
        graph.other_forces.push_back(
            {"fluid",
             fmt::format("{}: {} {}: forces of a fluid, which a scenario has no words for", named(option), name,
                         shown(value)),
             option.GetLineNum(),
             {fmt::format("Forces of a fluid of this {} are left out", name), "<option>", numberOf(option, value, name),
              name == std::string("density") ? "kg/m³" : "Pa·s"}});
    const Element* flag = onlyChild(option, "flag");
    if (flag == nullptr) return;
    is_off = is_off || attribute(*flag, "gravity") == "disable";
    for (const char* name : {"equality", "constraint", "passive", "spring", "damper", "frictionloss", "actuation"})
      if (attribute(*flag, name) == "disable")
        refuse(*flag, fmt::format(
                          "{}=\"disable\", which switches off what the file says elsewhere; expected a file without it",
                          name));
  });
  if (!is_off) return;
  graph.assumptions.push_back({"Gravity is switched off by the file's flag; without it it would be this", "<flag>",
                               graph.gravity.norm(), "m/s²"});
  graph.gravity.setZero();
}

void takeMjcfNumbers(const Element& element, const MjcfCompiler& compiler, const MjcfGet& get, GraphJoint& joint) {
  refuseSpringDamper(element, get);
  joint.stiffness = notNegative(element, get, "stiffness");
  joint.damping = notNegative(element, get, "damping");
  joint.friction = notNegative(element, get, "frictionloss");
  joint.rotor_inertia = notNegative(element, get, "armature");
  if (joint.kind == JointKind::ball || joint.kind == JointKind::free) return;
  for (const auto& [name, to] : {std::pair("ref", &joint.position), std::pair("springref", &joint.spring_reference)}) {
    const std::string text = get(name);
    const double value = text.empty() ? 0 : numberOf(element, text, name);
    *to = joint.kind == JointKind::revolute ? compiler.angle(value) : value;
  }
  takeRange(element, compiler, get, joint);
}

bool isCompensated(const Element& body) {
  const std::string text = attribute(body, "gravcomp");
  const double share = text.empty() ? 0 : numberOf(body, text, "gravcomp");
  if (share != 0 && share != 1)
    refuse(body, fmt::format("gravcomp {}: a part of gravity is taken off a body, expected 0 or 1", shown(text)));
  return share == 1;
}

}  // namespace ursula::exchange

#include <fmt/format.h>

#include "parts/exchange/read/sdf_parts.h"

namespace ursula::exchange {
namespace {

/// Returns a child's value, which is an attribute in URDF and text in SDF.
std::string valueOf(const Element& element, const char* child, const char* of_urdf) {
  const Element* found = onlyChild(element, child);
  if (found == nullptr) return "";
  const std::string value = attribute(*found, of_urdf);
  return value.empty() ? textOf(*found) : value;
}

void addBall(const Element& element, ModelGraph& graph, const BodyByName& body) {
  GraphJoint ball = jointAt(element, nameOr(element, "drake:ball_constraint"), JointKind::ball);
  ball.closure = true;
  const auto side = [&](const char* name, const char* point, std::size_t& index, Vector3d& centre) {
    const std::string named = valueOf(element, name, "name"), at = valueOf(element, point, "value");
    if (named.empty() || at.empty()) refuse(element, fmt::format("no <{}> or no <{}>, expected both", name, point));
    index = body(element, named);
    centre = graph.bodies[index].frame * vectorOf(element, at, point);
  };
  side("drake:ball_constraint_body_A", "drake:ball_constraint_p_AP", ball.parent, ball.centre);
  side("drake:ball_constraint_body_B", "drake:ball_constraint_p_BQ", ball.child, ball.centre_of_child);
  graph.joints.push_back(ball);
}

}  // namespace

void readDrakeConstraints(const Element& model, ModelGraph& graph, const BodyByName& body) {
  eachChild(model, "drake:ball_constraint", [&](const Element& e) { addBall(e, graph, body); });
  eachChild(model, nullptr, [](const Element& e) {
    const std::string name = e.Name();
    const bool couples = name.rfind("drake:", 0) == 0 && name.find("_constraint") != std::string::npos;
    if (name == "drake:linear_bushing_rpy" || (couples && name != "drake:ball_constraint"))
      refuse(e, fmt::format("which a scenario has no words for; {}", without_it));
  });
}

double drakeRotorInertia(const Element& element) {
  const std::string rotor = valueOf(element, "drake:rotor_inertia", "value");
  const std::string gear = valueOf(element, "drake:gear_ratio", "value");
  if (rotor.empty()) return 0;
  const double ratio = gear.empty() ? 1 : numberOf(element, gear, "drake:gear_ratio");
  const double inertia = numberOf(element, rotor, "drake:rotor_inertia");
  if (inertia < 0) refuse(element, fmt::format("a rotor's inertia of {}, expected none below zero", inertia));
  return inertia * ratio * ratio;
}

}  // namespace ursula::exchange

#include "parts/exchange/mechanism_reader.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "parts/exchange/keyframe.h"
#include "parts/exchange/leave_out.h"
#include "parts/exchange/mechanism_tree.h"
#include "parts/exchange/model_text.h"
#include "parts/exchange/read/urdf_parts.h"
#include "parts/exchange/recognise/chains.h"

namespace ursula::exchange {
namespace {

std::size_t chosenBody(const ModelGraph& graph, const std::string& name, const char* place) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < graph.bodies.size(); ++i) {
    if (graph.bodies[i].name == name) return i;
    if (names.size() < 1000) names.push_back(graph.bodies[i].name);
  }
  throw InvalidParameter(place, fmt::format("'{}', no body has that name", shown(name)),
                         fmt::format("a body of the file{}", didYouMean(name, names)));
}

void closeLoops(ModelGraph& graph, const std::vector<std::string>& pairs) {
  constexpr const char* place = "mechanism.close";
  for (const std::string& pair : pairs)
    if (!closeAtFrames(graph, pair, [&](const std::string& name) { return chosenBody(graph, name, place); }))
      throw InvalidParameter(place, fmt::format("'{}'", shown(pair)), "two links, \"A:B\"");
}

/// Lets the motors be those that the user names, or those of the file in its order.
void takeMotors(ModelGraph& graph, const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (GraphJoint& joint : graph.joints) {
    if (known.size() < 1000) known.push_back(joint.name);
    const auto& motors = graph.motors;
    if (joint.driven && std::find(motors.begin(), motors.end(), joint.name) == motors.end())
      graph.motors.push_back(joint.name);
  }
  if (names.empty()) return;
  graph.motors = names;
  for (GraphJoint& joint : graph.joints) joint.driven = false;
  for (const std::string& name : names) {
    const auto joint = std::find_if(graph.joints.begin(), graph.joints.end(),
                                    [&](const GraphJoint& each) { return each.name == name; });
    if (joint == graph.joints.end())
      throw InvalidParameter("mechanism.motors", fmt::format("'{}', no joint has that name", shown(name)),
                             fmt::format("a joint of the file{}", didYouMean(name, known)));
    joint->driven = true;
  }
}

/// Returns the massless bodies through which alone `body` hangs on what stands still, as a floating base in MJCF often
/// does by three slides and a ball.
std::vector<std::size_t> hangers(const ModelGraph& graph, std::size_t body) {
  std::vector<std::size_t> out;
  while (!graph.bodies[body].fixed) {
    const GraphJoint* up = nullptr;
    std::size_t count = 0;
    for (const GraphJoint& joint : graph.joints) {
      count += joint.parent == body || joint.child == body ? 1 : 0;
      if (joint.child == body && !joint.closure) up = &joint;
    }
    const GraphBody& here = graph.bodies[body];
    const bool is_frame = here.mass == 0 && here.inertia.isZero(0) && count == 2;
    if (up == nullptr || out.size() > graph.bodies.size() || (!out.empty() && !is_frame)) return {};
    out.push_back(body);
    body = up->parent;
  }
  return out;
}

/// Lets a body stand still. URDF's root, which stands still for want of a word in the file, is then set free.
void holdBase(ModelGraph& graph, const std::string& base) {
  if (base.empty()) return;
  const std::size_t body = chosenBody(graph, base, "mechanism.base");
  if (graph.format == ModelFormat::urdf) {
    for (GraphBody& each : graph.bodies) each.fixed = each.fixed && (each.name == "world" || each.name == base);
    auto& said = graph.assumptions;
    said.erase(std::remove_if(said.begin(), said.end(),
                              [](const Assumption& each) { return each.what.rfind(root_stands_still, 0) == 0; }),
               said.end());
  }
  for (const std::size_t each : hangers(graph, body)) graph.bodies[each].fixed = true;
  graph.bodies[body].fixed = true;
}

void takeGravity(ModelGraph& graph, const std::optional<Vector3d>& gravity) {
  if (!gravity) return;
  graph.gravity = *gravity;
  // The readers' assumptions in m/s² are those on gravity, which is now the user's.
  auto& said = graph.assumptions;
  said.erase(std::remove_if(said.begin(), said.end(), [](const Assumption& each) { return each.unit == "m/s²"; }),
             said.end());
}

void requireMoments(const ModelGraph& graph, Assumptions& said) {
  for (const GraphBody& body : graph.bodies) {
    if (body.fixed) continue;
    const Matrix3d symmetric = (body.inertia + body.inertia.transpose()) / 2;
    const Vector3d m = Eigen::SelfAdjointEigenSolver<Matrix3d>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
    const double excess = m(2) - m(1) - std::max(m(0), 0.0), slack = 3 * body.inertia_rounding + 1e-12 * m(2);
    if (excess > slack)
      said.push_back(
          {"The largest principal moment of inertia exceeds the sum of the others by this, as that of no "
           "body does; the numbers are taken as they are",
           body.name, excess, "kg·m²", true});
  }
}

/// Says what a mechanism takes that the file leaves open, or that may not be meant.
void sayOpen(const ModelGraph& graph, Assumptions& said) {
  for (const GraphJoint& joint : graph.joints) {
    const bool slides = joint.slides();
    if (joint.friction != 0 && !(joint.smoothing_speed > 0))
      said.push_back({fmt::format("Coulomb friction is smoothed below {:g} {}, of which the file says nothing",
                                  joint.smoothing(), slides ? "m/s" : "rad/s"),
                      joint.name, joint.friction, slides ? "N" : "N·m"});
    if (!(joint.lower <= joint.position && joint.position <= joint.upper))
      said.push_back({"The initial pose lies outside this joint's limits", joint.name,
                      std::max(joint.lower - joint.position, joint.position - joint.upper), slides ? "m" : "rad"});
  }
  requireMoments(graph, said);
}

double sizeOfModel(const ModelGraph& graph) {
  Eigen::AlignedBox3d box;
  for (const GraphJoint& joint : graph.joints)
    for (const Vector3d& point : {joint.centre, joint.centre_of_child}) box.extend(point);
  for (const GraphBody& body : graph.bodies)
    if (body.mass > 0 && !body.fixed) box.extend(body.center_of_mass);
  const double size = box.isEmpty() ? 0 : box.diagonal().norm();
  return size > 0 ? size : 1;
}

ModelRead inSentences(ModelGraph graph, double size) {
  Assumptions said = std::move(graph.assumptions);
  sayOpen(graph, said);
  sayGaps(graph, {}, size, said);
  ModelRead out;
  for (const Assumption& each : inOrder(std::move(said)))
    (each.warning ? out.warnings : out.assumptions).push_back(inWords(each));
  out.machine = std::move(graph);
  return out;
}

}  // namespace

ModelRead readMechanismModel(const std::filesystem::path& file, const MechanismChoices& choices) {
  return inFile(file, [&] {
    ModelGraph graph = readGraph(file);
    closeLoops(graph, choices.close);
    const double size = sizeOfModel(graph);
    takeKeyframe(graph, size, choices.key);
    takeMotors(graph, choices.motors);
    holdBase(graph, choices.base);
    takeGravity(graph, choices.gravity);
    leaveOut(graph, choices.leave_out, "mechanism.leave_out");
    requireMechanism(graph);
    dropHeldJoints(graph);
    hangTree(graph);
    return inSentences(std::move(graph), size);
  });
}

}  // namespace ursula::exchange

namespace ursula {

/// The row of this part.
ModelReader addMechanismReader() { return exchange::readMechanismModel; }

}  // namespace ursula

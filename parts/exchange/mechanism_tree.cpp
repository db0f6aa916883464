#include "parts/exchange/mechanism_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "base/text.h"
#include "parts/exchange/recognise/chains.h"

namespace ursula::exchange {
namespace {

/// Sets of bodies that joints hold together; all that stands still is in one.
class Sets {
 public:
  explicit Sets(const ModelGraph& graph) : of_(graph.bodies.size()) {
    std::iota(of_.begin(), of_.end(), std::size_t{0});
    for (std::size_t i = 0; i < of_.size(); ++i)
      if (graph.bodies[i].fixed) ground_ = ground_ == none ? i : (join(ground_, i), ground_);
  }

  std::size_t of(std::size_t body) {
    while (of_[body] != body) body = of_[body] = of_[of_[body]];
    return body;
  }
  /// Returns whether they were apart.
  bool join(std::size_t a, std::size_t b) {
    const std::size_t x = of(a), y = of(b);
    of_[std::max(x, y)] = std::min(x, y);
    return x != y;
  }
  bool isGround(std::size_t body) { return ground_ != none && of(body) == of(ground_); }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> of_;
  std::size_t ground_ = none;
};

/// Returns the sets that all joints but free ones make.
Sets heldTogether(const ModelGraph& graph) {
  Sets sets(graph);
  for (const GraphJoint& joint : graph.joints)
    if (joint.kind != JointKind::free) sets.join(joint.parent, joint.child);
  return sets;
}

void requireMass(const ModelGraph& graph) {
  for (const GraphBody& body : graph.bodies)
    if (!body.fixed && body.mass > 0) return;
  throw ImportError(
      fmt::format("none of its {} bodies has a mass, but for those that stand still: expected {} with mass "
                  "and inertia",
                  graph.bodies.size(), graph.format == ModelFormat::mjcf ? "geoms or <inertial>" : "<inertial>"));
}

void requireGround(const ModelGraph& graph, Sets& sets) {
  bool moves = false;
  for (std::size_t i = 0; i < graph.bodies.size(); ++i)
    moves = moves || (!graph.bodies[i].fixed && graph.bodies[i].mass > 0 && sets.isGround(i));
  std::vector<std::string> candidates;
  for (const GraphJoint& joint : graph.joints) {
    if (moves && !joint.driven) continue;
    for (const std::size_t end : {joint.parent, joint.child})
      if (!sets.isGround(end) &&
          std::find(candidates.begin(), candidates.end(), graph.bodies[end].name) == candidates.end())
        candidates.push_back(graph.bodies[end].name);
  }
  if (moves && candidates.empty()) return;
  for (std::string& name : candidates) name = shown(name);
  throw ImportError(
      fmt::format("{}: expected a machine that hangs on a body that stands still; base = \"BODY\" in "
                  "[mechanism] names one{}{}",
                  moves ? "its motors move bodies that float"
                        : "nothing with a mass is joined to what "
                          "stands still",
                  candidates.empty() ? "" : ": ", listed(candidates)));
}

/// Removes the bodies that are not joined to the ground but by free joints.
void dropFloating(ModelGraph& graph, Sets& sets) {
  std::vector<std::size_t> index(graph.bodies.size());
  std::vector<GraphBody> kept;
  for (std::size_t i = 0; i < graph.bodies.size(); ++i) {
    index[i] = kept.size();
    if (sets.isGround(i))
      kept.push_back(graph.bodies[i]);
    else if (graph.bodies[i].mass > 0)
      graph.assumptions.push_back({"This body floats, without effect on an effort, and is left out",
                                   graph.bodies[i].name, graph.bodies[i].mass, "kg"});
  }
  auto& joints = graph.joints;
  joints.erase(std::remove_if(joints.begin(), joints.end(),
                              [&](const GraphJoint& joint) {
                                return !sets.isGround(joint.parent) || !sets.isGround(joint.child);
                              }),
               joints.end());
  for (GraphJoint& joint : joints) joint.parent = index[joint.parent], joint.child = index[joint.child];
  graph.bodies = std::move(kept);
}

/// Marks as closures the joints that the tree does not need. The file's own tree goes first.
void markClosures(ModelGraph& graph) {
  Sets sets(graph);
  for (const bool closures : {false, true})
    for (GraphJoint& joint : graph.joints)
      if (joint.closure == closures && (!closures || !joint.isOpen())) {
        const bool needed = sets.join(joint.parent, joint.child);
        joint.closure = !needed && joint.kind != JointKind::free;
      }
}

}  // namespace

void requireMechanism(const ModelGraph& graph) {
  for (const OtherForce& force : graph.other_forces)
    throw ImportError(
        fmt::format("{}; leave_out = [\"{}\"] in [mechanism] reads the file without them", force.refusal, force.kind),
        force.line);
  for (const GraphJoint& joint : graph.joints) {
    const GraphBody &parent = graph.bodies[joint.parent], &child = graph.bodies[joint.child];
    if (joint.parent == joint.child)
      refuseJoint(joint, fmt::format(": it joins {} to itself, expected two bodies", shown(parent.name)));
    if (joint.closure && parent.fixed && child.fixed)
      refuseJoint(joint, fmt::format(": it closes a loop between {} and {}, which both stand still, expected one that "
                                     "moves; see the closure's bodies and `base`",
                                     shown(parent.name), shown(child.name)));
    const bool is_ball = joint.kind == JointKind::ball;
    if (joint.stiffness != 0 && freedomsOf(joint.kind) != 1)
      refuseJoint(joint,
                  fmt::format(": a spring of stiffness {} in a joint of {} coordinates, expected it at a hinge or "
                              "slide; leave_out = [\"springs\"] in [mechanism] reads the file without springs",
                              joint.stiffness, freedomsOf(joint.kind)));
    if (is_ball && (joint.friction != 0 || (joint.damping != 0 && graph.format == ModelFormat::sdf)))
      refuseJoint(joint,
                  fmt::format(": a ball that rubs (damping {}, friction {}), {}; leave_out = [\"ball-friction\"] "
                              "in [mechanism] reads the file without",
                              joint.damping, joint.friction,
                              joint.friction != 0 ? "whose Coulomb friction depends on axes that it does not have"
                                                  : "in which readers of SDF differ"));
    if (joint.kind == JointKind::free && joint.isLoaded())
      refuseJoint(joint, fmt::format(": a free joint with damping {}, frictionloss {} and armature {}, expected none; "
                                     "MJCF's <freejoint> takes none from defaults",
                                     joint.damping, joint.friction, joint.rotor_inertia));
  }
}

void dropHeldJoints(ModelGraph& graph) {
  auto& joints = graph.joints;
  const auto is_held = [&](const GraphJoint& joint) {
    return graph.bodies[joint.parent].fixed && graph.bodies[joint.child].fixed && joint.kind != JointKind::fixed;
  };
  for (const GraphJoint& joint : joints) {
    if (!is_held(joint)) continue;
    if (joint.driven)
      refuseJoint(joint, fmt::format(": a motor drives it, but {} and {} stand still",
                                     shown(graph.bodies[joint.parent].name), shown(graph.bodies[joint.child].name)));
    graph.assumptions.push_back({"Both of its bodies stand still, and so does this joint", joint.name,
                                 static_cast<double>(freedomsOf(joint.kind)), "1"});
  }
  joints.erase(std::remove_if(joints.begin(), joints.end(), is_held), joints.end());
}

void hangTree(ModelGraph& graph) {
  requireMass(graph);
  Sets sets = heldTogether(graph);
  requireGround(graph, sets);
  dropFloating(graph, sets);
  markClosures(graph);
}

}  // namespace ursula::exchange

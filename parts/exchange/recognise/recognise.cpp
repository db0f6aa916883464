#include "parts/exchange/recognise/machine.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/csv_dialect.h"
#include "base/text.h"
#include "parts/exchange/keyframe.h"
#include "parts/exchange/leave_out.h"
#include "parts/exchange/recognise/legs.h"

namespace ursula::exchange {
namespace {

/// Applies `--close A:B`: a ball joins the origins of the two links' frames.
void close(ModelGraph& graph, const std::vector<std::string>& pairs) {
  for (const std::string& pair : pairs)
    if (!closeAtFrames(graph, pair,
                       [&](const std::string& name) { return bodyNamed(graph, name, "--close " + shown(pair)); }))
      throw ImportError(fmt::format("--close {}: expected two links, A:B", shown(pair)));
}

/// Applies `--actuated J,…` instead of the file's motors.
void drive(ModelGraph& graph, std::vector<std::string> names) {
  if (names.empty()) return;
  for (std::string& name : names) name = trimmedCell(name);
  graph.motors = names;
  std::vector<std::string> known;
  for (GraphJoint& joint : graph.joints) {
    joint.driven = false;
    if (known.size() < 1000) known.push_back(joint.name);
  }
  for (const std::string& name : names) {
    bool found = false;
    for (GraphJoint& joint : graph.joints) {
      if (joint.name != name) continue;
      if (found) throw ImportError(fmt::format("--actuated {}: two joints have that name", shown(name)), joint.line);
      found = joint.driven = true;
    }
    if (!found) throw ImportError(fmt::format("--actuated {}: no such joint{}", shown(name), didYouMean(name, known)));
  }
}

/// Makes a hinge of two balls between the same bodies, through both. MJCF closes a loop at a hinge this way.
void takeHinges(ModelGraph& graph, Assumptions& gaps) {
  const Groups groups(graph);
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> balls;
  for (std::size_t j = 0; j < graph.joints.size(); ++j) {
    GraphJoint& second = graph.joints[j];
    if (second.kind != JointKind::ball || !second.closure) continue;
    const auto [a, b] = std::minmax(groups.group_of[second.parent], groups.group_of[second.child]);
    const auto [found, is_new] = balls.emplace(std::pair(a, b), j);
    if (is_new) continue;
    GraphJoint& first = graph.joints[found->second];
    if (groups.group_of[first.parent] != groups.group_of[second.parent]) {
      std::swap(second.parent, second.child);
      std::swap(second.centre, second.centre_of_child);
    }
    const auto apartOn = [&](std::size_t body, std::size_t other, const Vector3d& one, const Vector3d& two) {
      return Vector3d(groups.moved[body].inverse() * groups.moved[other] * two - one);
    };
    const Vector3d apart = apartOn(first.parent, second.parent, first.centre, second.centre),
                   on_child = apartOn(first.child, second.child, first.centre_of_child, second.centre_of_child);
    if (first.kind != JointKind::ball || !(apart.norm() > 0) || !(on_child.norm() > 0)) continue;
    first.kind = JointKind::revolute;
    first.axis[0] = apart.normalized();
    if (apart != on_child) first.turn = Eigen::Quaterniond::FromTwoVectors(on_child, apart).toRotationMatrix();
    second.kind = JointKind::free;
    gaps.push_back({"These two points of a hinge are apart by so much more or less on its other body",
                    first.name + ", " + second.name, std::abs(apart.norm() - on_child.norm()), "m"});
    graph.assumptions.push_back({"Two balls between the same bodies are read as a hinge; this is their distance",
                                 first.name + ", " + second.name, apart.norm(), "m"});
  }
}

/// Returns the diagonal of the bounding box of all the legs' joints.
double sizeOf(const Chains& chains) {
  Vector3d least = Vector3d::Constant(1e300), most = Vector3d::Constant(-1e300);
  for (const Chain& leg : chains.legs)
    for (const Primitive& primitive : leg.primitives)
      for (const Vector3d& point : {primitive.inner, primitive.outer}) {
        least = least.cwiseMin(point);
        most = most.cwiseMax(point);
      }
  const double size = (most - least).norm();
  if (!(size > 0) || !std::isfinite(size))
    throw ImportError("all joints of the legs are at one point, expected a machine");
  return size;
}

class Recogniser {
 public:
  Recogniser(ModelGraph graph, const ImportChoices& choices) : graph_(std::move(graph)), choices_(choices) {}

  ImportedMachine machine() {
    close(graph_, choices_.closed);
    if (!choices_.key.empty()) takeKeyframe(graph_, 1, choices_.key);
    drive(graph_, choices_.actuated);
    leaveOut(graph_, choices_.leave_out, "--leave-out");  // before what is left is judged
    requireWords(graph_);
    Assumptions gaps;
    takeHinges(graph_, gaps);
    requireMass();
    machine_.name = graph_.name;
    machine_.assumptions = graph_.assumptions;
    Groups groups(graph_);
    double size = 0;
    std::vector<LegShape> shapes;
    const Chains chains = findLegs(groups, shapes, size);
    gaps.insert(gaps.end(), groups.contradictions.begin(), groups.contradictions.end());
    sayGaps(graph_, std::move(gaps), size, machine_.assumptions);
    Group platform = groups.groups[chains.platform];
    const Eigen::Isometry3d B = frameOfBase(groups), M = frameOfPlatform(groups, platform);
    requireMotors(chains, shapes);
    for (const LegShape& shape : shapes)
      machine_.legs.push_back(legOf({graph_, groups, shape, choices_, size, B, M, platform, machine_.assumptions}));
    takePlatform(platform, B, M);
    sayOrder();
    sayLimits(chains);
    proposeMotion(machine_, size);
    machine_.assumptions = inOrder(std::move(machine_.assumptions));
    return machine_;
  }

 private:
  void requireMass() const {
    for (const GraphBody& body : graph_.bodies)
      if (!body.fixed && body.mass > 0) return;
    throw ImportError(
        fmt::format("none of its {} bodies has a mass, but for the base: expected {} with mass and inertia",
                    graph_.bodies.size(), graph_.format == ModelFormat::mjcf ? "geoms or <inertial>" : "<inertial>"));
  }

  /// Finds the legs and their shapes. What has other numbers of motors and freedoms is refused for that first.
  Chains findLegs(Groups& groups, std::vector<LegShape>& shapes, double& size) {
    try {
      Chains chains = findChains(graph_, groups, choices_, machine_.assumptions);
      size = sizeOf(chains);
      for (const Chain& chain : chains.legs) shapes.push_back(shapeOf(graph_, groups, chain, size, choices_));
      return chains;
    } catch (const ImportError& error) {
      const std::optional<int> freedoms = freedomsOf(graph_, groups, choices_);
      if (!freedoms || *freedoms >= 6) throw;
      std::vector<std::string> motors;
      for (const GraphJoint& joint : graph_.joints)
        if (joint.driven) motors.push_back(shown(joint.name));
      const bool other_kind = motors.empty() || motors.size() == static_cast<std::size_t>(*freedoms);
      throw ImportError(
          fmt::format(
              "{} motor{}{} and {} freedom{} at the initial pose, expected six motors that move a platform with "
              "six freedoms by three to six legs{}",
              motors.size(), motors.size() == 1 ? "" : "s", motors.empty() ? "" : fmt::format(" ({})", listed(motors)),
              *freedoms, *freedoms == 1 ? "" : "s", other_kind ? "" : fmt::format("; {}", error.what())),
          other_kind ? 0 : error.line);
    }
  }

  Eigen::Isometry3d frameOf(const Groups& groups, std::size_t body) const {
    return groups.moved[body] * graph_.bodies[body].frame;
  }

  Eigen::Isometry3d frameOfBase(const Groups& groups) {
    machine_.base = choices_.base;
    if (choices_.base.empty()) return Eigen::Isometry3d::Identity();
    return frameOf(groups, bodyNamed(graph_, choices_.base, "--base"));
  }

  Eigen::Isometry3d frameOfPlatform(const Groups& groups, const Group& platform) {
    machine_.platform = choices_.platform.empty() ? platform.name : choices_.platform;
    return frameOf(groups,
                   choices_.platform.empty() ? platform.foremost : bodyNamed(graph_, choices_.platform, "--platform"));
  }

  /// Requires six motors in all; if the file names too few or none, it lists candidates.
  void requireMotors(const Chains& chains, const std::vector<LegShape>& shapes) const {
    std::size_t driven = 0;
    std::set<std::size_t> used;
    for (const Chain& chain : chains.legs)
      for (const Primitive& p : chain.primitives)
        if (used.insert(p.joint).second && graph_.joints[p.joint].driven) ++driven;
    for (std::size_t j = 0; j < graph_.joints.size(); ++j)
      if (graph_.joints[j].driven && used.count(j) == 0)
        refuseJoint(graph_.joints[j], " is driven and is not of a leg, expected motors of the legs alone");
    if (driven == 6) return;
    std::vector<std::string> names, usual;
    for (const LegShape& shape : shapes) {
      for (const Primitive& p : shape.joints)
        if (p.kind != Primitive::Kind::S) names.push_back(shown(graph_.joints[p.joint].name));
      const Primitive& driven_as_a_rule = shape.joints[shape.jointOf(rowOf(shape.kind).actuated).value()];
      usual.push_back(shown(graph_.joints[driven_as_a_rule.joint].name));
    }
    throw ImportError(fmt::format(
        "{} driven joint{}, expected six{}. Name all of them with --actuated J,…; candidates: {}{}", driven,
        driven == 1 ? "" : "s", driven == 0 ? fmt::format("; {} says nothing of motors here", formatInWords()) : "",
        fmt::join(names, ", "),
        usual.size() == 6 ? fmt::format(". As a rule: --actuated {}", fmt::join(usual, ",")) : ""));
  }

  const char* formatInWords() const {
    constexpr const char* words[] = {"SDF", "the file", "URDF"};
    return words[static_cast<std::size_t>(graph_.format)];
  }

  void takePlatform(const Group& platform, const Eigen::Isometry3d& B, const Eigen::Isometry3d& M) {
    requireWeight(platform);
    if (!(platform.mass > 0))
      throw ImportError(fmt::format("the platform, {}, has no mass, expected one above zero", shown(platform.name)),
                        platform.line);
    machine_.gravity = B.linear().transpose() * graph_.gravity;
    const Matrix3d local = M.linear().transpose() * platform.inertia * M.linear();
    machine_.of_platform = {platform.mass, M.inverse() * platform.center_of_mass,
                            snapped(local, false, platform, machine_.assumptions)};
    const Eigen::Isometry3d pose = B.inverse() * M;
    machine_.initial.p = pose.translation();
    machine_.initial.Q = pose.linear();
  }

  /// Says that efforts go leg by leg, if the file or the user gave the motors in another order.
  void sayOrder() {
    std::vector<std::string> motors;
    for (const ImportedLeg& leg : machine_.legs) motors.insert(motors.end(), leg.motors.begin(), leg.motors.end());
    if (!graph_.motors.empty() && motors != graph_.motors)
      machine_.assumptions.push_back(
          {"Efforts go leg by leg, which is not the order of the file's motors or of --actuated",
           fmt::format("{}", fmt::join(motors, ", ")), static_cast<double>(motors.size()), "1"});
  }

  /// Says which limits of joints are left out. Strokes of telescopic legs are kept; a scenario cannot express other
  /// limits.
  void sayLimits(const Chains& chains) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < chains.legs.size(); ++i)
      for (const Primitive& p : chains.legs[i].primitives) {
        const GraphJoint& joint = graph_.joints[p.joint];
        const bool kept = rowOf(machine_.legs[i].kind).isTelescopic() && p.kind == Primitive::Kind::P;
        if (!kept && (std::isfinite(joint.lower) || std::isfinite(joint.upper))) {
          names.push_back(shown(joint.name));
          if (!(joint.lower <= joint.position && joint.position <= joint.upper))
            machine_.assumptions.push_back({"The initial pose lies outside this joint's limits", joint.name,
                                            std::max(joint.lower - joint.position, joint.position - joint.upper),
                                            p.kind == Primitive::Kind::P ? "m" : "rad"});
        }
      }
    if (!names.empty())
      machine_.assumptions.push_back({"Limits of these joints are left out: a scenario has no key for them",
                                      fmt::format("{}", fmt::join(names, ", ")), static_cast<double>(names.size()),
                                      "1"});
  }

  ModelGraph graph_;
  const ImportChoices& choices_;
  ImportedMachine machine_;
};

}  // namespace

ImportedMachine recognise(ModelGraph graph, const ImportChoices& choices) {
  return Recogniser(std::move(graph), choices).machine();
}

}  // namespace ursula::exchange

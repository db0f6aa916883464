#include "parts/exchange/keyframe.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/text.h"
#include "parts/exchange/read/mjcf_parts.h"

namespace ursula::exchange {
namespace {

constexpr double worth_a_keyframe = 1e-3;

/// Returns the widest gap of a closure, as a share of the machine's size or in rad.
double widestGap(const ModelGraph& graph, double size) {
  double widest = 0;
  for (const GraphJoint& joint : graph.joints)
    if (joint.closure)
      widest = std::max(
          {widest, (joint.centre - joint.centre_of_child).norm() / size, Eigen::AngleAxisd(joint.turn).angle()});
  return widest;
}

std::vector<double> coordinatesOf(const ModelGraph& graph, const Keyframe& key) {
  std::size_t expected = 0;
  for (const GraphJoint& joint : graph.joints)
    if (!joint.closure)
      expected += joint.kind == JointKind::free ? 7 : joint.kind == JointKind::ball ? 4 : freedomsOf(joint.kind);
  std::vector<double> out;
  std::istringstream words(key.qpos);
  for (std::string word; words >> word && out.size() <= expected;) {
    const LeadingNumber number = leadingNumber(word);
    if (number.length != word.size() || !(std::abs(number.value) <= most_value))
      throw ImportError(
          fmt::format("keyframe '{}': qpos has '{}', expected finite decimal numbers", shown(key.name), shown(word)),
          key.line);
    out.push_back(number.value);
  }
  if (out.size() != expected)
    throw ImportError(
        fmt::format("keyframe '{}': qpos has {} numbers, expected {}, one for each coordinate", shown(key.name),
                    out.size() > expected ? "more" : std::to_string(out.size()), expected),
        key.line);
  return out;
}

Matrix3d rotationOf(const double* q) {
  const Eigen::Quaterniond quaternion(q[0], q[1], q[2], q[3]);
  return quaternion.norm() > 1e-12 ? quaternion.normalized().toRotationMatrix() : Matrix3d::Identity();
}

Eigen::Isometry3d about(const Vector3d& centre, const Matrix3d& turn) {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() = turn;
  out.translation() = centre - turn * centre;
  return out;
}

/// Returns the displacement in the world that a joint's coordinates `q` bring to its child, while its parent stands
/// still; a free joint's parent is the world.
Eigen::Isometry3d displacement(const GraphJoint& joint, const Eigen::Isometry3d& frame, const double* q) {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  if (joint.kind == JointKind::revolute)
    return about(joint.centre, Eigen::AngleAxisd(q[0] - joint.position, joint.axis[0]).toRotationMatrix());
  if (joint.kind == JointKind::prismatic) out.translation() = (q[0] - joint.position) * joint.axis[0];
  if (joint.kind == JointKind::ball)
    return about(joint.centre, frame.linear() * rotationOf(q) * frame.linear().transpose());
  if (joint.kind != JointKind::free) return out;
  out.linear() = rotationOf(q + 3);
  out.translation() = Vector3d(q[0], q[1], q[2]);
  return out * frame.inverse();
}

/// Returns the displacement of each body. Bodies come after their parents.
std::vector<Eigen::Isometry3d> displacements(ModelGraph& graph, const std::vector<double>& q) {
  std::vector<Eigen::Isometry3d> out(graph.bodies.size(), Eigen::Isometry3d::Identity());
  std::size_t at = 0;
  for (GraphJoint& joint : graph.joints) {
    if (joint.closure) continue;
    out[joint.child] = out[joint.parent] * displacement(joint, graph.bodies[joint.child].frame, q.data() + at);
    const int count = freedomsOf(joint.kind);
    if (count == 1) joint.position = q[at];
    at += static_cast<std::size_t>(joint.kind == JointKind::free || joint.kind == JointKind::ball ? count + 1 : count);
  }
  return out;
}

void moveBy(const std::vector<Eigen::Isometry3d>& moved, ModelGraph& graph) {
  for (GraphJoint& joint : graph.joints) {
    const Eigen::Isometry3d &parent = moved[joint.parent], &child = moved[joint.child];
    joint.centre_of_child = child * joint.centre_of_child;
    joint.centre = joint.closure ? parent * joint.centre : joint.centre_of_child;
    joint.axis = {parent.linear() * joint.axis[0], parent.linear() * joint.axis[1]};
    if (joint.closure && joint.kind == JointKind::fixed)
      joint.turn = parent.linear() * joint.turn * child.linear().transpose();
  }
  for (std::size_t i = 0; i < moved.size(); ++i) {
    GraphBody& body = graph.bodies[i];
    body.frame = moved[i] * body.frame;
    body.center_of_mass = moved[i] * body.center_of_mass;
    body.inertia = (moved[i].linear() * body.inertia * moved[i].linear().transpose()).eval();
  }
}

[[noreturn]] void refuseKey(const ModelGraph& graph, const std::string& asked) {
  std::vector<std::string> names;
  for (const Keyframe& key : graph.keyframes) names.push_back(key.name);
  throw ImportError(fmt::format("no keyframe '{}', {}{}", shown(asked),
                                names.empty()
                                    ? "as the file has none"
                                    : shown(fmt::format("expected one of '{}'", fmt::join(names, "', '")), 400),
                                didYouMean(asked, names)));
}

}  // namespace

void takeKeyframe(ModelGraph& graph, double size, const std::string& asked) {
  const double gap = widestGap(graph, size);
  const auto named = [&graph](const std::string& name) {
    return std::find_if(graph.keyframes.begin(), graph.keyframes.end(),
                        [&](const Keyframe& key) { return key.name == name; });
  };
  const auto home = named(asked.empty() ? "home" : asked);
  if (!asked.empty() && home == graph.keyframes.end()) refuseKey(graph, asked);
  if (asked.empty() && (!(gap > worth_a_keyframe) || (home == graph.keyframes.end() && graph.keyframes.size() != 1)))
    return;
  const Keyframe key = home == graph.keyframes.end() ? graph.keyframes[0] : *home;
  if (key.qpos.empty()) return;
  ModelGraph at_key = graph;
  moveBy(displacements(at_key, coordinatesOf(graph, key)), at_key);
  if (asked.empty() && !(widestGap(at_key, size) < gap)) return;
  graph = std::move(at_key);
  for (const GraphJoint& joint : graph.joints)
    if (joint.kind == JointKind::ball && !joint.closure)
      graph.assumptions.push_back(
          {"This ball's quaternion counts from the keyframe, not from the file's zero", joint.name});
  const std::string taken = fmt::format("The initial pose is that of the keyframe '{}'", shown(key.name));
  for (Assumption& each : graph.assumptions)
    if (each.what == keyframes_left_out)
      each = asked.empty() ? Assumption{taken +
                                            ", as the bodies' own leaves loops open by this, in rad or of the "
                                            "machine's size",
                                        "<keyframe>", gap}
                           : Assumption{taken, "<keyframe>"};
}

}  // namespace ursula::exchange

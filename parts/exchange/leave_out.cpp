#include "parts/exchange/leave_out.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.h"

namespace ursula::exchange {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// A number of joints, and what its absence is.
struct LeavableNumber {
  double GraphJoint::*member;
  double without;
  const char* said;
  const char *unit_of_turn, *unit_of_slide;
};

/// A word of the user, the joints that it means, and which of their numbers go.
struct Leavable {
  const char* word;
  bool (*means)(const GraphJoint&);
  std::vector<LeavableNumber> numbers;
};

bool isBall(const GraphJoint& joint) { return joint.kind == JointKind::ball; }
bool isPassive(const GraphJoint& joint) { return !joint.driven; }
bool isAny(const GraphJoint& /*joint*/) { return true; }

const std::vector<Leavable>& leavables() {
  static const LeavableNumber damping = {&GraphJoint::damping, 0, "Its damping is left out", "N·m·s/rad", "N·s/m"};
  static const LeavableNumber friction = {&GraphJoint::friction, 0, "Its Coulomb friction is left out", "N·m", "N"};
  static const std::vector<Leavable> all = {
      {"ball-friction", isBall, {damping, friction}},
      {"passive-armature",
       isPassive,
       {{&GraphJoint::rotor_inertia, 0, "Its armature is left out, as no motor drives it", "kg·m²", "kg"}}},
      {"passive-friction", isPassive, {damping, friction}},
      {"springs", isAny, {{&GraphJoint::stiffness, 0, "Its spring is left out", "N·m/rad", "N/m"}}},
      {"limits",
       isAny,
       {{&GraphJoint::lower, -endless, "Its lower limit is left out", "rad", "m"},
        {&GraphJoint::upper, endless, "Its upper limit is left out", "rad", "m"}}}};
  return all;
}

void leaveOutFluid(ModelGraph& graph) {
  auto& forces = graph.other_forces;
  const auto is_other = [](const OtherForce& force) { return force.kind != "fluid"; };
  const auto fluid = std::stable_partition(forces.begin(), forces.end(), is_other);
  for (auto force = fluid; force != forces.end(); ++force) graph.assumptions.push_back(force->left_out);
  forces.erase(fluid, forces.end());
}

void leaveOut(ModelGraph& graph, const Leavable& kind) {
  for (GraphJoint& joint : graph.joints)
    for (const LeavableNumber& number : kind.numbers) {
      double& value = joint.*number.member;
      if (value == number.without || !kind.means(joint)) continue;
      graph.assumptions.push_back(
          {number.said, joint.name, value, joint.slides() ? number.unit_of_slide : number.unit_of_turn});
      value = number.without;
    }
}

}  // namespace

void leaveOut(ModelGraph& graph, const std::vector<std::string>& words, const std::string& place) {
  std::vector<std::string> known = {"fluid"};
  for (const Leavable& kind : leavables()) known.emplace_back(kind.word);
  for (const std::string& word : words) {
    const auto kind =
        std::find_if(leavables().begin(), leavables().end(), [&](const Leavable& each) { return each.word == word; });
    if (word == "fluid")
      leaveOutFluid(graph);
    else if (kind != leavables().end())
      leaveOut(graph, *kind);
    else
      throw InvalidParameter(place, fmt::format("'{}'", shown(word)),
                             fmt::format("{}{}", fmt::join(known, ", "), didYouMean(word, known)));
  }
}

}  // namespace ursula::exchange

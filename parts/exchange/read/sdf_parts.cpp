#include "parts/exchange/read/sdf_parts.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "base/scalar.h"
#include "base/text.h"

namespace ursula::exchange {
namespace {

const std::set<std::string> known_in_dynamics = wordsOf("damping friction spring_reference spring_stiffness");
const std::set<std::string> known_in_inertial = wordsOf("mass pose inertia frame fluid_added_mass density");

void takeLimits(const Element& joint_element, const Element& axis, GraphJoint& joint) {
  const Element* limit = onlyChild(axis, "limit");
  if (limit == nullptr) return;
  takeRange(*limit, childText, joint);
  if (joint.lower == joint.upper)
    refuse(joint_element,
           fmt::format(
               "lower and upper limit are both {}: it cannot move; expected a joint of type fixed, or limits apart",
               joint.lower));
  requireRange(joint_element, joint);
}

void takeDynamics(const Element& joint_element, const Element& dynamics, GraphJoint& joint) {
  takeRubbing(joint_element, dynamics, childText, joint);
  takeSpring(joint_element, childText(dynamics, "spring_stiffness"), childText(dynamics, "spring_reference"), joint);
}

/// Refuses what cannot be had as numbers: an inertia from shapes.
void requirePlain(const Element& link, const Element& inertial) {
  if (attribute(inertial, "auto") == "true")
    refuse(link, "an inertia that is left to the program (auto), expected numbers; run: gz sdf -p FILE");
  const Element* pose = inertial.FirstChildElement("pose");
  for (const char* name : {"relative_to", "frame"})
    if (pose != nullptr && !attribute(*pose, name).empty())
      refuse(link,
             fmt::format("{} in the <pose> of <inertial>, which SDF does not allow: that is always in the link", name));
}

}  // namespace

SdfFrames::SdfFrames() : frames_(1), names_(1), done_(1, 1), in_world_(1, Eigen::Isometry3d::Identity()) {
  names_[0].emplace("world", world);
}

std::size_t SdfFrames::add(const std::string& name, Frame frame) {
  const std::size_t index = frames_.size();
  if (!names_[frame.scope].emplace(name, index).second)
    refuse(*frame.element, fmt::format("a second '{}' in one model, expected unique names", shown(name)));
  frames_.push_back(std::move(frame));
  names_.emplace_back();
  done_.push_back(0);
  in_world_.push_back(Eigen::Isometry3d::Identity());
  return index;
}

std::size_t SdfFrames::find(const Element& at, std::size_t scope, const std::string& name, const char* what) const {
  if (name == "__model__") return scope;
  std::size_t from = 0;
  while (true) {
    if (const auto whole = names_[scope].find(name.substr(from)); whole != names_[scope].end()) return whole->second;
    const std::size_t end = name.find("::", from);
    const auto next = names_[scope].find(name.substr(from, end == std::string::npos ? end : end - from));
    if (end == std::string::npos || next == names_[scope].end()) break;
    scope = next->second;
    from = end + 2;
  }
  if (name == "world") return world;
  std::vector<std::string> known;
  for (const auto& [each, index] : names_[scope])
    if (known.size() < 1000) known.push_back(each);
  std::sort(known.begin(), known.end());
  refuse(at, fmt::format("{} '{}': nothing has that name here{}", what, shown(name), didYouMean(name, known)));
}

std::size_t SdfFrames::parentOf(std::size_t i) const {
  const Frame& frame = frames_[i];
  if (frame.relative_to.empty()) return frame.parent;
  return find(*frame.element, frame.scope, frame.relative_to, "relative_to");
}

Eigen::Isometry3d SdfFrames::inWorld(std::size_t frame) {
  std::vector<std::size_t> open;
  for (std::size_t i = frame; done_[i] != 1; i = parentOf(i)) {
    if (done_[i] == 2) refuse(*frames_[i].element, "its pose is relative to itself, in a circle");
    done_[i] = 2;
    open.push_back(i);
  }
  for (auto i = open.rbegin(); i != open.rend(); ++i) {
    in_world_[*i] = in_world_[parentOf(*i)] * frames_[*i].pose;
    done_[*i] = 1;
  }
  return in_world_[frame];
}

void SdfFrames::requireSound() {
  std::vector<std::size_t> state(frames_.size(), none);  // the frame from which each was met
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    static_cast<void>(inWorld(i));
    for (std::size_t at = i; frames_[at].kind == Kind::frame && state[at] == none;) {
      const Frame& here = frames_[at];
      state[at] = i;
      at = find(*here.element, here.scope, here.attached_to.empty() ? "__model__" : here.attached_to, "attached_to");
      if (state[at] == i) refuse(*here.element, "is attached to itself, in a circle");
    }
  }
}

std::size_t SdfFrames::bodyOf(const Element& at, std::size_t frame) const {
  for (std::size_t step = 0; step <= frames_.size(); ++step) {
    const Frame& here = frames_[frame];
    if (here.kind == Kind::world) return none;
    if (here.body != none) return here.body;  // a link, or a model's first link
    if (here.kind == Kind::model) refuse(at, "a model without links, expected a link");
    frame = find(*here.element, here.scope, here.attached_to.empty() ? "__model__" : here.attached_to, "attached_to");
  }
  refuse(at, "its frame is attached to itself, in a circle");
}

Eigen::Isometry3d sdfPoseOf(const Element& element) {
  const Element* pose = onlyChild(element, "pose");
  if (pose == nullptr || textOf(*pose).empty()) return Eigen::Isometry3d::Identity();
  const std::string format = attribute(*pose, "rotation_format");
  const bool quaternion = format == "quat_xyzw";
  if (!format.empty() && !quaternion && format != "euler_rpy")
    refuse(*pose, fmt::format("rotation_format '{}', expected euler_rpy or quat_xyzw", shown(format)));
  const std::vector<double> v = numbersOf(*pose, textOf(*pose), quaternion ? 7 : 6, "<pose>");
  const Vector3d position(v[0], v[1], v[2]);
  if (quaternion) {
    const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
    if (!(q.norm() > 1e-12)) refuse(*pose, "a quaternion of zero");
    return placed(position, q.normalized().toRotationMatrix());
  }
  Vector3d angles(v[3], v[4], v[5]);
  const std::string degrees = attribute(*pose, "degrees");
  if (!degrees.empty() && truthOf(*pose, degrees, "degrees")) angles *= pi / 180;
  return placed(position, rollPitchYaw(angles));
}

void noteAddedMass(const Element& link, ModelGraph& graph) {
  const Element* inertial = onlyChild(link, "inertial");
  if (inertial == nullptr || inertial->FirstChildElement("fluid_added_mass") == nullptr) return;
  graph.other_forces.push_back(
      {"fluid",
       named(link) + ": <fluid_added_mass>, which a scenario has no words for",
       link.GetLineNum(),
       {"The mass that a fluid adds to this body is left out", attribute(link, "name"), 1, "1"}});
}

void takeSdfInertial(const Element& link, GraphBody& body, Assumptions& assumptions) {
  const Element* inertial = onlyChild(link, "inertial");
  Eigen::Isometry3d at = body.frame;
  std::string mass;
  const Element* inertia = nullptr;
  if (inertial != nullptr) {
    listUnknown(*inertial, known_in_inertial, assumptions);
    requirePlain(link, *inertial);
    mass = childText(*inertial, "mass");
    inertia = onlyChild(*inertial, "inertia");
    at = at * sdfPoseOf(*inertial);
  }
  body.mass = mass.empty() ? 1 : numberOf(link, mass, "<mass>");
  if (body.mass < 0) refuse(link, fmt::format("a mass of {}, expected none below zero", body.mass));
  if ((mass.empty() || inertia == nullptr) && !body.fixed)
    assumptions.push_back(
        {mass.empty()
             ? "The file gives no mass: SDF's default of 1 kg, with 1 kg·m² where no inertia is given, was taken"
             : "The file gives no inertia: SDF's default of 1 kg·m² was taken",
         body.name, 1, mass.empty() ? "kg" : "kg·m²"});
  body.center_of_mass = at.translation();
  body.inertia = at.linear() * at.linear().transpose();
  if (inertia == nullptr) return;
  const auto missing = [&](std::size_t k, const char* name) {
    if (k < 3 && !body.fixed)
      assumptions.push_back(
          {fmt::format("The file gives no {}: SDF's default of 1 kg·m² was taken", name), body.name, 1, "kg·m²"});
    return k < 3 ? 1.0 : 0.0;
  };
  takeInertia(*inertia, childText, at, missing, body);
}

void takeSdfMotion(const Element& joint_element, const Element& axis, bool endless, GraphJoint& joint,
                   Assumptions& assumptions) {
  if (axis.FirstChildElement("mimic"))
    refuse(joint_element, fmt::format("mimic, which a scenario has no words for; {}", without_it));
  if (!endless) takeLimits(joint_element, axis, joint);
  if (const std::string driven = attribute(axis, "ursula:driven"); !driven.empty())
    joint.driven = truthOf(axis, driven, "ursula:driven");
  if (const std::string rotor = attribute(axis, "ursula:rotor_inertia"); !rotor.empty())
    joint.rotor_inertia = numberOf(axis, rotor, "ursula:rotor_inertia");
  if (const Element* dynamics = onlyChild(axis, "dynamics")) {
    listUnknown(*dynamics, known_in_dynamics, assumptions);
    takeDynamics(joint_element, *dynamics, joint);
  }
}

void takeRange(const Element& limit, TextOfWord text, GraphJoint& joint) {
  for (const auto& [name, to] : {std::pair("lower", &joint.lower), std::pair("upper", &joint.upper)}) {
    const std::string word = text(limit, name);
    if (word.empty()) continue;
    const bool endless = word == "inf" || word == "-inf" || word == "+inf";
    *to = endless ? HUGE_VAL : numberOf(limit, word, name, HUGE_VAL);
    if (std::abs(*to) >= 1e16) *to = to == &joint.lower ? -HUGE_VAL : HUGE_VAL;
  }
}

void requireRange(const Element& element, const GraphJoint& joint) {
  if (joint.lower > joint.upper)
    refuse(element,
           fmt::format("its lower limit, {}, is above its upper one, {}; expected it below", joint.lower, joint.upper));
}

void takeSpring(const Element& joint_element, const std::string& stiffness, const std::string& reference,
                GraphJoint& joint) {
  joint.stiffness = stiffness.empty() ? 0 : numberOf(joint_element, stiffness, "a spring's stiffness");
  joint.spring_reference = reference.empty() ? 0 : numberOf(joint_element, reference, "a spring's reference");
  if (joint.stiffness < 0)
    refuse(joint_element, fmt::format("a spring's stiffness of {}, expected none below zero", joint.stiffness));
}

void takeRubbing(const Element& joint_element, const Element& dynamics, TextOfWord text, GraphJoint& joint) {
  for (const auto& [name, to] : {std::pair("damping", &joint.damping), std::pair("friction", &joint.friction)}) {
    const std::string word = text(dynamics, name);
    *to = word.empty() ? 0 : numberOf(dynamics, word, name);
    if (*to < 0) refuse(joint_element, fmt::format("{} {}, expected none below zero", name, *to));
  }
  const std::string speed = attribute(dynamics, "ursula:smoothing_speed");
  joint.smoothing_speed = speed.empty() ? 0 : numberOf(dynamics, speed, "ursula:smoothing_speed");
}

void listPlugins(const Element& element, const std::string& of, Assumptions& assumptions) {
  eachChild(element, "plugin", [&](const Element& e) {
    const std::string file = attribute(e, "filename");
    for (const char* word : {"mimic", "spring"})
      if (file.find(word) != std::string::npos)
        refuse(e, fmt::format("{} lets a joint follow another or pulls at it, which a scenario has no words for; {}",
                              shown(file), without_it));
    assumptions.push_back(
        {fmt::format("The plugin {} is left out, with the forces that it may bring", shown(file)), of});
  });
}

void refuseSdfDecay(const Element& element, const std::string& factor) {
  const Element* decay = onlyChild(element, "velocity_decay");
  for (const std::string& text : {factor, decay == nullptr ? "" : childText(*decay, "linear"),
                                  decay == nullptr ? "" : childText(*decay, "angular")})
    if (!text.empty() && numberOf(element, text, "velocity_decay") != 0)
      refuse(element,
             fmt::format("a decay of velocity of {}, which a scenario has no words for; {}", text, without_it));
}

void refuseSdfIncludes(const Element& scope, Assumptions& assumptions) {
  eachChild(scope, "include", [&](const Element& include) {
    const std::string uri = childText(include, "uri");
    if (std::string(scope.Name()) == "world" && (uri == "model://sun" || uri == "model://ground_plane"))
      assumptions.push_back({fmt::format("{} is left out: light and floor are no part of a machine", uri),
                             fmt::format("<include> of line {}", include.GetLineNum())});
    else
      refuse(include, fmt::format("includes {}, which is not fetched; put its <model> into this file (gz sdf -p FILE)",
                                  shown(uri)));
  });
}

void readSdfGravity(const Element& top, int minor, ModelGraph& graph) {
  const Element* gravity = onlyChild(top, "gravity");
  eachChild(top, "physics", [&](const Element& physics) {
    const Element* own = onlyChild(physics, "gravity");
    if (own != nullptr && gravity != nullptr) refuse(*own, "a second <gravity>, expected one");
    if (own != nullptr && minor > 5) {
      graph.assumptions.push_back(
          {"<gravity> of <physics> has no meaning from SDF 1.6 on and was left out, as by "
           "SDFormat; a <gravity> of <world> has one",
           fmt::format("<gravity> of line {}", own->GetLineNum()), vectorOf(*own, textOf(*own), "gravity").norm(),
           "m/s²"});
      return;
    }
    if (own != nullptr) gravity = own;
  });
  if (gravity != nullptr)
    graph.gravity = vectorOf(*gravity, textOf(*gravity), "gravity");
  else
    graph.assumptions.push_back({"The file gives no gravity: SDF's default of 9.8 m/s² along −z was taken",
                                 fmt::format("<{}>", top.Name()), 9.8, "m/s²"});
}

}  // namespace ursula::exchange

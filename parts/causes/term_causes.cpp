#include "parts/causes/tried_causes.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace ursula {
namespace {

using Wrench = std::function<Vector6d(const BodyTerms&)>;

/// A group of bodies with its names in texts and in the contract.
struct Group {
  const char* words;
  const char* body;
  bool proximal, distal, platform;
};
constexpr Group groups[] = {{"the platform", "platform", false, false, true},
                            {"the links", "legs", true, true, false},
                            {"the proximal links", "proximal", true, false, false},
                            {"the distal links", "distal", false, true, false},
                            {"every body", "all", true, true, true}};
constexpr const Group *platform_group = &groups[0], *links_group = &groups[1], *proximal_group = &groups[2],
                      *distal_group = &groups[3];

/// Σ Tᵀ w over the group.
Vector6d effortsOf(const MachineTerms& machine, const Group& group, const Wrench& wrench) {
  Vector6d out = Vector6d::Zero();
  const auto add = [&](const BodyTerms& body) { out += body.T.transpose() * wrench(body); };
  if (group.proximal)
    for (const OpenLeg& leg : machine.legs) add(leg.proximal);
  if (group.distal)
    for (const OpenLeg& leg : machine.legs) add(leg.distal);
  if (group.platform) add(machine.platform);
  return out;
}

// The parts of a body's wrench.
Vector6d gravity(const BodyTerms& body) { return -body.gravityWrench(); }
Vector6d gyroscopic(const BodyTerms& body) { return momentWrench(body.omega().cross(body.inertia * body.omega())); }
Vector6d acceleratedInertia(const BodyTerms& body) { return momentWrench(body.inertia * body.twist_rate.head<3>()); }
Vector6d turningInertia(const BodyTerms& body) { return gyroscopic(body) + acceleratedInertia(body); }
Vector6d movingInertia(const BodyTerms& body) { return forceWrench(body.mass * body.twist_rate.tail<3>()); }
Vector6d inertia(const BodyTerms& body) { return body.inertiaWrench(body.twist_rate); }
Vector6d everything(const BodyTerms& body) { return inertia(body) + gravity(body); }
Vector6d centripetal(const BodyTerms& body) {
  return forceWrench(body.mass * body.omega().cross(body.omega().cross(body.from)));
}
Vector6d tangential(const BodyTerms& body) {
  return forceWrench(body.mass * body.twist_rate.head<3>().cross(body.from));
}
Vector6d coriolis(const BodyTerms& body) { return forceWrench(2 * body.mass * body.omega().cross(body.sliding)); }
Vector6d halfCoriolis(const BodyTerms& body) { return coriolis(body) / 2; }

/// The velocity-dependent part of a link's accelerations; its moment excludes the gyroscopic one.
Vector6d turningBias(const BodyTerms& body) { return momentWrench(body.inertia * body.bias.head<3>()); }
Vector6d movingBias(const BodyTerms& body) { return forceWrench(body.mass * body.bias.tail<3>()); }
Vector6d bias(const BodyTerms& body) { return turningBias(body) + movingBias(body); }
Vector6d velocityTerms(const BodyTerms& body) { return bias(body) + gyroscopic(body); }

/// The moment about the first joint, or P, of a part's force.
Wrench ofItsArm(const Wrench& part) {
  return [part](const BodyTerms& body) { return momentWrench(body.from.cross(Vector3d(part(body).tail<3>()))); };
}

/// A twist or its rate without the link's rotation about its own line. For ω̇ it is the rate of ω without spin.
Vector6d withoutSpin(const BodyTerms& body, const Vector6d& twist) {
  Vector6d out = twist;
  out.head<3>() -= body.line.dot(twist.head<3>()) * body.line;
  return out;
}
BodyTerms withoutSpin(const BodyTerms& body) {
  BodyTerms out = body;
  out.twist = withoutSpin(body, body.twist);
  out.twist_rate = withoutSpin(body, body.twist_rate);
  const Vector3d omega = body.omega();
  out.twist_rate.head<3>() -= body.line.dot(omega) * omega.cross(body.line);
  return out;
}

/// The change of a part's wrench with another tensor in B that a solver may mistake for the body's.
Wrench withTensor(Matrix3d (*tensor)(const BodyTerms&), const Wrench& part = inertia) {
  return [tensor, part](const BodyTerms& body) {
    BodyTerms other = body;
    other.inertia = tensor(body);
    return Vector6d(part(other) - part(body));
  };
}

Matrix3d steiner(const BodyTerms& body) { return pointInertia(body.mass, body.from); }

/// Adds what `wrench` makes of a group's bodies, `times`.
void addOf(const Group& group, const std::string& text, NamedCause named, const Wrench& wrench, TriedCauses& out,
           double times = 1) {
  named.body = group.body;
  out.addEfforts({text, named}, [&group, wrench, times](const MachineTerms& machine) {
    return Vector6d(times * effortsOf(machine, group, wrench));
  });
}

/// Adds a part of the wrenches of each group, omitted, doubled or with the wrong sign.
void addPart(const std::string& what, const char* term, const Wrench& part, TriedCauses& out,
             const Group* only = nullptr, bool may_be_other = true) {
  for (const Group& group : groups) {
    if (only != nullptr && only != &group) continue;
    const std::string which = what + " of " + group.words;
    addOf(group, which + " left out", {CauseKind::missing_term, term}, part, out, -1);
    if (!may_be_other) continue;
    addOf(group, which + " with the wrong sign", {CauseKind::sign, term}, part, out, -2);
    addOf(group, which + " doubled", {CauseKind::scale, term, "", "", "", 1, 2}, part, out);
  }
}

/// Ways to leave out the spin: of motion and reaction, of the motion, or of ω and ω̇ without its effect on ω̇.
enum class Spinless { motion_and_reaction, motion, crudely };

Wrench withoutSpinOf(Spinless way) {
  return [way](const BodyTerms& body) {
    BodyTerms still = withoutSpin(body);
    if (way == Spinless::crudely) {
      const double spin = body.line.dot(body.omega());
      still.twist_rate.head<3>() += spin * body.omega().cross(body.line);
      still.twist_rate.tail<3>() -= spin * body.line.dot(body.from) * still.omega();
    }
    Vector6d wrench = inertia(still);
    // Tᵀ without spin takes no moment about the line
    if (way == Spinless::motion_and_reaction) wrench = withoutSpin(body, wrench);
    return Vector6d(wrench - inertia(body));
  };
}

void addSpin(const Group& group, TriedCauses& out) {
  const std::pair<Spinless, const char*> ways[] = {{Spinless::motion_and_reaction, ""},
                                                   {Spinless::motion, " of their motion"},
                                                   {Spinless::crudely, " of omega and its rate"}};
  for (const auto& [way, words] : ways)
    addOf(group, fmt::format("the spin of {} about their own lines left out{}", group.words, words),
          {CauseKind::missing_term, "spin"}, withoutSpinOf(way), out);
}

void addWeightOfLeg(std::size_t leg, const Group& group, TriedCauses& out) {
  NamedCause named{CauseKind::missing_term, "gravity", group.body};
  named.leg = static_cast<int>(leg) + 1;
  out.addEfforts({fmt::format("gravity of {} of leg {} left out", group.words, leg + 1), named},
                 [&group, leg](MachineTerms machine) {
                   machine.legs = {machine.legs[leg]};
                   return Vector6d(-effortsOf(machine, group, gravity));
                 });
}

/// The weight turned from where it acts.
Wrench withTurnedWeight(bool back) {
  return [back](const BodyTerms& body) {
    BodyTerms other = body;
    other.gravity = (back ? Matrix3d(body.R.transpose()) : body.R) * body.gravity;
    return Vector6d(gravity(other) - gravity(body));
  };
}

Wrench leftInOwnFrame(const Wrench& moment) {
  return [moment](const BodyTerms& body) {
    const Vector3d n = moment(body).head<3>();
    return momentWrench(body.R.transpose() * n - n);
  };
}

Matrix3d ofOwnFrame(const BodyTerms& body) { return body.R.transpose() * body.inertia * body.R; }
Matrix3d turnedBackwards(const BodyTerms& body) {
  const Matrix3d twice = body.R * body.R;
  return twice.transpose() * body.inertia * twice;
}

/// Such a body may be impossible, so no machine is built from it.
void addTensors(TriedCauses& out) {
  const auto add = [&out](const char* before, const char* after, CauseKind kind, const char* term,
                          const Wrench& change) {
    for (const Group& group : groups)
      addOf(group, std::string(before) + group.words + after, {kind, term}, change, out);
  };
  add("inertia of ", " not turned into the base's frame", CauseKind::frame, "inertia", withTensor(ofOwnFrame));
  add("inertia of ", " turned the wrong way", CauseKind::frame, "inertia", withTensor(turnedBackwards));
  add("inertia of ", " turned on one side only", CauseKind::frame, "inertia",
      withTensor([](const BodyTerms& body) -> Matrix3d { return body.inertia * body.R; }));
  add("inertia of ", " about the first joint, or P, used as about the mass centre", CauseKind::reference_point,
      "inertia", withTensor([](const BodyTerms& body) -> Matrix3d { return body.inertia + steiner(body); }));
  add("inertia of ", ", about the mass centre, taken for such about the first joint, or P", CauseKind::reference_point,
      "inertia", withTensor([](const BodyTerms& body) -> Matrix3d { return body.inertia - steiner(body); }));
  add("gravity of ", " along its own axes", CauseKind::frame, "gravity", withTurnedWeight(false));
  add("gravity of ", " turned the wrong way", CauseKind::frame, "gravity", withTurnedWeight(true));
  for (const auto& [words, times] : {std::pair("not turned into the base's frame", 1), {"turned the wrong way", 2}})
    out.addEfforts(
        {fmt::format("the arm of the platform's weight {}", words), {CauseKind::frame, "gravity", "platform"}},
        [times = times](const MachineTerms& machine) {
          Vector3d arm = machine.rho;
          for (int k = 0; k < times; ++k) arm = (machine.platform.R.transpose() * arm).eval();
          const Vector3d weight = gravity(machine.platform).tail<3>();
          return Vector6d(machine.T_P.transpose() * momentWrench((arm - machine.rho).cross(weight)));
        });
  for (const Group& group : groups)
    if (!group.platform)
      addOf(group, fmt::format("weights of {} put at their first joints", group.words),
            {CauseKind::reference_point, "gravity"}, ofItsArm(gravity), out, -1);
  add("the gyroscopic moment of ", " left in its own frame", CauseKind::frame, "gyroscopic",
      leftInOwnFrame(gyroscopic));
  add("the moment of inertia of ", " left in its own frame", CauseKind::frame, "inertia",
      leftInOwnFrame(turningInertia));
  add("the gyroscopic moment of ", " with the tensor of its own frame", CauseKind::frame, "gyroscopic",
      withTensor(ofOwnFrame, gyroscopic));
  add("the moment of angular acceleration of ", " with the tensor of its own frame", CauseKind::frame, "inertia",
      withTensor(ofOwnFrame, acceleratedInertia));
}

}  // namespace

void addTermCauses(TriedCauses& out) {
  for (const Group* of : {platform_group, links_group, proximal_group, distal_group})
    addPart("gravity", "gravity", gravity, out, of);
  addPart("the gyroscopic moment", "gyroscopic", gyroscopic, out);
  addPart("the centripetal acceleration", "centripetal", centripetal, out);
  addPart("the tangential acceleration", "angular_acceleration", tangential, out, platform_group, false);
  const std::vector<Leg>& legs = out.machine.parameters().legs;
  if (std::any_of(legs.begin(), legs.end(), [](const Leg& leg) { return rowOf(leg.kind).isTelescopic(); })) {
    addPart("the Coriolis acceleration", "coriolis", coriolis, out, distal_group);
    addPart("half of the Coriolis acceleration", "coriolis", halfCoriolis, out, distal_group, false);
  }
  addPart("the moment of inertia", "inertia", turningInertia, out);
  addPart("the moment of angular acceleration", "inertia", acceleratedInertia, out);
  addPart("the force of inertia", "inertia", movingInertia, out);
  addPart("inertia", "inertia", inertia, out);
  // The wrong sign would be that of every effort.
  addPart("inertia and gravity", "inertia", everything, out, nullptr, false);
  addPart("the moment about P of gravity", "gravity", ofItsArm(gravity), out, platform_group, false);
  addPart("the moment about P of the force of inertia", "inertia", ofItsArm(movingInertia), out, platform_group, false);
  for (const Group* of : {links_group, proximal_group, distal_group}) {
    addPart("what velocities make of the accelerations", "coriolis", bias, out, of);
    addPart("what velocities make of the angular accelerations", "coriolis", turningBias, out, of);
    addPart("what velocities make of the mass centres' accelerations", "coriolis", movingBias, out, of);
    addPart("every term in velocities but friction", "coriolis", velocityTerms, out, of);
  }
  for (const Group& group : groups)
    if (!group.platform) addSpin(group, out);
  for (std::size_t leg = 0; leg < out.machine.parameters().legs.size(); ++leg)
    for (const Group& group : groups)
      if (!group.platform) addWeightOfLeg(leg, group, out);
  addTensors(out);
}

}  // namespace ursula

#include "validation/mistakes/tried_causes.h"

#include <fmt/format.h>

#include <string>
#include <tuple>
#include <utility>

#include "validation/subject/body_terms.h"

namespace ursula {
namespace {

using Wrench = std::function<Vector6d(const MachineTerms&, const BodyTerms&)>;

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

/// Σ Tᵀ w over the group.
Vector6d effortsOf(const MachineTerms& machine, const Group& group, const Wrench& wrench) {
  Vector6d out = Vector6d::Zero();
  const auto add = [&](const BodyTerms& body) { out += body.T.transpose() * wrench(machine, body); };
  if (group.proximal)
    for (const BodyTerms& body : machine.proximal) add(body);
  if (group.distal)
    for (const BodyTerms& body : machine.distal) add(body);
  if (group.platform) add(machine.platform);
  return out;
}

// The parts of a body's wrench.
Vector6d gravity(const MachineTerms& machine, const BodyTerms& body) { return -body.gravityWrench(machine.gravity); }
Vector6d gyroscopic(const MachineTerms& /*machine*/, const BodyTerms& body) {
  return momentWrench(body.omega().cross(body.inertia * body.omega()));
}
Vector6d turningInertia(const MachineTerms& machine, const BodyTerms& body) {
  return gyroscopic(machine, body) + momentWrench(body.inertia * body.twist_rate.head<3>());
}
Vector6d acceleratedInertia(const MachineTerms& /*machine*/, const BodyTerms& body) {
  return momentWrench(body.inertia * body.twist_rate.head<3>());
}
Vector6d movingInertia(const MachineTerms& /*machine*/, const BodyTerms& body) {
  return forceWrench(body.mass * body.twist_rate.tail<3>());
}
Vector6d inertia(const MachineTerms& /*machine*/, const BodyTerms& body) { return body.inertiaWrench(body.twist_rate); }
Vector6d everything(const MachineTerms& machine, const BodyTerms& body) {
  return inertia(machine, body) + gravity(machine, body);
}
Vector6d centripetal(const MachineTerms& /*machine*/, const BodyTerms& body) {
  return forceWrench(body.mass * body.omega().cross(body.omega().cross(body.from)));
}
Vector6d tangential(const MachineTerms& /*machine*/, const BodyTerms& body) {
  return forceWrench(body.mass * body.twist_rate.head<3>().cross(body.from));
}
Vector6d coriolis(const MachineTerms& /*machine*/, const BodyTerms& body) {
  return forceWrench(2 * body.mass * body.omega().cross(body.sliding));
}
Vector6d halfCoriolis(const MachineTerms& machine, const BodyTerms& body) { return coriolis(machine, body) / 2; }

/// The velocity-dependent part of a link's accelerations; its moment excludes the gyroscopic one.
Vector6d turningBias(const MachineTerms& /*machine*/, const BodyTerms& body) {
  return momentWrench(body.inertia * body.bias.head<3>());
}
Vector6d movingBias(const MachineTerms& /*machine*/, const BodyTerms& body) {
  return forceWrench(body.mass * body.bias.tail<3>());
}
Vector6d bias(const MachineTerms& machine, const BodyTerms& body) {
  return turningBias(machine, body) + movingBias(machine, body);
}
Vector6d velocityTerms(const MachineTerms& machine, const BodyTerms& body) {
  return bias(machine, body) + gyroscopic(machine, body);
}

/// The moment about the first joint, or P, of a part's force.
Wrench ofItsArm(const Wrench& part) {
  return [part](const MachineTerms& machine, const BodyTerms& body) {
    return momentWrench(body.from.cross(Vector3d(part(machine, body).tail<3>())));
  };
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

/// A tensor in B that a solver may mistake for the body's.
using Tensor = std::function<Matrix3d(const BodyTerms&)>;

/// The change of the moments with another tensor.
Wrench withTensor(const Tensor& tensor) {
  return [tensor](const MachineTerms& /*machine*/, const BodyTerms& body) {
    BodyTerms other = body;
    other.inertia = tensor(body);
    return Vector6d(other.inertiaWrench(body.twist_rate) - body.inertiaWrench(body.twist_rate));
  };
}

/// m (r² 1 − r rᵀ).
Matrix3d steiner(const BodyTerms& body) {
  return body.mass * (body.from.squaredNorm() * Matrix3d::Identity() - body.from * body.from.transpose());
}

class Collector : public EffortCauses {
 public:
  using EffortCauses::EffortCauses;

  /// Adds a part of the wrenches of each group, omitted, doubled or with the wrong sign.
  void addPart(const std::string& what, const char* term, const Wrench& part, const char* only = "",
               bool may_be_other = true) {
    for (const Group& group : groups) {
      if (*only != 0 && group.body != std::string(only)) continue;
      const auto times = [group, part](double factor) {
        return [group, part, factor](const MachineTerms& machine) {
          return Vector6d(factor * effortsOf(machine, group, part));
        };
      };
      add(what + " of " + group.words + " left out", {CauseKind::missing_term, term, group.body}, times(-1));
      if (!may_be_other) continue;
      add(what + " of " + group.words + " with the wrong sign", {CauseKind::sign, term, group.body}, times(-2));
      add(what + " of " + group.words + " doubled", {CauseKind::scale, term, group.body, "", "", 1, 2}, times(1));
    }
  }

  /// Adds the effect of another interpretation of each group's bodies.
  void addChange(const std::string& before, const std::string& after, CauseKind kind, const char* term,
                 const Wrench& change) {
    for (const Group& group : groups)
      add(before + group.words + after, {kind, term, group.body},
          [group, change](const MachineTerms& machine) { return effortsOf(machine, group, change); });
  }
};

/// Ways to leave out the spin: of motion and reaction, of the motion, or of ω and ω̇ without its effect on ω̇.
enum class Spinless { motion_and_reaction, motion, crudely };

Wrench withoutSpinOf(Spinless way) {
  return [way](const MachineTerms& /*machine*/, const BodyTerms& body) {
    BodyTerms still = withoutSpin(body);
    if (way == Spinless::crudely) {
      const double spin = body.line.dot(body.omega());
      still.twist_rate.head<3>() += spin * body.omega().cross(body.line);
      still.twist_rate.tail<3>() -= spin * body.line.dot(body.from) * still.omega();
    }
    Vector6d wrench = still.inertiaWrench(still.twist_rate);
    // Tᵀ without spin takes no moment about the line
    if (way == Spinless::motion_and_reaction) wrench = withoutSpin(body, wrench);
    return Vector6d(wrench - body.inertiaWrench(body.twist_rate));
  };
}

void addSpin(Collector& out) {
  const std::pair<Spinless, const char*> ways[] = {{Spinless::motion_and_reaction, ""},
                                                   {Spinless::motion, " of their motion"},
                                                   {Spinless::crudely, " of omega and its rate"}};
  for (const Group& group : groups) {
    if (group.platform) continue;
    for (const auto& [way, words] : ways)
      out.add(fmt::format("the spin of {} about their own lines left out{}", group.words, words),
              {CauseKind::missing_term, "spin", group.body}, [group, way = way](const MachineTerms& machine) {
                return effortsOf(machine, group, withoutSpinOf(way));
              });
  }
}

/// The weights of one leg's links.
void addWeightsOfLegs(int legs, Collector& out) {
  for (int i = 0; i < legs; ++i)
    for (const Group& group : groups) {
      if (group.platform) continue;
      NamedCause named{CauseKind::missing_term, "gravity", group.body};
      named.leg = i + 1;
      out.add(fmt::format("gravity of {} of leg {} left out", group.words, i + 1), named,
              [group, i](const MachineTerms& machine) {
                const auto weight = [&](const BodyTerms& body) {
                  return Vector6d(body.T.transpose() * body.gravityWrench(machine.gravity));
                };
                const auto k = static_cast<std::size_t>(i);
                Vector6d change = Vector6d::Zero();
                if (group.proximal) change += weight(machine.proximal[k]);
                if (group.distal) change += weight(machine.distal[k]);
                return change;
              });
    }
}

/// Such a body may be impossible, so no machine is built from it.
void addTensors(Collector& out) {
  out.addChange(
      "inertia of ", " not turned into the base's frame", CauseKind::frame, "inertia",
      withTensor([](const BodyTerms& body) -> Matrix3d { return body.R.transpose() * body.inertia * body.R; }));
  out.addChange("inertia of ", " turned the wrong way", CauseKind::frame, "inertia",
                withTensor([](const BodyTerms& body) -> Matrix3d {
                  const Matrix3d twice = body.R * body.R;
                  return twice.transpose() * body.inertia * twice;
                }));
  out.addChange("inertia of ", " turned on one side only", CauseKind::frame, "inertia",
                withTensor([](const BodyTerms& body) -> Matrix3d { return body.inertia * body.R; }));
  out.addChange("inertia of ", " about the first joint, or P, used as about the mass centre",
                CauseKind::reference_point, "inertia",
                withTensor([](const BodyTerms& body) -> Matrix3d { return body.inertia + steiner(body); }));
  out.addChange("inertia of ", ", about the mass centre, taken for such about the first joint, or P",
                CauseKind::reference_point, "inertia",
                withTensor([](const BodyTerms& body) -> Matrix3d { return body.inertia - steiner(body); }));
  for (const auto& [words, back] : {std::pair(" along its own axes", false), {" turned the wrong way", true}})
    out.addChange("gravity of ", words, CauseKind::frame, "gravity",
                  [back = back](const MachineTerms& machine, const BodyTerms& body) {
                    const Matrix3d R = back ? Matrix3d(body.R.transpose()) : body.R;
                    return Vector6d(body.gravityWrench(machine.gravity) - body.gravityWrench(R * machine.gravity));
                  });
  for (const auto& [words, times] : {std::pair("not turned into the base's frame", 1), {"turned the wrong way", 2}})
    out.add(fmt::format("the arm of the platform's weight {}", words), {CauseKind::frame, "gravity", "platform"},
            [times = times](const MachineTerms& machine) {
              Vector3d arm = machine.rho;
              for (int k = 0; k < times; ++k) arm = (machine.platform.R.transpose() * arm).eval();
              const Vector3d weight = gravity(machine, machine.platform).tail<3>();
              return Vector6d(machine.T_P.transpose() * momentWrench((arm - machine.rho).cross(weight)));
            });
  for (const Group& group : groups)
    if (!group.platform)
      out.add(fmt::format("weights of {} put at their first joints", group.words),
              {CauseKind::reference_point, "gravity", group.body},
              [group](const MachineTerms& machine) { return Vector6d(-effortsOf(machine, group, ofItsArm(gravity))); });
  const auto leftInOwnFrame = [](const Wrench& moment) {
    return [moment](const MachineTerms& machine, const BodyTerms& body) {
      const Vector3d n = moment(machine, body).head<3>();
      return momentWrench(body.R.transpose() * n - n);
    };
  };
  out.addChange("the gyroscopic moment of ", " left in its own frame", CauseKind::frame, "gyroscopic",
                leftInOwnFrame(gyroscopic));
  out.addChange("the moment of inertia of ", " left in its own frame", CauseKind::frame, "inertia",
                leftInOwnFrame(turningInertia));
  for (const auto& [what, term, part] : {std::tuple("the gyroscopic moment of ", "gyroscopic", &gyroscopic),
                                         {"the moment of angular acceleration of ", "inertia", &acceleratedInertia}})
    out.addChange(what, " with the tensor of its own frame", CauseKind::frame, term,
                  [part = part](const MachineTerms& machine, const BodyTerms& body) {
                    BodyTerms own = body;
                    own.inertia = body.R.transpose() * body.inertia * body.R;
                    return Vector6d(part(machine, own) - part(machine, body));
                  });
}

}  // namespace

std::vector<Cause> termCauses(const Scenario& scenario) {
  Collector out(scenario);
  for (const char* body : {"platform", "legs", "proximal", "distal"}) out.addPart("gravity", "gravity", gravity, body);
  out.addPart("the gyroscopic moment", "gyroscopic", gyroscopic);
  out.addPart("the centripetal acceleration", "centripetal", centripetal);
  out.addPart("the tangential acceleration", "angular_acceleration", tangential, "platform", false);
  out.addPart("the Coriolis acceleration", "coriolis", coriolis, "distal");
  out.addPart("half of the Coriolis acceleration", "coriolis", halfCoriolis, "distal", false);
  out.addPart("the moment of inertia", "inertia", turningInertia);
  out.addPart("the moment of angular acceleration", "inertia", acceleratedInertia);
  out.addPart("the force of inertia", "inertia", movingInertia);
  out.addPart("inertia", "inertia", inertia);
  out.addPart("inertia and gravity", "inertia", everything, "",
              false);  // the wrong sign would be that of every effort
  out.addPart("the moment about P of gravity", "gravity", ofItsArm(gravity), "platform", false);
  out.addPart("the moment about P of the force of inertia", "inertia", ofItsArm(movingInertia), "platform", false);
  for (const char* body : {"legs", "proximal", "distal"}) {
    out.addPart("what velocities make of the accelerations", "coriolis", bias, body);
    out.addPart("what velocities make of the angular accelerations", "coriolis", turningBias, body);
    out.addPart("what velocities make of the mass centres' accelerations", "coriolis", movingBias, body);
    out.addPart("every term in velocities but friction", "coriolis", velocityTerms, body);
  }
  addSpin(out);
  addWeightsOfLegs(scenario.manipulator->legCount(), out);
  addTensors(out);
  return std::move(out.causes);
}

}  // namespace ursula

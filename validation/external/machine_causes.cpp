#include "validation/external/machine_causes.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "validation/external/machine_slopes.h"
#include "validation/external/tied_parameters.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

using Machine = ManipulatorParameters;
using Rows = std::vector<Vector6d>;
using Change = std::function<void(Machine&, double)>;
using Words = std::function<std::string(double, double)>;
using Named = std::function<std::optional<NamedCause>(double, double)>;

Rows torquesOf(const Machine& machine, const Scenario& scenario, const std::vector<Motion<double>>& motions) {
  const Subject noc = nocSubject(Manipulator(machine), scenario.load);
  Rows out;
  out.reserve(motions.size());
  for (const Motion<double>& motion : motions) out.push_back(noc.torques(motion));
  return out;
}

/// Torques are linear in inertias: of a machine with round ones besides, so that also such can be tried that no body
/// can have. `change` alters inertias alone.
Rows torquesOfInertias(const Scenario& scenario, const Change& change, double x,
                       const std::vector<Motion<double>>& motions) {
  Machine round = scenario.manipulator->parameters();
  const auto add = [](Matrix3d& inertia) { inertia.diagonal().array() += 10 * inertia.cwiseAbs().maxCoeff(); };
  Rows out = torquesOf(round, scenario, motions);
  add(round.platform.inertia);
  for (Leg& leg : round.legs) {
    add(leg.proximal.inertia);
    add(leg.distal.inertia);
  }
  const Rows without = torquesOf(round, scenario, motions);
  change(round, x / 11);  // relative errors are of the largest moment, which is eleven times as large
  const Rows with = torquesOf(round, scenario, motions);
  for (std::size_t k = 0; k < out.size(); ++k) out[k] += with[k] - without[k];
  return out;
}

/// Collects causes; `scenario` outlives them.
class Collector {
 public:
  explicit Collector(const Scenario& scenario)
      : scenario_(scenario), slopes_(std::make_shared<MachineSlopes>(scenario)) {}

  void addFitted(const Change& change, const Words& words, const Named& named) {
    const Scenario& scenario = scenario_;
    causes.push_back({true,
                      [&scenario, change](double x, const std::vector<Motion<double>>& motions) {
                        Machine machine = scenario.manipulator->parameters();
                        change(machine, x);
                        return torquesOf(machine, scenario, motions);
                      },
                      words});
    causes.back().named = named;
    causes.back().slope = [slopes = slopes_, change](const std::vector<Motion<double>>& motions) {
      return slopes->along(change, motions);
    };
  }

  void addTied(const TiedParameters& tied) {
    const Machine& machine = scenario_.manipulator->parameters();
    const Change change = [tied](Machine& changed, double x) { tied.disturb(changed, x); };
    addFitted(
        change, [tied, machine](double x, double deviation) { return tied.text(machine, x, deviation); },
        [tied, machine](double x, double deviation) { return tied.named(machine, x, deviation); });
    if (tied.members.front().group != "inertia") return;
    const Scenario& scenario = scenario_;
    causes.back().torques = [&scenario, change](double x, const std::vector<Motion<double>>& motions) {
      return torquesOfInertias(scenario, change, x, motions);
    };
  }

  void addFixed(const CauseName& name, const std::function<void(Machine&)>& change) {
    const Scenario& scenario = scenario_;
    causes.push_back(fixedCause(name, [&scenario, change](const std::vector<Motion<double>>& motions) {
      Machine machine = scenario.manipulator->parameters();
      change(machine);
      return torquesOf(machine, scenario, motions);
    }));
  }

  /// A change of one link, for all links, the proximal ones, and the distal ones. `kind` and `term` name it.
  void addLinks(const std::string& before, const std::string& after, CauseKind kind, const char* term,
                const std::function<void(Link&)>& change) {
    const std::pair<const char*, const char*> links[] = {
        {"the proximal links", "proximal"}, {"the distal links", "distal"}, {"all links", "legs"}};
    for (const int which : {2, 0, 1})
      addFixed({before + links[which].first + after, NamedCause{kind, term, links[which].second}},
               [change, which](Machine& machine) {
                 for (Leg& leg : machine.legs) {
                   if (which != 1) change(leg.proximal);
                   if (which != 0) change(leg.distal);
                 }
               });
  }

  std::vector<Cause> causes;

 private:
  const Scenario& scenario_;
  std::shared_ptr<MachineSlopes> slopes_;
};

/// I of the mass centre with m (r² 1 − r rᵀ) added or taken away.
Matrix3d moved(const Matrix3d& inertia, double mass, const Vector3d& r, double sign) {
  return inertia + sign * mass * (r.squaredNorm() * Matrix3d::Identity() - r * r.transpose());
}

void addInertias(Collector& out) {
  const NamedCause platform_inertia{CauseKind::reference_point, "inertia", "platform"};
  const auto link = [](double sign, bool from_end) {
    return [sign, from_end](Link& one) {
      const double r = from_end ? one.length - one.center_of_mass : one.center_of_mass;
      one.inertia = moved(one.inertia, one.mass, Vector3d(0, 0, r), sign);
    };
  };
  out.addLinks("inertias of ", " about the first joint used as about the mass centre", CauseKind::reference_point,
               "inertia", link(1, false));
  out.addLinks("inertias of ", ", about the mass centre, taken for such about the first joint",
               CauseKind::reference_point, "inertia", link(-1, false));
  out.addFixed({"inertia of the platform about P used as about its mass centre", platform_inertia},
               [](Machine& machine) {
                 Platform& one = machine.platform;
                 one.inertia = moved(one.inertia, one.mass, one.center_of_mass, 1);
               });
  out.addFixed({"inertia of the platform, about its mass centre, taken for such about P", platform_inertia},
               [](Machine& machine) {
                 Platform& one = machine.platform;
                 one.inertia = moved(one.inertia, one.mass, one.center_of_mass, -1);
               });
  out.addLinks("inertias of ", " with x and y exchanged", CauseKind::frame, "inertia", [](Link& one) {
    one.inertia.row(0).swap(one.inertia.row(1));
    one.inertia.col(0).swap(one.inertia.col(1));
  });
  out.addLinks("inertias of ", " with x and z exchanged", CauseKind::frame, "inertia", [](Link& one) {
    one.inertia.row(0).swap(one.inertia.row(2));
    one.inertia.col(0).swap(one.inertia.col(2));
  });
  out.addLinks("inertias of ", " without products of inertia", CauseKind::missing_term, "inertia",
               [](Link& one) { one.inertia = one.inertia.diagonal().asDiagonal().toDenseMatrix(); });
  out.addLinks("products of inertia of ", " with the wrong sign", CauseKind::sign, "inertia",
               [](Link& one) { one.inertia = 2 * one.inertia.diagonal().asDiagonal().toDenseMatrix() - one.inertia; });
}

/// One link alone.
void addOtherEnds(int legs, Collector& out) {
  for (int i = 0; i < legs; ++i)
    for (const auto& [name, link] : {std::pair("proximal", &Leg::proximal), std::pair("distal", &Leg::distal)}) {
      NamedCause named{CauseKind::reference_point, "", name};
      named.leg = i + 1;
      out.addFixed(
          {fmt::format("mass centre of the {} link of leg {} measured from the other end", name, i + 1), named},
          [i, link = link](Machine& machine) {
            Link& one = machine.legs[static_cast<std::size_t>(i)].*link;
            one.center_of_mass = one.length - one.center_of_mass;
          });
    }
}

void addExchanged(Collector& out) {
  const NamedCause platform_centre{CauseKind::reference_point, "", "platform"};
  out.addLinks("mass centres of ", " measured from the other end", CauseKind::reference_point, "",
               [](Link& one) { one.center_of_mass = one.length - one.center_of_mass; });
  out.addLinks("mass centres of ", " taken at the middle", CauseKind::reference_point, "",
               [](Link& one) { one.center_of_mass = one.length / 2; });
  out.addLinks("mass centres of ", " at their first joints", CauseKind::reference_point, "",
               [](Link& one) { one.center_of_mass = 0; });
  out.addFixed({"mass centre of the platform taken at P", platform_centre},
               [](Machine& machine) { machine.platform.center_of_mass.setZero(); });
  out.addFixed({"mass centre of the platform on the other side of P", platform_centre},
               [](Machine& machine) { machine.platform.center_of_mass *= -1; });
  out.addFixed({"proximal and distal links exchanged, but for their lengths"}, [](Machine& machine) {
    for (Leg& leg : machine.legs) {
      std::swap(leg.proximal, leg.distal);
      std::swap(leg.proximal.length, leg.distal.length);
    }
  });
  out.addFixed({"proximal and distal inertias exchanged"}, [](Machine& machine) {
    for (Leg& leg : machine.legs) std::swap(leg.proximal.inertia, leg.distal.inertia);
  });
  out.addFixed({"base axes without their part along z"}, [](Machine& machine) {
    for (Leg& leg : machine.legs) leg.base_axis.z() = 0;
  });
  out.addFixed({"base axes with the wrong sign of z"}, [](Machine& machine) {
    for (Leg& leg : machine.legs) leg.base_axis.z() *= -1;
  });
}

/// Legs of which `knee` says something.
std::vector<std::size_t> bentLegs(const Manipulator& machine) {
  std::vector<std::size_t> out;
  for (int i = 0; i < machine.legCount(); ++i)
    if (rowOf(machine.leg(i).kind).knee != nullptr) out.push_back(static_cast<std::size_t>(i));
  return out;
}

void addKnees(const Manipulator& machine, Collector& out) {
  const std::vector<std::size_t> bent = bentLegs(machine);
  const int all = static_cast<int>(bent.size());
  for (int legs = 1; legs < 1 << all; ++legs) {
    std::string names;
    int count = 0;
    for (int i = 0; i < all; ++i)
      if (legs >> i & 1) names += fmt::format("{}{}", count++ == 0 ? "" : ", ", bent[static_cast<std::size_t>(i)] + 1);
    NamedCause named{CauseKind::parameter, "", "legs"};
    if (count == 1) {
      named.leg = std::stoi(names);
      named.parameter = "manipulator.leg." + names + ".knee";
    } else if (count == machine.legCount()) {
      named.parameter = "manipulator.leg_defaults.knee";
    }
    out.addFixed({count == machine.legCount() ? std::string("the other knee on every leg")
                                              : fmt::format("the other knee on leg{} {}", count == 1 ? "" : "s", names),
                  named},
                 [legs, bent](Machine& changed) {
                   for (std::size_t i = 0; i < bent.size(); ++i) {
                     Knee& knee = changed.legs[bent[i]].knee;
                     if (legs >> i & 1) knee = knee == Knee::positive ? Knee::negative : Knee::positive;
                   }
                 });
  }
}

/// `expected` and `found` are what is beyond the scenario's.
NamedCause moreFriction(const std::string& key, const char* unit, double x, double deviation) {
  NamedCause out{CauseKind::parameter, "friction", "legs", "manipulator.leg_defaults." + key, unit, 0, x, deviation};
  return out;
}

bool anyLegHas(const Manipulator& machine, Coordinate coordinate) {
  const std::vector<Leg>& legs = machine.parameters().legs;
  return std::any_of(legs.begin(), legs.end(), [coordinate](const Leg& leg) {
    const auto& has = rowOf(leg.kind).coordinates;
    return std::find(has.begin(), has.end(), coordinate) != has.end();
  });
}

/// Friction that the scenario does not have: a fit of its coefficients, of every leg that has the coordinate.
void addFriction(const Manipulator& machine, Collector& out) {
  for (const Coordinate coordinate : {Coordinate::phi, Coordinate::psi, Coordinate::theta, Coordinate::d}) {
    if (!anyLegHas(machine, coordinate)) continue;
    const std::string joint = nameOf(coordinate);
    const char* const viscous = slides(coordinate) ? "N s/m" : "N m s/rad";
    const char* const coulomb = slides(coordinate) ? "N" : "N m";
    out.addFitted(
        [coordinate](Machine& changed, double x) {
          for (Leg& leg : changed.legs) leg.friction.on(coordinate) += x;
        },
        [joint, viscous](double x, double deviation) {
          return fmt::format("viscous friction on every {} of {} {} more than the scenario's", joint,
                             withDeviation(x, deviation), viscous);
        },
        [joint, viscous](double x, double deviation) {
          return moreFriction("friction." + joint, viscous, x, deviation);
        });
    out.addFitted(
        [coordinate](Machine& changed, double x) {
          for (Leg& leg : changed.legs) leg.coulomb.on(coordinate) += x;
        },
        [joint, coulomb](double x, double deviation) {
          return fmt::format("Coulomb friction on every {} of {} {} more than the scenario's", joint,
                             withDeviation(x, deviation), coulomb);
        },
        [joint, coulomb](double x, double deviation) {
          return moreFriction("coulomb." + joint, coulomb, x, deviation);
        });
  }
  const NamedCause sharp{CauseKind::parameter, "friction", "legs", "manipulator.leg_defaults.coulomb.smoothing_speed"};
  out.addFixed({"Coulomb friction without smoothing", sharp}, [](Machine& changed) {
    constexpr double sharp_speed = 1e-200;  // every speed is far beyond it
    for (Leg& leg : changed.legs) leg.coulomb.smoothing_speed = leg.coulomb.sliding_speed = sharp_speed;
  });
}

/// Parts of the friction that the scenario has.
void addFrictionLeftOut(Collector& out) {
  const NamedCause named{CauseKind::missing_term, "friction", "all"};
  const auto clear = [](JointFriction& law, const Leg& leg, bool driven, bool passive) {
    for (std::size_t j = 0; j < 3; ++j)
      if (leg.actuated[j] ? driven : passive) law.on(rowOf(leg.kind).coordinates[j]) = 0;
  };
  const auto add = [&](const char* text, bool viscous, bool coulomb, bool driven, bool passive) {
    out.addFixed({text, named}, [=](Machine& machine) {
      for (Leg& leg : machine.legs) {
        if (viscous) clear(leg.friction, leg, driven, passive);
        if (coulomb) clear(leg.coulomb, leg, driven, passive);
      }
    });
  };
  add("viscous friction left out", true, false, true, true);
  add("Coulomb friction left out", false, true, true, true);
  add("friction of the joints without motors left out", true, true, false, true);
  add("friction of the driven joints left out", true, true, true, false);
}

void addPlatform(Collector& out) {
  out.addFitted([](Machine& machine, double x) { machine.platform.inertia *= 1 + x; },
                [](double x, double deviation) {
                  return fmt::format("platform inertia tensor scaled by {}", withDeviation(1 + x, deviation));
                },
                [](double x, double deviation) {
                  return NamedCause{CauseKind::scale, "inertia", "platform", "", "", 1, 1 + x, deviation};
                });
  out.addFitted(
      [](Machine& machine, double x) {  // in units of the platform's mass
        Platform& one = machine.platform;
        const Vector3d before = one.center_of_mass, after = before / (1 + x), to_load = after, to_old = before - after;
        one.inertia = moved(moved(one.inertia, one.mass, to_old, 1), x * one.mass, to_load, 1);
        one.mass *= 1 + x;
        one.center_of_mass = after;
      },
      [](double x, double deviation) {
        return fmt::format("a point mass at P of {} times the platform's mass", withDeviation(x, deviation));
      },
      [](double, double) {
        return NamedCause{CauseKind::parameter, "", "platform"};
      });
}

}  // namespace

std::vector<Cause> machineCauses(const Scenario& scenario) {
  Collector out(scenario);
  addPlatform(out);
  for (const TiedParameters& tied : tiedParameters(*scenario.manipulator)) out.addTied(tied);
  addInertias(out);
  addExchanged(out);
  addOtherEnds(scenario.manipulator->legCount(), out);
  addKnees(*scenario.manipulator, out);
  addFriction(*scenario.manipulator, out);
  addFrictionLeftOut(out);
  return std::move(out.causes);
}

}  // namespace ursula

#include "parts/causes/tried_causes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "nocsolver/errors.h"
#include "parts/causes/machine_slopes.h"
#include "parts/causes/tied_parameters.h"
#include "validation/limits/conditioning.h"

namespace ursula {
namespace {

using Machine = ManipulatorParameters;

/// Further digits are not printed, relative to the number.
constexpr double most_digits = 1e-9;

Subject nocOf(const Machine& machine, const Scenario& scenario) {
  return nocSubject(withoutStroke(Manipulator(machine)), scenario.load);
}

/// Torques are linear in inertias. Adding a machine with round inertias allows tests of tensors that no body can have.
/// `change` alters inertias only.
EffortsOf effortsOfInertias(const Scenario& scenario, const std::function<void(Machine&, double)>& change, double x) {
  Machine round = scenario.manipulator->parameters();
  const auto add = [](Matrix3d& inertia) { inertia.diagonal().array() += 10 * inertia.cwiseAbs().maxCoeff(); };
  const EffortsOf right = nocOf(round, scenario).torques;
  add(round.platform.inertia);
  for (Leg& leg : round.legs) {
    add(leg.proximal.inertia);
    add(leg.distal.inertia);
  }
  const EffortsOf without = nocOf(round, scenario).torques;
  change(round, x / 11);  // relative errors refer to the largest moment, which is eleven times as large
  return [right, without, with = nocOf(round, scenario).torques](const Motion<double>& motion) {
    return Vector6d(right(motion) + (with(motion) - without(motion)));
  };
}

double roundingOfMachine(const Manipulator& machine, const Scenario& scenario, const Motion<double>& motion) {
  return ConditioningProbe(machine, scenario.load).at(motion).torqueRounding();
}

/// All legs, without numbers. If there are several kinds, also " of the URS legs" with their numbers.
std::map<std::string, std::vector<int>> kindsOf(const Manipulator& machine) {
  std::map<std::string, std::vector<int>> out;
  for (int i = 0; i < machine.legCount(); ++i)
    out[std::string(" of the ") + rowOf(machine.leg(i).kind).name + " legs"].push_back(i + 1);
  if (out.size() < 2) out.clear();
  out[""] = {};
  return out;
}

/// Right efforts with those of a mistake of a solver that knows `known` of the machine.
std::function<EffortsOf(const Scenario&)> withChange(
    const TriedCauses::EffortChange& change,
    const std::function<std::shared_ptr<const Manipulator>(const Scenario&)>& known) {
  return [change, known](const Scenario& scenario) {
    const Subject noc = nocSubject(*scenario.manipulator, scenario.load);
    return [load = scenario.load, change, machine = known(scenario), noc](const Motion<double>& motion) {
      return Vector6d(noc.torques(motion) + change(machineTerms(*machine, load, motion)));
    };
  };
}

/// Without friction and rotors of the motors; `had` is whether there are any.
Machine withoutMotors(const Manipulator& machine, bool& had) {
  Machine out = machine.parameters();
  had = false;
  for (const Motor& motor : machine.motors()) {
    Leg& leg = out.legs[motor.leg];
    for (double* number : {&leg.friction.on(motor.coordinate), &leg.coulomb.on(motor.coordinate),
                           &leg.rotor_inertia.on(motor.coordinate)})
      had = std::exchange(*number, 0) > 0 || had;
  }
  return out;
}

}  // namespace

std::vector<Vector6d> Cause::torques(double x, const std::vector<Motion<double>>& motions) const {
  const EffortsOf efforts = solver(*scenario, x);
  std::vector<Vector6d> out;
  for (const Motion<double>& motion : motions) out.push_back(efforts(motion));
  return out;
}

std::string withDeviation(double value, double deviation, double scale) {
  const double size = std::abs(value);
  if (size == 0 || (size <= deviation && deviation <= most_digits * scale)) return "0";
  if (deviation == 0) return fmt::format("{:.9g}", value);
  if (!(deviation > most_digits * size && std::isfinite(deviation)))
    return fmt::format("{:.9g} +- {:.1g}", value, deviation);
  const int place = static_cast<int>(std::floor(std::log10(deviation)));
  return fmt::format("{:.{}f} +- {:.1g}", value, std::clamp(-place, 0, 15), deviation);
}

Manipulator withoutStroke(const Manipulator& machine) {
  ManipulatorParameters out = machine.parameters();
  for (Leg& leg : out.legs) {
    if (leg.kind != LegKind::UPS) continue;
    const double whole = leg.proximal.length + leg.distal.length, shorter = 0.999 * leg.distal.length;
    leg.proximal.length = 10 * whole;
    leg.distal.length -= shorter;
    leg.distal.center_of_mass -= shorter;  // at the same place
  }
  return Manipulator(out);
}

void addEveryCause(TriedCauses& out) {
  for (const auto add : {addMachineCauses, addMotionCauses, addTermCauses, addJointCauses, addSlidingCauses,
                         addJacobianCauses, addLoopCauses})
    add(out);
}

std::vector<Cause> causesOf(const Scenario& scenario, void (*group)(TriedCauses&)) {
  TriedCauses out{scenario};
  group(out);
  return std::move(out.causes);
}

Cause& TriedCauses::push(const Cause& cause) {
  causes.push_back(cause);
  causes.back().scenario = &scenario;
  return causes.back();
}

Cause& TriedCauses::add(const CauseName& name, const std::function<EffortsOf(const Scenario&)>& solver) {
  Cause& out = push({false, [solver](const Scenario& of, double) { return solver(of); },
                     [text = name.text](double, double) { return text; }});
  if (name.named) out.named = [named = name.named](double, double) { return named; };
  return out;
}

Cause& TriedCauses::addReading(const CauseName& name, const std::function<void(Motion<double>&)>& change) {
  Cause& out = add(name, [change](const Scenario& of) {
    const Subject noc = nocOf(of.manipulator->parameters(), of);
    return [noc, change](Motion<double> motion) {
      change(motion);
      return noc.torques(motion);
    };
  });
  out.reading = [change](Motion<double>& motion, double) { change(motion); };
  out.rounding = [&scenario = scenario, change](Motion<double> motion) {
    change(motion);
    return roundingOfMachine(withoutStroke(*scenario.manipulator), scenario, motion);
  };
  return out;
}

void TriedCauses::addNotTurned(const CauseName& name, const std::function<void(Machine&, const Matrix3d& Q)>& change) {
  add(name, [change](const Scenario& of) {
    return [of, change](const Motion<double>& motion) {
      Machine changed = of.manipulator->parameters();
      change(changed, motion.Q);
      return nocOf(changed, of).torques(motion);
    };
  });
}

void TriedCauses::addMachine(const CauseName& name, const std::function<void(Machine&)>& change, double times) {
  const auto changed = [change](const Scenario& of) {
    Machine out = of.manipulator->parameters();
    change(out);
    return out;
  };
  Cause& cause = add(name, [changed, times](const Scenario& of) {
    const EffortsOf wrong = nocOf(changed(of), of).torques;
    if (times == 1) return wrong;
    return EffortsOf(
        [times, wrong, right = nocOf(of.manipulator->parameters(), of).torques](const Motion<double>& motion) {
          const Vector6d efforts = right(motion);
          return Vector6d(efforts + times * (wrong(motion) - efforts));
        });
  });
  if (times == 1) cause.machine = [change](Machine& wrong, double) { change(wrong); };
  cause.rounding = [&scenario = scenario, changed](const Motion<double>& motion) {
    const Manipulator other(changed(scenario));
    try {  // its own numbers round less than those without strokes
      return roundingOfMachine(other, scenario, motion);
    } catch (const PoseError&) {
      return roundingOfMachine(withoutStroke(other), scenario, motion);
    }
  };
}

void TriedCauses::addLinks(const std::string& before, const std::string& after, CauseKind kind, const char* term,
                           const std::function<void(Link&)>& change) {
  const std::pair<const char*, const char*> links[] = {
      {"the proximal links", "proximal"}, {"the distal links", "distal"}, {"all links", "legs"}};
  for (const auto& [of, legs] : kindsOf(machine))
    for (const int which : {2, 0, 1}) {
      NamedCause named{kind, term, links[which].second};
      named.legs = legs;
      addMachine({before + links[which].first + of + after, named}, [change, which, legs = legs](Machine& changed) {
        for (std::size_t i = 0; i < changed.legs.size(); ++i) {
          if (!legs.empty() && std::find(legs.begin(), legs.end(), static_cast<int>(i) + 1) == legs.end()) continue;
          if (which != 1) change(changed.legs[i].proximal);
          if (which != 0) change(changed.legs[i].distal);
        }
      });
    }
}

Cause& TriedCauses::addFitted(const std::function<void(Machine&, double)>& change, const Cause::Words& words,
                              const Cause::Named& named) {
  if (!slopes) slopes = std::make_shared<MachineSlopes>(scenario);
  const auto solver = [change](const Scenario& of, double x) {
    Machine changed = of.manipulator->parameters();
    change(changed, x);
    return nocOf(changed, of).torques;
  };
  const auto slope = [slopes = slopes, change](const std::vector<Motion<double>>& motions) {
    return slopes->along(change, motions);
  };
  Cause& out = push({true, solver, words, named, slope});
  out.machine = change;
  return out;
}

void TriedCauses::addTied(const TiedParameters& tied) {
  const Machine& right = machine.parameters();
  const auto change = [tied](Machine& changed, double x) { tied.disturb(changed, x); };
  Cause& cause = addFitted(
      change, [tied, &right](double x, double deviation) { return tied.text(right, x, deviation); },
      [tied, &right](double x, double deviation) { return tied.named(right, x, deviation); });
  cause.is_possible = [tied, &right](double x) { return tied.isPossible(right, x); };
  const Parameter& first = tied.members.front();
  if (tied.members.size() == 1 && first.entries == 3 && first.get(right) != 0)  // the wrong sign is far from the right
    cause.starts.push_back(-2 * first.get(right) / first.size(right));
  if (first.group() == NumberGroup::inertia)
    cause.solver = [change](const Scenario& of, double x) { return effortsOfInertias(of, change, x); };
}

void TriedCauses::addEfforts(const CauseName& name, const EffortChange& change) {
  add(name, withChange(change, [](const Scenario& of) { return of.manipulator; }));
}

void TriedCauses::addAlsoWithoutMotors(const std::string& text, const NamedCause& named, const EffortChange& change) {
  addEfforts({text, named}, change);
  bool had = false;
  static_cast<void>(withoutMotors(machine, had));
  if (had)
    add({text + ", before the motors' own friction and rotors were added", named},
        withChange(change, [](const Scenario& of) {
          bool any = false;
          return std::make_shared<const Manipulator>(withoutMotors(*of.manipulator, any));
        }));
}

}  // namespace ursula

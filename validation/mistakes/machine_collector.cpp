#include "validation/mistakes/machine_collector.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "nocsolver/errors.h"
#include "validation/limits/conditioning.h"
#include "validation/mistakes/machine_slopes.h"
#include "validation/mistakes/tied_parameters.h"
#include "validation/mistakes/tried_causes.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

using Machine = ManipulatorParameters;
using Rows = std::vector<Vector6d>;
using Change = MachineCauses::Change;

Rows torquesOf(const Machine& machine, const Scenario& scenario, const std::vector<Motion<double>>& motions) {
  const Subject noc = nocSubject(withoutStroke(Manipulator(machine)), scenario.load);
  Rows out;
  out.reserve(motions.size());
  for (const Motion<double>& motion : motions) out.push_back(noc.torques(motion));
  return out;
}

/// Torques are linear in inertias. Adding a machine with round inertias allows tests of tensors that no body can have.
/// `change` alters inertias only.
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
  change(round, x / 11);  // relative errors refer to the largest moment, which is eleven times as large
  const Rows with = torquesOf(round, scenario, motions);
  for (std::size_t k = 0; k < out.size(); ++k) out[k] += with[k] - without[k];
  return out;
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

}  // namespace

MachineCauses::MachineCauses(const Scenario& scenario)
    : scenario_(scenario), slopes_(std::make_shared<MachineSlopes>(scenario)) {}

void MachineCauses::addFitted(const Change& change, const Words& words, const Named& named) {
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

void MachineCauses::addTied(const TiedParameters& tied) {
  const Machine& machine = scenario_.manipulator->parameters();
  const Change change = [tied](Machine& changed, double x) { tied.disturb(changed, x); };
  addFitted(
      change, [tied, machine](double x, double deviation) { return tied.text(machine, x, deviation); },
      [tied, machine](double x, double deviation) { return tied.named(machine, x, deviation); });
  causes.back().is_possible = [tied, machine](double x) { return tied.isPossible(machine, x); };
  const Parameter& first = tied.members.front();
  if (tied.members.size() == 1 && first.entries == 3 &&
      first.get(machine) != 0)  // the wrong sign is far from the right
    causes.back().starts.push_back(-2 * first.get(machine) / first.size(machine));
  if (first.group != "inertia") return;
  const Scenario& scenario = scenario_;
  causes.back().torques = [&scenario, change](double x, const std::vector<Motion<double>>& motions) {
    return torquesOfInertias(scenario, change, x, motions);
  };
}

void MachineCauses::addFixed(const CauseName& name, const std::function<void(Machine&)>& change, double times) {
  const Scenario& scenario = scenario_;
  causes.push_back(fixedCause(name, [&scenario, change, times](const std::vector<Motion<double>>& motions) {
    Machine machine = scenario.manipulator->parameters();
    change(machine);
    Rows out = torquesOf(machine, scenario, motions);
    if (times == 1) return out;
    const Rows right = torquesOf(scenario.manipulator->parameters(), scenario, motions);
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = right[k] + times * (out[k] - right[k]);
    return out;
  }));
  causes.back().rounding = [&scenario, change](const Motion<double>& motion) {
    Machine machine = scenario.manipulator->parameters();
    change(machine);
    try {  // its own numbers round less than those without strokes
      return ConditioningProbe(Manipulator(machine), scenario.load).at(motion).torqueRounding();
    } catch (const PoseError&) {
      return ConditioningProbe(withoutStroke(Manipulator(machine)), scenario.load).at(motion).torqueRounding();
    }
  };
}

void MachineCauses::addLinks(const std::string& before, const std::string& after, CauseKind kind, const char* term,
                             const std::function<void(Link&)>& change) {
  const std::pair<const char*, const char*> links[] = {
      {"the proximal links", "proximal"}, {"the distal links", "distal"}, {"all links", "legs"}};
  for (const auto& [of, legs] : kindsOf(*scenario_.manipulator))
    for (const int which : {2, 0, 1}) {
      NamedCause named{kind, term, links[which].second};
      named.legs = legs;
      addFixed({before + links[which].first + of + after, named}, [change, which, legs = legs](Machine& machine) {
        for (std::size_t i = 0; i < machine.legs.size(); ++i) {
          if (!legs.empty() && std::find(legs.begin(), legs.end(), static_cast<int>(i) + 1) == legs.end()) continue;
          if (which != 1) change(machine.legs[i].proximal);
          if (which != 0) change(machine.legs[i].distal);
        }
      });
    }
}

void EffortCauses::add(const std::string& text, const NamedCause& named, const EffortChange& change,
                       const std::shared_ptr<const Manipulator>& changed) {
  const Scenario& scenario = scenario_;
  causes.push_back(fixedCause({text, named}, [&scenario, change, changed](const std::vector<Motion<double>>& motions) {
    const Subject noc = nocSubject(*scenario.manipulator, scenario.load);
    std::vector<Vector6d> out;
    for (const Motion<double>& motion : motions)
      out.push_back(noc.torques(motion) + change(machineTerms(*changed, scenario.load, motion)));
    return out;
  }));
}

void EffortCauses::addAlsoWithoutMotors(const std::string& text, const NamedCause& named, const EffortChange& change) {
  add(text, named, change);
  ManipulatorParameters machine = scenario_.manipulator->parameters();
  double motors = 0;
  for (const Motor& motor : scenario_.manipulator->motors()) {
    Leg& leg = machine.legs[static_cast<std::size_t>(motor.leg)];
    for (double* number : {&leg.friction.on(motor.coordinate), &leg.coulomb.on(motor.coordinate),
                           &leg.rotor_inertia.on(motor.coordinate)})
      motors += std::exchange(*number, 0);
  }
  if (motors > 0)
    add(text + ", before the motors' own friction and rotors were added", named, change,
        std::make_shared<const Manipulator>(machine));
}

}  // namespace ursula

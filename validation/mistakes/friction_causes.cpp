#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "validation/mistakes/machine_collector.h"

namespace ursula {
namespace {

using Machine = ManipulatorParameters;

/// `expected` and `found` are the excess over the scenario's.
NamedCause moreFriction(const std::string& key, const char* unit, double x, double deviation) {
  NamedCause out{CauseKind::parameter, "friction", "legs", "manipulator.leg_defaults." + key, unit, 0, x, deviation};
  return out;
}

/// The coefficients of one law on the legs that have the coordinate.
std::vector<double> coefficients(const Manipulator& machine, Coordinate coordinate, JointFriction& (*law)(Leg&)) {
  std::vector<double> out;
  for (Leg leg : machine.parameters().legs) {
    const auto& has = rowOf(leg.kind).coordinates;
    if (std::find(has.begin(), has.end(), coordinate) != has.end()) out.push_back(law(leg).on(coordinate));
  }
  return out;
}

/// Fits the coefficients of one law, `key`, on every leg that has the coordinate. If all are one number of the machine,
/// machine_collector.cpp fits it.
void addMore(const Manipulator& machine, const char* words, const std::string& key, const char* unit,
             Coordinate coordinate, JointFriction& (*law)(Leg&), MachineCauses& out) {
  const std::vector<double> given = coefficients(machine, coordinate, law);
  const auto is_first = [&given](double each) { return each == given.front(); };
  if (given.empty() || (given.front() != 0 && std::all_of(given.begin(), given.end(), is_first))) return;
  const std::string joint = nameOf(coordinate);
  out.addFitted(
      [coordinate, law](Machine& changed, double x) {
        for (Leg& leg : changed.legs) law(leg).on(coordinate) += x;
      },
      [words, joint, unit](double x, double deviation) {
        return fmt::format("{} friction on every {} of {} {} more than the scenario's", words, joint,
                           withDeviation(x, deviation), unit);
      },
      [key, joint, unit](double x, double deviation) { return moreFriction(key + "." + joint, unit, x, deviation); });
}

/// Friction that the scenario lacks.
void addFriction(const Manipulator& machine, MachineCauses& out) {
  for (const Coordinate coordinate : {Coordinate::phi, Coordinate::psi, Coordinate::theta, Coordinate::d}) {
    addMore(
        machine, "viscous", "friction", slides(coordinate) ? "N s/m" : "N m s/rad", coordinate,
        [](Leg& leg) -> JointFriction& { return leg.friction; }, out);
    addMore(
        machine, "Coulomb", "coulomb", slides(coordinate) ? "N" : "N m", coordinate,
        [](Leg& leg) -> JointFriction& { return leg.coulomb; }, out);
  }
  const NamedCause speed{CauseKind::parameter, "friction", "legs", "manipulator.leg_defaults.coulomb.smoothing_speed"};
  const auto has = [&machine](auto&& one) {
    return std::any_of(machine.parameters().legs.begin(), machine.parameters().legs.end(), one);
  };
  // Of angles or of d alone, it is one number, which machine_collector.cpp fits.
  if (has([](const Leg& leg) { return leg.coulomb.d != 0; }) &&
      has([](const Leg& leg) { return leg.coulomb.phi != 0 || leg.coulomb.psi != 0 || leg.coulomb.theta != 0; }))
    out.addFitted(
        [](Machine& changed, double x) {
          for (Leg& leg : changed.legs)
            for (double* each : {&leg.coulomb.smoothing_speed, &leg.coulomb.sliding_speed}) *each *= std::exp(x);
        },
        [](double x, double deviation) {
          return fmt::format("the smoothing speed of Coulomb friction, on angles and on d, times {}",
                             withDeviation(std::exp(x), deviation * std::exp(x)));
        },
        [speed](double, double) { return speed; });
  out.addFixed({"Coulomb friction without smoothing", speed}, [](Machine& changed) {
    constexpr double sharp_speed = 1e-200;  // every speed is far above it
    for (Leg& leg : changed.legs) leg.coulomb.smoothing_speed = leg.coulomb.sliding_speed = sharp_speed;
  });
}

/// The laws with their keys.
const std::pair<const char*, const JointFriction& (*)(const Leg&)> laws[] = {
    {"friction", [](const Leg& leg) -> const JointFriction& { return leg.friction; }},
    {"coulomb", [](const Leg& leg) -> const JointFriction& { return leg.coulomb; }}};

/// A choice of a leg's joints.
enum class Joints { all, driven, passive };

void clear(JointFriction& law, const Leg& leg, Joints which) {
  for (std::size_t j = 0; j < 3; ++j)
    if (which == Joints::all || leg.actuated[j] == (which == Joints::driven))
      law.on(rowOf(leg.kind).coordinates[j]) = 0;
}

bool rubs(const Machine& machine, bool viscous, bool coulomb, Joints but_for) {
  return std::any_of(machine.legs.begin(), machine.legs.end(), [&](Leg leg) {
    clear(leg.friction, leg, but_for);
    clear(leg.coulomb, leg, but_for);
    return (viscous && leg.friction.any()) || (coulomb && leg.coulomb.any());
  });
}

/// The start of the paths of all coefficients that `change` clears.
std::string pathOfCleared(const Machine& machine, const std::function<void(Machine&)>& change) {
  Machine cleared = machine;
  change(cleared);
  std::string shared;
  for (std::size_t i = 0; i < machine.legs.size(); ++i)
    for (const Coordinate coordinate : rowOf(machine.legs[i].kind).coordinates)
      for (const auto& [key, law] : laws) {
        if (law(machine.legs[i]).on(coordinate) == law(cleared.legs[i]).on(coordinate)) continue;
        const std::string path = fmt::format("manipulator.leg_defaults.{}.{}", key, nameOf(coordinate));
        if (shared.empty()) shared = path;
        while ((path + ".").rfind(shared + ".", 0) != 0) shared.erase(shared.rfind('.'));
      }
  return shared;
}

/// Omits parts of the scenario's friction if it has others too, or turns their sign; all of it is a term of its own.
void addPartsOfFriction(const Machine& machine, MachineCauses& out) {
  const auto add = [&](const std::string& text, const std::function<void(Machine&)>& change) {
    const std::string path = pathOfCleared(machine, change);
    if (path.empty()) return;
    for (const auto& [way, kind, times] :
         {std::tuple(" left out", CauseKind::missing_term, 1.0), {" with the wrong sign", CauseKind::sign, 2.0}})
      out.addFixed({text + way, NamedCause{kind, "friction", "all", path}}, change, times);
  };
  const auto addLaws = [&](const char* text, bool viscous, bool coulomb, Joints which) {
    add(text, [=](Machine& changed) {
      for (Leg& leg : changed.legs) {
        if (viscous) clear(leg.friction, leg, which);
        if (coulomb) clear(leg.coulomb, leg, which);
      }
    });
  };
  const auto any = [&](bool viscous, bool coulomb) {
    return rubs(machine, viscous, coulomb, Joints::driven) || rubs(machine, viscous, coulomb, Joints::passive);
  };
  if (any(true, false) && any(false, true)) {
    addLaws("viscous friction", true, false, Joints::all);
    addLaws("Coulomb friction", false, true, Joints::all);
  }
  if (rubs(machine, true, true, Joints::driven) && rubs(machine, true, true, Joints::passive)) {
    addLaws("friction of the joints without motors", true, true, Joints::passive);
    addLaws("friction of the driven joints", true, true, Joints::driven);
  }
  for (const Coordinate coordinate : {Coordinate::phi, Coordinate::psi, Coordinate::theta, Coordinate::d})
    add(fmt::format("friction on every {}", nameOf(coordinate)), [coordinate](Machine& changed) {
      for (Leg& leg : changed.legs) leg.friction.on(coordinate) = leg.coulomb.on(coordinate) = 0;
    });
}

}  // namespace

void addFrictionCauses(const Manipulator& machine, MachineCauses& out) {
  addFriction(machine, out);
  addPartsOfFriction(machine.parameters(), out);
}

}  // namespace ursula

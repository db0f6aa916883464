#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/causes/machine_collector.h"

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

/// Omits parts of the scenario's friction if it has others too; omitting all of it is a term of its own.
void addFrictionLeftOut(const Machine& machine, MachineCauses& out) {
  const NamedCause named{CauseKind::missing_term, "friction", "all"};
  const auto add = [&](const char* text, bool viscous, bool coulomb, Joints which) {
    out.addFixed({text, named}, [=](Machine& changed) {
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
    add("viscous friction left out", true, false, Joints::all);
    add("Coulomb friction left out", false, true, Joints::all);
  }
  if (rubs(machine, true, true, Joints::driven) && rubs(machine, true, true, Joints::passive)) {
    add("friction of the joints without motors left out", true, true, Joints::passive);
    add("friction of the driven joints left out", true, true, Joints::driven);
  }
  for (const Coordinate coordinate : {Coordinate::phi, Coordinate::psi, Coordinate::theta, Coordinate::d})
    out.addFixed({fmt::format("friction on every {} left out", nameOf(coordinate)), named},
                 [coordinate](Machine& changed) {
                   for (Leg& leg : changed.legs) leg.friction.on(coordinate) = leg.coulomb.on(coordinate) = 0;
                 });
}

}  // namespace

void addFrictionCauses(const Manipulator& machine, MachineCauses& out) {
  addFriction(machine, out);
  addFrictionLeftOut(machine.parameters(), out);
}

}  // namespace ursula

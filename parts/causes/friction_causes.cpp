#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "parts/causes/tried_causes.h"

namespace ursula {
namespace {

using Machine = ManipulatorParameters;

constexpr Coordinate coordinates[] = {Coordinate::phi, Coordinate::psi, Coordinate::theta, Coordinate::d};

/// A law of friction with its key in a scenario and the units of its coefficients.
struct Law {
  const char *words, *key, *of_angles, *of_d;
  JointFriction& (*in)(Leg&);
};
const Law laws[] = {
    {"viscous", "friction", "N m s/rad", "N s/m", [](Leg& leg) -> JointFriction& { return leg.friction; }},
    {"Coulomb", "coulomb", "N m", "N", [](Leg& leg) -> JointFriction& { return leg.coulomb; }}};

/// Fits the coefficients of one law on every leg that has the coordinate. If all are one number of the machine,
/// TriedCauses::addTied fits it.
void addMore(const Law& law, Coordinate coordinate, TriedCauses& out) {
  std::vector<double> given;
  for (Leg leg : out.machine.parameters().legs) {
    const auto& has = rowOf(leg.kind).coordinates;
    if (std::find(has.begin(), has.end(), coordinate) != has.end()) given.push_back(law.in(leg).on(coordinate));
  }
  const auto is_first = [&given](double each) { return each == given.front(); };
  if (given.empty() || (given.front() != 0 && std::all_of(given.begin(), given.end(), is_first))) return;
  const char* unit = slides(coordinate) ? law.of_d : law.of_angles;
  out.addFitted(
      [coordinate, &law](Machine& changed, double x) {
        for (Leg& leg : changed.legs) law.in(leg).on(coordinate) += x;
      },
      [&law, coordinate, unit](double x, double deviation) {
        return fmt::format("{} friction on every {} of {} {} more than the scenario's", law.words, nameOf(coordinate),
                           withDeviation(x, deviation), unit);
      },
      [path = fmt::format("manipulator.leg_defaults.{}.{}", law.key, nameOf(coordinate)), unit](double x,
                                                                                                double deviation) {
        return NamedCause{CauseKind::parameter, "friction", "legs", path, unit, 0, x, deviation};
      });
}

void addSmoothing(TriedCauses& out) {
  const NamedCause speed{CauseKind::parameter, "friction", "legs", "manipulator.leg_defaults.coulomb.smoothing_speed"};
  const auto has = [&out](auto&& one) {
    const std::vector<Leg>& legs = out.machine.parameters().legs;
    return std::any_of(legs.begin(), legs.end(), one);
  };
  // A machine with friction on angles alone, or on d alone, has one speed, which TriedCauses::addTied fits.
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
  out.addMachine({"Coulomb friction without smoothing", speed}, [](Machine& changed) {
    constexpr double sharp_speed = 1e-200;  // every speed is far above it
    for (Leg& leg : changed.legs) leg.coulomb.smoothing_speed = leg.coulomb.sliding_speed = sharp_speed;
  });
}

/// A part of the scenario's friction: whether it has the law's coefficient of one of the leg's joints.
struct Part {
  std::string words;
  std::function<bool(const Law& law, const Leg& leg, std::size_t joint)> has;

  void forEach(Machine& machine, const std::function<void(const Law&, Coordinate, double& coefficient)>& visit) const {
    for (Leg& leg : machine.legs)
      for (std::size_t j = 0; j < 3; ++j)
        for (const Law& law : laws) {
          const Coordinate coordinate = rowOf(leg.kind).coordinates[j];
          if (has(law, leg, j)) visit(law, coordinate, law.in(leg).on(coordinate));
        }
  }

  /// The start of the paths of all its coefficients; empty if all are zero.
  std::string path(Machine machine) const {
    std::string shared;
    forEach(machine, [&shared](const Law& law, Coordinate coordinate, double coefficient) {
      if (coefficient == 0) return;
      const std::string path = fmt::format("manipulator.leg_defaults.{}.{}", law.key, nameOf(coordinate));
      if (shared.empty()) shared = path;
      while ((path + ".").rfind(shared + ".", 0) != 0) shared.erase(shared.rfind('.'));
    });
    return shared;
  }
};

/// Omits each part, or turns its sign, if all of them have friction. All friction is a term of its own.
void addParts(const std::vector<Part>& parts, TriedCauses& out) {
  const auto is_empty = [&out](const Part& part) { return part.path(out.machine.parameters()).empty(); };
  if (std::any_of(parts.begin(), parts.end(), is_empty)) return;
  for (const Part& part : parts)
    for (const auto& [way, kind, times] :
         {std::tuple(" left out", CauseKind::missing_term, 1.0), {" with the wrong sign", CauseKind::sign, 2.0}})
      out.addMachine(
          {part.words + way, {kind, "friction", "all", part.path(out.machine.parameters())}},
          [part](Machine& changed) {
            part.forEach(changed, [](const Law&, Coordinate, double& coefficient) { coefficient = 0; });
          },
          times);
}

}  // namespace

void addFrictionCauses(TriedCauses& out) {
  for (const Coordinate coordinate : coordinates)
    for (const Law& law : laws) addMore(law, coordinate, out);
  addSmoothing(out);
  const auto of_law = [](const Law& wanted) {
    return [&wanted](const Law& law, const Leg&, std::size_t) { return &law == &wanted; };
  };
  const auto of_joints = [](bool driven) {
    return [driven](const Law&, const Leg& leg, std::size_t joint) { return leg.actuated[joint] == driven; };
  };
  addParts({{"viscous friction", of_law(laws[0])}, {"Coulomb friction", of_law(laws[1])}}, out);
  addParts(
      {{"friction of the joints without motors", of_joints(false)}, {"friction of the driven joints", of_joints(true)}},
      out);
  for (const Coordinate coordinate : coordinates)
    addParts({{fmt::format("friction on every {}", nameOf(coordinate)),
               [coordinate](const Law&, const Leg& leg, std::size_t joint) {
                 return rowOf(leg.kind).coordinates[joint] == coordinate;
               }}},
             out);
}

}  // namespace ursula

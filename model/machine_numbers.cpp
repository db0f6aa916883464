#include "model/machine_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ursula {
namespace {

/// The place of a number: i in a vector, i and j in a tensor.
struct Place {
  ManipulatorParameters& machine;
  Leg& leg;
  Link& link;
  Coordinate coordinate;
  int i, j;
};
using Number = double&;

struct Row {
  const char* key;
  NumberGroup group;
  const char *words, *unit;
  int entries;
  Number (*at)(Place);
};

using G = NumberGroup;
/// In the order of Quantity.
constexpr Row rows[] = {
    {"gravity", G::gravity, "gravity", "m/s^2", 3, [](Place p) -> Number { return p.machine.gravity(p.i); }},
    {"platform.mass", G::mass, "mass", "kg", 1, [](Place p) -> Number { return p.machine.platform.mass; }},
    {"platform.center_of_mass", G::center, "mass centre", "m", 3,
     [](Place p) -> Number { return p.machine.platform.center_of_mass(p.i); }},
    {"platform.inertia", G::inertia, "inertia", "kg m^2", 6,
     [](Place p) -> Number { return p.machine.platform.inertia(p.i, p.j); }},
    {"base_point", G::point, "base point", "m", 3, [](Place p) -> Number { return p.leg.base_point(p.i); }},
    {"platform_point", G::point, "platform point", "m", 3, [](Place p) -> Number { return p.leg.platform_point(p.i); }},
    {"base_axis", G::axis, "base axis", "", 3, [](Place p) -> Number { return p.leg.base_axis(p.i); }},
    {"length", G::length, "length", "m", 1, [](Place p) -> Number { return p.link.length; }},
    {"mass", G::mass, "mass", "kg", 1, [](Place p) -> Number { return p.link.mass; }},
    {"center_of_mass", G::center, "mass centre", "m", 1, [](Place p) -> Number { return p.link.center_of_mass; }},
    {"inertia", G::inertia, "inertia", "kg m^2", 6, [](Place p) -> Number { return p.link.inertia(p.i, p.j); }},
    {"friction", G::friction, "viscous friction on ", "N m s/rad", 1,
     [](Place p) -> Number { return p.leg.friction.on(p.coordinate); }},
    {"coulomb", G::friction, "Coulomb friction on ", "N m", 1,
     [](Place p) -> Number { return p.leg.coulomb.on(p.coordinate); }},
    {"coulomb.smoothing_speed", G::friction, "smoothing speed of the Coulomb friction", "rad/s", 1,
     [](Place p) -> Number { return p.leg.coulomb.smoothing_speed; }},
    {"coulomb.sliding_speed", G::friction, "smoothing speed of the Coulomb friction on d", "m/s", 1,
     [](Place p) -> Number { return p.leg.coulomb.sliding_speed; }},
    {"rotor_inertia", G::rotor, "rotor inertia on ", "kg m^2", 1,
     [](Place p) -> Number { return p.leg.rotor_inertia.on(p.coordinate); }},
    {"center_of_mass", G::center, "mass centre", "m", 3, [](Place p) -> Number { return p.link.off_line(p.i); }}};

const Row& rowOf(Quantity quantity) { return rows[static_cast<std::size_t>(quantity)]; }

Number at(ManipulatorParameters& machine, const MachineNumber& number, int entry, bool across = false) {
  Leg& leg = machine.legs.at(std::max(number.leg, 0));
  const auto& [i, j] = tensor_entries[entry];
  return rowOf(number.quantity)
      .at({machine, leg, number.body == NumberBody::proximal ? leg.proximal : leg.distal,
           rowOf(leg.kind).coordinates[entry % 3], across ? j : i, across ? i : j});
}

using Numbers = std::vector<MachineNumber>;

MachineNumber& add(Numbers& out, Quantity quantity, int leg, NumberBody body, int entry) {
  const Row& row = rowOf(quantity);
  const std::string of = leg < 0                    ? ""
                         : body == NumberBody::none ? fmt::format("leg.{}.", leg + 1)
                                                    : fmt::format("leg.{}.{}.", leg + 1, name(body));
  out.push_back({quantity, leg, body, entry, row.entries, "manipulator." + of + row.key, row.words, row.unit});
  return out.back();
}

void add(Numbers& out, const std::vector<Quantity>& quantities, int leg, NumberBody body) {
  for (const Quantity quantity : quantities)
    for (int k = 0; k < rowOf(quantity).entries; ++k) {
      MachineNumber& number = add(out, quantity, leg, body, k);
      if (number.entries == 1) continue;
      const auto& [i, j] = tensor_entries[k];
      number.path += fmt::format(".{}", k);
      number.words += std::string(" ") + "xyz"[i];
      if (number.entries == 6) number.words += "xyz"[j];
    }
}

/// Adds the mass centre as three numbers if it is off the link's line.
void addCenter(Numbers& out, int leg, NumberBody body, const Link& link) {
  if (link.off_line.isZero(0)) return add(out, {Quantity::center}, leg, body);
  add(out, {Quantity::center_across}, leg, body);
  out.pop_back();
  MachineNumber& along = add(out, Quantity::center, leg, body, 0);
  along.path += ".2";
  along.words += " z";
}

void addRotors(Numbers& out, int i, const Leg& leg) {
  for (int k = 0; k < 3; ++k) {
    const Coordinate coordinate = rowOf(leg.kind).coordinates[k];
    if (leg.rotor_inertia.on(coordinate) == 0) continue;
    MachineNumber& number = add(out, Quantity::rotor_inertia, i, NumberBody::none, k);
    number.path += std::string(".") + nameOf(coordinate);
    number.words += nameOf(coordinate);
    if (slides(coordinate)) number.unit = "kg";
  }
}

void addFriction(Numbers& out, int leg, LegKind kind) {
  bool any_slides = false;
  for (int k = 0; k < 3; ++k) {
    const Coordinate coordinate = rowOf(kind).coordinates[k];
    for (const Quantity quantity : {Quantity::friction, Quantity::coulomb}) {
      MachineNumber& number = add(out, quantity, leg, NumberBody::none, k);
      number.path += std::string(".") + nameOf(coordinate);
      number.words += nameOf(coordinate);
      if (slides(coordinate)) number.unit = quantity == Quantity::friction ? "N s/m" : "N";
    }
    any_slides |= slides(coordinate);
  }
  add(out, Quantity::smoothing_speed, leg, NumberBody::none, 0);
  if (any_slides) add(out, Quantity::sliding_speed, leg, NumberBody::none, 0);
}

}  // namespace

const char* name(NumberGroup group) {
  static constexpr const char* names[] = {"gravity", "mass", "center",   "inertia", "length",
                                          "point",   "axis", "friction", "rotor"};
  return names[static_cast<std::size_t>(group)];
}

const char* name(NumberBody body) {
  static constexpr const char* names[] = {"", "platform", "proximal", "distal"};
  return names[static_cast<std::size_t>(body)];
}

NumberGroup MachineNumber::group() const { return rowOf(quantity).group; }

bool MachineNumber::isLinear() const {
  return group() == G::mass || group() == G::center || group() == G::inertia || group() == G::rotor ||
         quantity == Quantity::friction || quantity == Quantity::coulomb;
}

double MachineNumber::get(const ManipulatorParameters& machine) const {
  return at(const_cast<ManipulatorParameters&>(machine), *this, entry);  // it is only read
}

void MachineNumber::set(ManipulatorParameters& machine, double value) const {
  at(machine, *this, entry) = at(machine, *this, entry, entries == 6) = value;
}

double MachineNumber::size(const ManipulatorParameters& machine) const {
  const double* first = &at(const_cast<ManipulatorParameters&>(machine), *this, 0);
  if (entries > 1)
    return entries == 3 ? Eigen::Map<const Vector3d>(first).norm()
                        : Eigen::Map<const Matrix3d>(first).cwiseAbs().maxCoeff();
  return std::abs(*first);
}

Numbers machineNumbers(const ManipulatorParameters& machine) {
  using Q = Quantity;
  using B = NumberBody;
  Numbers out;
  add(out, {Q::gravity}, -1, B::none);
  add(out, {Q::platform_mass, Q::platform_center, Q::platform_inertia}, -1, B::platform);
  for (int i = 0; i < static_cast<int>(machine.legs.size()); ++i) {
    const Leg& leg = machine.legs[i];
    const LegKind kind = leg.kind;
    add(out, {Q::base_point, Q::platform_point, Q::base_axis}, i, B::none);
    const bool telescopic = rowOf(kind).isTelescopic(), carriage = rowOf(kind).hasCarriage();
    if (!telescopic && !carriage) add(out, {Q::length}, i, B::proximal);
    add(out, {Q::mass}, i, B::proximal);
    if (!carriage) addCenter(out, i, B::proximal, leg.proximal);
    if (!carriage) add(out, {Q::inertia}, i, B::proximal);
    add(out, {Q::length, Q::mass}, i, B::distal);
    addCenter(out, i, B::distal, leg.distal);
    add(out, {Q::inertia}, i, B::distal);
    addFriction(out, i, kind);
    addRotors(out, i, leg);
  }
  return out;
}

}  // namespace ursula

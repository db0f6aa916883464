#include "model/named_number.h"

#include <stdexcept>
#include <vector>

namespace ursula {
namespace {

/// What follows "first." in "first.rest", or nothing.
std::string after(const std::string& name, const std::string& first) {
  return name.rfind(first + '.', 0) == 0 ? name.substr(first.size() + 1) : "";
}

std::vector<double*> entriesOf(Matrix3d& I, const std::string& entry) {
  const int i = entry.at(0) - 'x', j = entry.at(1) - 'x';
  if (i == j) return {&I(i, i)};
  return {&I(i, j), &I(j, i)};
}

std::vector<double*> ofLink(Link& link, const std::string& name) {
  if (name == "length") return {&link.length};
  if (name == "mass") return {&link.mass};
  if (name == "center_of_mass") return {&link.center_of_mass};
  return entriesOf(link.inertia, after(name, "inertia"));
}

double* coefficient(JointFriction& friction, const std::string& name) {
  for (const Coordinate one : {Coordinate::phi, Coordinate::psi, Coordinate::theta, Coordinate::d})
    if (name == nameOf(one)) return &friction.on(one);
  throw std::out_of_range(name);
}

std::vector<double*> ofLeg(Leg& leg, const std::string& name) {
  for (auto& [first, vector] : {std::pair<const char*, Vector3d&>{"base_point", leg.base_point},
                                {"platform_point", leg.platform_point},
                                {"base_axis", leg.base_axis}})
    if (const std::string rest = after(name, first); !rest.empty()) return {&vector(rest.at(0) - 'x')};
  if (const std::string rest = after(name, "proximal"); !rest.empty()) return ofLink(leg.proximal, rest);
  if (const std::string rest = after(name, "distal"); !rest.empty()) return ofLink(leg.distal, rest);
  if (name == "coulomb.smoothing_speed") return {&leg.coulomb.smoothing_speed};
  if (name == "coulomb.sliding_speed") return {&leg.coulomb.sliding_speed};
  if (const std::string rest = after(name, "coulomb"); !rest.empty()) return {coefficient(leg.coulomb, rest)};
  return {coefficient(leg.friction, after(name, "friction"))};
}

std::vector<double*> numbersOf(ManipulatorParameters& machine, const std::string& name) {
  if (const std::string rest = after(name, "gravity"); !rest.empty()) return {&machine.gravity(rest.at(0) - 'x')};
  if (name == "platform.mass") return {&machine.platform.mass};
  if (const std::string rest = after(name, "platform.center_of_mass"); !rest.empty())
    return {&machine.platform.center_of_mass(rest.at(0) - 'x')};
  if (const std::string rest = after(name, "platform.inertia"); !rest.empty())
    return entriesOf(machine.platform.inertia, rest);
  return ofLeg(machine.legs.at(static_cast<std::size_t>(name.at(4) - '1')), name.substr(7));
}

}  // namespace

double valueOfNumber(const ManipulatorParameters& machine, const std::string& name) {
  return *numbersOf(const_cast<ManipulatorParameters&>(machine), name).front();  // read alone
}

void changeNumber(ManipulatorParameters& machine, const std::string& name, double by) {
  for (double* number : numbersOf(machine, name)) *number += by;
}

}  // namespace ursula

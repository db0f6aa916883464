#include "nocsolver/slope_table.h"

#include <algorithm>

namespace ursula::kernel {
namespace {

const char* const axes[] = {"x", "y", "z"};
const char* const entries[] = {"xx", "yy", "zz", "xy", "xz", "yz"};

// Places in ParameterSlopes (slope_functions.h).
enum PlatformPlace { mass_at = 0, rho_at = 1, inertia_at = 4, gravity_at = 10 };
enum LegPlace {
  base_point_at = 0,
  platform_point_at = 3,
  l_at = 6,
  s_at = 7,
  axis_at = 8,
  leg_gravity_at = 11,
  proximal_at = 14,
  distal_at = 22,
  viscous_at = 30,
  coulomb_at = 33,
  speed_at = 36
};

class Builder {
 public:
  void add(const std::string& name, SlopePlace::Where where, int leg, int k) {
    table.names.push_back(name);
    table.places.push_back({where, leg, k});
  }
  void addVector(const std::string& name, SlopePlace::Where where, int leg, int first) {
    for (int k = 0; k < 3; ++k) add(name + '.' + axes[k], where, leg, first + k);
  }
  void addTensor(const std::string& name, SlopePlace::Where where, int leg, int first) {
    for (int k = 0; k < 6; ++k) add(name + '.' + entries[k], where, leg, first + k);
  }
  SlopeTable table;
};

std::string legName(int i) { return "leg[" + std::to_string(i + 1) + "]"; }
bool carriage(const LegNumbers& leg) { return leg.kind == LegKind::PUS; }

void addFriction(Builder& out, const LegNumbers& leg, int i, bool speeds) {
  const auto& coordinates = rowOf(leg.kind).coordinates;
  for (int j = 0; j < 3; ++j) {
    const std::string coordinate = nameOf(coordinates[static_cast<std::size_t>(j)]);
    out.add(legName(i) + ".friction." + coordinate, SlopePlace::leg, i, viscous_at + j);
    out.add(legName(i) + ".coulomb." + coordinate, SlopePlace::leg, i, coulomb_at + j);
  }
  if (!speeds) return;
  out.add(legName(i) + ".coulomb.smoothing_speed", SlopePlace::leg, i, speed_at);
  if (std::any_of(coordinates.begin(), coordinates.end(), slides))
    out.add(legName(i) + ".coulomb.sliding_speed", SlopePlace::leg, i, speed_at + 1);
}

/// Of the tensor about a link's first end.
void pushLink(double mass, double distance, const double* I, std::vector<double>& out) {
  const double first = mass * distance, second = first * distance;
  for (const double value : {mass, first, I[0] + second, I[4] + second, I[8], I[3], I[6], I[7]}) out.push_back(value);
}

void pushPlatform(const MachineNumbers& machine, std::vector<double>& out) {
  const double m = machine.mass, *r = machine.rho, *I = machine.I_M;
  const auto about_P = [&](int a, int b) {
    const double square = a == b ? r[0] * r[0] + r[1] * r[1] + r[2] * r[2] : 0;
    return I[a + 3 * b] + m * (square - r[a] * r[b]);
  };
  for (const double value : {m, m * r[0], m * r[1], m * r[2], about_P(0, 0), about_P(1, 1), about_P(2, 2),
                             about_P(0, 1), about_P(0, 2), about_P(1, 2)})
    out.push_back(value);
}

}  // namespace

SlopeTable parameterTable(const MachineNumbers& machine) {
  Builder out;
  out.addVector("gravity", SlopePlace::gravity, 0, 0);
  out.add("platform.mass", SlopePlace::platform, 0, mass_at);
  out.addVector("platform.center_of_mass", SlopePlace::platform, 0, rho_at);
  out.addTensor("platform.inertia", SlopePlace::platform, 0, inertia_at);
  for (int i = 0; i < machine.legs_in_all; ++i) {
    const LegNumbers& leg = machine.legs[static_cast<std::size_t>(i)];
    out.addVector(legName(i) + ".base_point", SlopePlace::leg, i, base_point_at);
    out.addVector(legName(i) + ".platform_point", SlopePlace::leg, i, platform_point_at);
    out.addVector(legName(i) + ".base_axis", SlopePlace::leg, i, axis_at);
    const auto addLink = [&](const std::string& name, int length, int first) {
      if (length >= 0) out.add(name + ".length", SlopePlace::leg, i, length);
      out.add(name + ".mass", SlopePlace::leg, i, first);
      out.add(name + ".center_of_mass", SlopePlace::leg, i, first + 1);
      out.addTensor(name + ".inertia", SlopePlace::leg, i, first + 2);
    };
    if (carriage(leg))
      out.add(legName(i) + ".proximal.mass", SlopePlace::leg, i, proximal_at);
    else
      addLink(legName(i) + ".proximal", leg.kind == LegKind::UPS ? -1 : l_at, proximal_at);
    addLink(legName(i) + ".distal", s_at, distal_at);
    addFriction(out, leg, i, true);
  }
  return std::move(out.table);
}

SlopeTable regressorTable(const MachineNumbers& machine) {
  Builder out;
  out.add("platform.mass", SlopePlace::platform, 0, mass_at);
  out.addVector("platform.first_moment", SlopePlace::platform, 0, rho_at);
  out.addTensor("platform.inertia_at_P", SlopePlace::platform, 0, inertia_at);
  for (int i = 0; i < machine.legs_in_all; ++i) {
    const LegNumbers& leg = machine.legs[static_cast<std::size_t>(i)];
    for (const bool proximal : {true, false}) {
      const std::string name = legName(i) + (proximal ? ".proximal" : ".distal");
      const int first = proximal ? proximal_at : distal_at;
      out.add(name + ".mass", SlopePlace::leg, i, first);
      if (proximal && carriage(leg)) continue;
      out.add(name + ".first_moment", SlopePlace::leg, i, first + 1);
      out.addTensor(name + ".inertia_at_end", SlopePlace::leg, i, first + 2);
    }
    addFriction(out, leg, i, false);
  }
  return std::move(out.table);
}

std::vector<double> regressorValues(const MachineNumbers& machine) {
  std::vector<double> out;
  pushPlatform(machine, out);
  for (int i = 0; i < machine.legs_in_all; ++i) {
    const LegNumbers& leg = machine.legs[static_cast<std::size_t>(i)];
    if (carriage(leg))
      out.push_back(leg.mass_1);
    else
      pushLink(leg.mass_1, leg.rho, leg.I_1, out);
    pushLink(leg.mass_2, leg.sigma, leg.I_2, out);
    for (int j = 0; j < 3; ++j) {
      out.push_back(leg.viscous[j]);
      out.push_back(leg.smooth[j]);
    }
  }
  return out;
}

MachineNumbers unitBodies(MachineNumbers machine) {
  machine.mass = 1;
  std::fill(std::begin(machine.rho), std::end(machine.rho), 0.0);
  std::fill(std::begin(machine.I_M), std::end(machine.I_M), 0.0);
  for (int i = 0; i < machine.legs_in_all; ++i) {
    LegNumbers& leg = machine.legs[static_cast<std::size_t>(i)];
    leg.mass_1 = leg.mass_2 = 1;
    leg.rho = leg.sigma = 0;
    std::fill(std::begin(leg.I_1), std::end(leg.I_1), 0.0);
    std::fill(std::begin(leg.I_2), std::end(leg.I_2), 0.0);
  }
  return machine;
}

Vector6d slopeOf(const SlopePlace& place, const ParameterSlopes& slopes, int legs) {
  using Six = Eigen::Map<const Vector6d>;
  if (place.where == SlopePlace::platform) return Six(slopes.platform[place.k]);
  if (place.where == SlopePlace::leg) return Six(slopes.legs[place.leg_index][place.k]);
  Vector6d out = Six(slopes.platform[gravity_at + place.k]);
  for (int i = 0; i < legs; ++i) out += Six(slopes.legs[i][leg_gravity_at + place.k]);
  return out;
}

}  // namespace ursula::kernel

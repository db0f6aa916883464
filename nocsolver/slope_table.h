#pragma once

#include <string>
#include <vector>

#include "nocsolver/kernels/slope_functions.h"

namespace ursula::kernel {

/// Where in ParameterSlopes a number's derivatives are. Internal to EffortDerivatives.
struct SlopePlace {
  enum Where { platform, leg, gravity };
  Where where;
  int leg_index, k;
};

struct SlopeTable {
  std::vector<std::string> names;
  std::vector<SlopePlace> places;
};

/// The machine's numbers that efforts depend on, as they are written.
SlopeTable parameterTable(const MachineNumbers& machine);
/// Those that efforts are linear in.
SlopeTable regressorTable(const MachineNumbers& machine);
/// Their values, in the same order.
std::vector<double> regressorValues(const MachineNumbers& machine);

/// The machine with bodies of mass 1 at P and at the links' first ends, without inertia: derivatives there, by mass,
/// distance and inertia, are the columns of the regressor.
MachineNumbers unitBodies(MachineNumbers machine);

Vector6d slopeOf(const SlopePlace& place, const ParameterSlopes& slopes, int legs);

}  // namespace ursula::kernel

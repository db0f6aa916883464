#pragma once

// The interface between a batch and the source for one instruction set. Internal: plain numbers and functions.

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/scalar.h"
#include "model/leg_kind.h"

namespace ursula::kernel {

/// The properties of a machine that are not real numbers.
struct MachineShape {
  int legs = 0;
  PerLeg<LegKind> kinds{};
  PerLeg<std::array<int, 3>> motors{};
  PerLeg<bool> has_friction{}, has_coulomb{}, principal{}, has_rotor{}, off_line{};
};

/// Contiguous entries with the layout of Motion<double> and Vector6d. `loads` may be null.
struct BatchSpans {
  std::size_t count;
  const double *motions, *efforts, *loads;
  double* out;
  std::uint8_t* faults;
};

/// The contributions of six legs, one per lane, at one pose. `rows` are those of Bᵀ, moments divided by the length, one
/// motor per column; for the direct dynamics, the lower half of M_P. Columns from the seventh on are unused.
struct LegSums {
  double rows[6][8], wrench[6], Q[8], A[8];
};

struct BatchFunctions {
  void* (*make)(const double* numbers, const MachineShape& shape);
  void (*destroy)(void* machine);
  void (*inverse)(const void* machine, const BatchSpans& spans);
  void (*direct)(const void* machine, const BatchSpans& spans);
  // For one pose, with one leg per lane (leg_lanes.h); these return false if a leg refuses the pose.
  void* (*make_legs)(const double* numbers, const MachineShape& shape);
  void (*destroy_legs)(void* legs);
  bool (*inverse_legs)(const void* legs, const double* motion, LegSums& out);
  bool (*direct_legs)(const void* legs, const double* motion, const double* efforts, LegSums& out);
};

// Each is defined in its own source.
BatchFunctions batchBySse2();
BatchFunctions batchByAvx2();
BatchFunctions batchByAvx512();

}  // namespace ursula::kernel

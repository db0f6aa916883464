#pragma once

// What EffortDerivatives asks of the source that is compiled for an instruction set. Internal: plain numbers and
// functions.

#include <array>

#include "model/leg_kind.h"
#include "model/scalar.h"
#include "nocsolver/pose_fault.h"

namespace ursula::kernel {

/// ChainModel<double>, and what MachineModel has beside it, as plain numbers; matrices by columns.
struct LegNumbers {
  LegKind kind;
  std::array<int, 3> motor;
  bool rubs, rubs_dry, principal;
  double axis[3];  ///< as it is written, not of length 1
  double x_hat[3], u[3], z_hat[3];
  double a[3], b[3];
  double l, s, knee, rho, sigma, mass_1, mass_2;
  double I_1[9], I_2[9];
  double viscous[3], smooth[3], speed[3];
};

struct MachineNumbers {
  int legs_in_all;
  std::array<LegNumbers, leg_count> legs;
  double mass, length, rho[3], I_M[9], gravity[3];
};

/// Why there is no answer; `bound` or `what` as the functions of chain_frame.h and platform_at_p.h take them.
struct Refusal {
  PoseFault kind = PoseFault::none;
  int leg = -1;
  double measure = 0, bound = 0;
  const char* what = nullptr;
};

/// A state and what acts: numbers as Motion<double> has them from t on, and a wrench at P with its derivative by a turn
/// of the platform, 6 × 3, by columns.
struct StateNumbers {
  const double *motion, *load, *load_by_turn;
};

constexpr int state_count = 18;

/// Numbers of a leg, in this order: aᵢ, bᵢ, l, s; the axis as it is written, gravity; mass, ρ and I (xx, yy, zz, xy,
/// xz, yz) of the proximal link; mass, σ and I of the distal one; viscous and Coulomb friction of the three
/// coordinates, smoothing speeds of angles and of d.
constexpr int leg_parameter_count = 6 + 2 + 6 + 8 + 8 + 8;
/// Mass, ρ, I as above, gravity.
constexpr int platform_parameter_count = 1 + 3 + 6 + 3;

/// Six numbers each, the efforts' derivatives.
struct ParameterSlopes {
  double platform[platform_parameter_count][6];
  double legs[leg_count][leg_parameter_count][6];
};

struct SlopeFunctions {
  /// Efforts, and their derivatives by δ, p, ω, ṗ, ω̇, p̈: 6 × 18, by columns.
  Refusal (*byState)(const MachineNumbers& machine, const StateNumbers& state, double* efforts, double* derivatives);
  /// Derivatives by the numbers of `at`, which is `machine` but for what efforts are linear in.
  Refusal (*byParameters)(const MachineNumbers& machine, const MachineNumbers& at, const StateNumbers& state,
                          ParameterSlopes& out);
};

// Each in a source of its own.
SlopeFunctions slopesOneByOne();
SlopeFunctions slopesBySse2();
SlopeFunctions slopesByAvx2();
SlopeFunctions slopesByAvx512();

}  // namespace ursula::kernel

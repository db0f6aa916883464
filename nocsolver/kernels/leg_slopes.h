#pragma once

// A leg's share of inverse dynamics and its derivatives by where B is and how fast. Internal: plain numbers, and
// functions that are compiled for one instruction set each.
//
// A leg sees the platform's motion by that of B alone: AB, v_B, a_B. The derivatives by the first two are carried along
// as tangents by the kernels of plane_dynamics.h; by a_B the loads are linear, and plane_mass.h has their factors.

#include <array>

#include "model/leg_kind.h"

namespace ursula::kernel {

/// ChainModel<double> and `lift`, `rubs`, `coulomb` of MachineModel as plain numbers; matrices by columns.
struct LegNumbers {
  LegKind kind;
  bool rubs, coulomb;
  std::array<int, 3> motor;
  double axes[9];  ///< x_hat, u, z_hat
  double l, s, knee, rho, sigma, mass_1, mass_2;
  double I_1[9], I_2[9];
  double viscous[3], smooth[3], speed[3];
  double lift[3];
};

/// AB, v_B and a_B along x_hat, u, z_hat.
struct TipMotion {
  double AB[3], v[3], a[3];
};

/// What a guard refused first.
struct LegFault {
  enum Kind { none, out_of_reach, end_of_stroke, point_on_axis, stretched_leg };
  Kind kind = none;
  double measure, bound;
  const char* what;
};

/// By AB, in B, lanes 0 to 2; by v_B, in B, lanes 3 to 5.
using Slope = std::array<double, 8>;

struct LegSlopes {
  LegFault fault;
  double cosine, sine, C_1, S_1, C_2, S_2, d;  ///< of PlaneLeg
  std::array<std::array<double, 3>, 3> k;      ///< rows of the map in the plane
  std::array<double, 3> Q;                     ///< on the coordinates
  std::array<double, 3> force;                 ///< at B, in B, of the coordinates that no motor drives
  std::array<Slope, 3> d_force, d_Q;
  std::array<std::array<Slope, 3>, 3> d_row;  ///< of the driven coordinates' rows, in B
};

/// Of the platform; matrices by columns, in M.
struct PlatformNumbers {
  double mass, rho[3], I_M[9], gravity[3];
};

/// By a turn δ, by ω, ω̇ and p̈, in this order.
struct PlatformSlopes {
  std::array<double, 6> wrench;  ///< [moment about P; force] that moves the platform against gravity
  std::array<std::array<double, 16>, 6> d_wrench;
};

struct SlopeFunctions {
  /// Stops at the first leg with a fault; false then.
  bool (*byState)(const LegNumbers* legs, const TipMotion* motions, int count, LegSlopes* out);
  /// Q by columns, ω, ω̇, p̈, in B.
  void (*ofPlatform)(const PlatformNumbers& platform, const double* Q, const double* omega, const double* omega_dot,
                     const double* p_ddot, PlatformSlopes& out);
};

// Each in a source of its own.
SlopeFunctions slopesOneByOne();
SlopeFunctions slopesBySse2();
SlopeFunctions slopesByAvx2();
SlopeFunctions slopesByAvx512();

}  // namespace ursula::kernel

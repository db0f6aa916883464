#pragma once

#include <memory>

#include "model/load.h"
#include "model/manipulator.h"
#include "model/motion.h"
#include "nocsolver/solver.h"

namespace ursula {

/// How rounding errors of either road may show at one instant; the factors of every pointwise limit.
/// Always from the formulas that hold, never from the subject on trial. See docs/validation.md.
struct Conditioning {
  double kappa_B = 0;         ///< 2-norm condition number of B, moments over the machine's length
  double kappa_legs = 0;      ///< largest of 1/sin²θᵢ · (qᵢ/rᵢ)²: how rounding grows in a leg's rates
  double smallest_sine = 0;   ///< min |sin θᵢ|: the distance from a stretched or folded leg
  int smallest_sine_leg = 0;  ///< 0-based
  double torque_scale = 0;    ///< ‖|T|ᵀ|w|‖: size of what cancels in (37), N·m
  double response = 0;        ///< ‖S T_P I⁻¹‖: platform acceleration for a torque, (m/s²)/(N·m)
  double compliance = 0;      ///< of the platform alone: its acceleration for a force at a spherical joint, 1/kg
  double leg_compliance = 0;  ///< largest of a distal link alone at its spherical joint, 1/kg
  double force_scale = 0;     ///< root of the sum of squares of the forces at the spherical joints, N
  double largest_mass = 0;    ///< of a body, kg
  double length = 0;          ///< a length of the machine, m
  double position_scale = 0;  ///< largest coordinate, m
  double twist_scale = 0;     ///< size of a body's velocity, m/s
  double rate_scale = 0;      ///< size of a body's acceleration, m/s²

  /// Rounding of a torque on either road, N·m.
  double torqueRounding() const;
  /// Rounding of the platform's acceleration by the forces that close the loops, which an engine with free bodies adds
  /// up: they cancel the more, the lighter the platform is against its legs. m/s².
  double loopRounding() const;
  /// Rounding of the accelerations at which the loops' gaps open, by the same forces on both sides. m/s².
  double gapRounding() const;
  /// Rounding of the platform's acceleration under given torques, m/s².
  double accelerationRounding() const;
};

class ConditioningProbe {
 public:
  ConditioningProbe(const Manipulator& manipulator, std::shared_ptr<const Load> load);
  /// Throws PoseError as the solver does.
  Conditioning at(const Motion<double>& motion);

 private:
  Manipulator manipulator_;
  std::shared_ptr<const Load> load_;
  Solver<double> solver_;
  Workspace<double> work_;
};

/// In units of eps, what rounding adds up to on the longest chain of dependent operations from the base to a torque:
/// n = 38, once for each of 13 bodies and 6 pivots on each of two roads. Roundings are independent, so that they grow
/// as λ√n with λ = 4, rounded up: Higham and Mary, SIAM J. Sci. Comput. 41 (2019) A2815, theorem 2.4.
constexpr double rounding_depth = 25;

}  // namespace ursula

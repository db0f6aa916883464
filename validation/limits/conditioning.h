#pragma once

#include <array>
#include <limits>
#include <memory>

#include "engines/further_engines.h"
#include "model/load.h"
#include "model/manipulator.h"
#include "model/motion.h"
#include "nocsolver/noc/noc.h"

namespace ursula {

/// In units of eps, what rounding adds up to on the longest chain of dependent operations from the base to a torque:
/// n = 38, once for each of 13 bodies and 6 pivots on each of two formulations. Roundings are independent, so that they
/// grow as λ√n with λ = 4, rounded up: Higham and Mary, SIAM J. Sci. Comput. 41 (2019) A2815, theorem 2.4. Stands in
/// where nothing was measured.
constexpr double rounding_depth = 25;

/// What rounds: each pointwise limit is of one of these.
enum class Rounded {
  angles,          ///< joint angles, rad
  rates,           ///< joint rates, rad/s
  accelerations,   ///< joint accelerations, rad/s²
  positions,       ///< of 13 bodies, m
  twists,          ///< of 13 bodies, m/s
  twist_rates,     ///< of 13 bodies, m/s²
  jacobian,        ///< T φ̇, m/s
  jacobian_rate,   ///< T φ̈ + Ṫ φ̇, m/s²
  shaping,         ///< T itself, m
  shaping_rate,    ///< Ṫ, m/s
  torque,          ///< solver's and Simbody's, N·m
  solver,          ///< the solver's torque alone, N·m
  acceleration,    ///< Simbody's of the platform under the solver's torques, m/s²
  effort,          ///< the same as torques, N·m
  gaps,            ///< accelerations at which the loops' gaps open, m/s²
  reactions,       ///< forces at the joints and moments over the machine's length, N
  direct,          ///< solver's and Simbody's direct dynamics under the same torques, m/s²
  solver_direct,   ///< the solver's direct dynamics alone, m/s²
  further_engine,  ///< solver's torque and that of the first further formulation, N·m; of the others: ofFurtherEngine
};
constexpr std::size_t rounded_count = static_cast<std::size_t>(Rounded::further_engine) + further_engine_count;

/// The solver's torque and that of the k-th further formulation, N·m.
constexpr Rounded ofFurtherEngine(std::size_t k) {
  return static_cast<Rounded>(static_cast<std::size_t>(Rounded::further_engine) + k);
}

/// Direct dynamics solves with I of (34).
constexpr bool solvesWithI(Rounded quantity) {
  return quantity == Rounded::direct || quantity == Rounded::solver_direct;
}

/// How far a quantity's rounding goes, in units of its shape (Conditioning::shape).
using RoundingLevels = std::array<double, rounded_count>;

constexpr RoundingLevels uniformLevels(double level) {
  RoundingLevels levels{};
  for (double& each : levels) each = level;
  return levels;
}

/// How rounding errors of either formulation may show at one instant; the factors of every pointwise limit. The shape
/// of a limit, how it grows with the pose and the machine, is derived; its level is measured (RoundingProfile). No
/// number here depends on the frame in which the machine is written. Always from the formulas that hold, never from the
/// subject on trial. See docs/validation.md.
struct Conditioning {
  double kappa_B = 0;         ///< 2-norm condition number of B, moments over the machine's length
  double kappa_I = 1;         ///< that of I of (34), each row and column over the root of its diagonal entry
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

  double shaping_scale = 0;  ///< ‖T‖, angular rows times length, m
  double effort_scale = 0;   ///< ‖T_PᵀM_P‖: torque for an acceleration of the platform, N·m/(m/s²)
  double weight_ratio = 0;   ///< force_scale over the platform's weight and inertia
  RoundingLevels levels = uniformLevels(rounding_depth);

  /// Whether rounding leaves I of (34) a digit: Higham, Accuracy and Stability of Numerical Algorithms (2002), p. 198.
  bool hasDigitsOfI() const { return rounding_depth * std::numeric_limits<double>::epsilon() * kappa_I < 1; }
  /// How `quantity` rounds with the pose and the machine, times eps: its unit.
  double shape(Rounded quantity) const;
  /// What rounding may make of it: shape × level; infinite where I has no digit and `quantity` needs it.
  double rounding(Rounded quantity) const;

  /// Of ‖D T‖ over ‖D‖‖T‖: not measured.
  double complementRounding() const;
  /// Rounding of a torque on either formulation, N·m.
  double torqueRounding() const { return rounding(Rounded::torque); }
  /// Rounding of the platform's acceleration in Simbody under torques, those included that rounding makes of them,
  /// m/s².
  double accelerationRounding() const { return rounding(Rounded::acceleration); }
};

class ConditioningProbe {
 public:
  ConditioningProbe(const Manipulator& manipulator, std::shared_ptr<const Load> load);
  /// Throws PoseError as the solver does.
  Conditioning at(const Motion<double>& motion);

 private:
  Manipulator manipulator_;
  std::shared_ptr<const Load> load_;
  Noc<double> solver_;
  NocWorkspace<double> work_;
};

/// What makes the limit of `quantity` large here, with the number.
std::string causeOfRounding(const Conditioning& at, Rounded quantity = Rounded::torque);

}  // namespace ursula

#pragma once

#include <array>
#include <limits>
#include <memory>

#include "model/load.h"
#include "model/manipulator.h"
#include "model/motion.h"
#include "nocsolver/noc/noc.h"
#include "validation/limits/further_engines.h"

namespace ursula {

/// The rounding, in units of eps, of the longest chain of dependent operations from the base to a torque. It has n = 38
/// links: 13 bodies and 6 pivots in each of two formulations. Independent roundings grow as λ√n with λ = 4, rounded up:
/// Higham and Mary, SIAM J. Sci. Comput. 41 (2019) A2815, theorem 2.4. It applies if nothing was measured.
constexpr double rounding_depth = 25;

/// The largest spread of one component that rounding explains, in units of a shape, if inputs differ by one rounding.
/// Each of the 38 links then has two roundings: its own, and that of the input that enters there. So n = 76, and
/// λ√n = 34.9 with λ = 4, rounded up.
constexpr double most_spread = 35;

/// The quantities with rounding errors; each pointwise limit belongs to one of these.
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
  acceleration,    ///< Simbody's platform acceleration under the solver's torques, m/s²
  effort,          ///< the same as torques, N·m
  gaps,            ///< accelerations at which the loops' gaps open, m/s²
  reactions,       ///< forces at the joints and moments over the machine's length, N
  direct,          ///< solver's and Simbody's direct dynamics under the same torques, m/s²
  solver_direct,   ///< the solver's direct dynamics alone, m/s²
  further_engine,  ///< solver's torque and the first further formulation's, N·m; for the others
                   ///< ofFurtherEngine
};
constexpr std::size_t rounded_count = static_cast<std::size_t>(Rounded::further_engine) + most_further_engines;

/// The solver's torque and that of the k-th further formulation, N·m.
constexpr Rounded ofFurtherEngine(std::size_t k) {
  return static_cast<Rounded>(static_cast<std::size_t>(Rounded::further_engine) + k);
}

/// Whether the quantity is an engine's effort, or its acceleration as efforts.
constexpr bool isEffortOfEngine(Rounded quantity) {
  return quantity == Rounded::torque || quantity == Rounded::effort || quantity >= Rounded::further_engine;
}

/// Whether the quantity needs a solution with I of (34), as direct dynamics does.
constexpr bool solvesWithI(Rounded quantity) {
  return quantity == Rounded::direct || quantity == Rounded::solver_direct;
}

/// The rounding of each quantity in units of its shape (Conditioning::shape).
using RoundingLevels = std::array<double, rounded_count>;

constexpr RoundingLevels uniformLevels(double level) {
  RoundingLevels levels{};
  for (double& each : levels) each = level;
  return levels;
}

/// Whose answers spread more than rounding explains.
enum class Noisy : unsigned char { nobody, solver, engine };

/// The size of a twist or its rate, [angular; linear], with rotations times `length`.
inline double twistSize(const Vector6d& v, double length) { return v.tail<3>().norm() + length * v.head<3>().norm(); }

/// The conditioning of both formulations at one instant, with the factors of every pointwise limit. A limit's shape,
/// its growth with pose and machine, is derived; its level is measured (RoundingProfile). No number here depends on the
/// machine's frame. It always uses the correct formulas, never the subject. See docs/validation.md.
struct Conditioning {
  double kappa_B = 0;         ///< 2-norm condition number of B, moments over the machine's length
  double kappa_I = 1;         ///< condition number of I of (34), rows and columns divided by the roots of its diagonal
  double kappa_legs = 0;      ///< largest of 1/sin²θᵢ · (qᵢ/rᵢ)²: the growth of rounding in a leg's rates
  double smallest_sine = 0;   ///< min |sin θᵢ|: the distance from a stretched or folded leg
  int smallest_sine_leg = 0;  ///< 0-based
  double torque_scale = 0;    ///< ‖|T|ᵀ|w|‖: size of the terms that cancel in (37), N·m
  double response = 0;        ///< ‖S T_P I⁻¹‖: platform acceleration per torque, (m/s²)/(N·m)
  double compliance = 0;      ///< of the platform alone: its acceleration per force at a spherical joint, 1/kg
  double leg_compliance = 0;  ///< largest of a distal link alone at its spherical joint, 1/kg
  double force_scale = 0;     ///< root of the sum of squares of the forces at the spherical joints, N
  double largest_mass = 0;    ///< of a body, kg
  double length = 0;          ///< a length of the machine, m
  double position_scale = 0;  ///< largest coordinate, m
  double twist_scale = 0;     ///< size of a body's velocity, m/s
  double rate_scale = 0;      ///< size of a body's acceleration, m/s²

  double shaping_scale = 0;  ///< ‖T‖, angular rows times length, m
  double effort_scale = 0;   ///< ‖T_PᵀM_P‖: torque per acceleration of the platform, N·m/(m/s²)
  double weight_ratio = 0;   ///< force_scale over the platform's weight and inertia forces
  double effort = 0;         ///< the largest effort of a motor, N·m
  double reaction = 0;       ///< the largest force at a joint, or moment over the length, N
  double platform_rate = 0;  ///< size of the platform's acceleration, m/s²
  RoundingLevels levels = uniformLevels(rounding_depth);
  RoundingLevels floors = uniformLevels(0);  ///< the least limits: one rounding of the motion's own sizes (MotionSizes)
  std::array<Noisy, rounded_count> noisy{};  ///< the level of such a quantity is infinite

  /// Whether I of (34) keeps a correct digit: Higham, Accuracy and Stability of Numerical Algorithms (2002), p. 198.
  bool hasDigitsOfI() const { return rounding_depth * std::numeric_limits<double>::epsilon() * kappa_I < 1; }
  /// The growth of rounding in `quantity` with pose and machine, times eps: the unit of its level.
  double shape(Rounded quantity) const;
  /// The size of `quantity` itself.
  double size(Rounded quantity) const;
  /// The bound of its rounding: shape × level, at least the floor. Infinite without a level, or if I has no digit and
  /// `quantity` needs it.
  double rounding(Rounded quantity) const;

  /// The rounding of ‖D T‖ over ‖D‖‖T‖; it is derived, not measured.
  double complementRounding() const;
  /// Bound of the difference of a torque by rounding in both formulations, N·m.
  double torqueRounding() const { return rounding(Rounded::torque); }
  /// Rounding of the platform's acceleration in Simbody under torques, including the torques' own rounding, m/s².
  double accelerationRounding() const { return rounding(Rounded::acceleration); }
};

class ConditioningProbe {
 public:
  ConditioningProbe(const Manipulator& manipulator, std::shared_ptr<const Load> load);
  /// Throws PoseError like the solver.
  Conditioning at(const Motion<double>& motion);

 private:
  Manipulator manipulator_;
  std::shared_ptr<const Load> load_;
  Noc<double> solver_;
  NocWorkspace<double> work_;
};

/// Returns the engine that the quantity compares with, as in the odd one out: "Simbody, free platform", "MuJoCo".
const char* nameOfEngine(Rounded quantity);

/// Returns what makes the limit of `quantity` large here, with the number.
std::string causeOfRounding(const Conditioning& at, Rounded quantity = Rounded::torque);

}  // namespace ursula

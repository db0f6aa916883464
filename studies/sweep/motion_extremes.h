#pragma once

#include <array>
#include <vector>

#include "model/scenario.h"
#include "nocsolver/fast/batch_dynamics.h"

namespace ursula {

/// The largest effort of one motor along a motion.
struct LargestEffort {
  double value = 0;  ///< |τ|, N·m, or N where the motor pushes
  double t = 0;      ///< the first instant at which it is so large, s
};

struct Extremes {
  std::array<LargestEffort, motor_count> efforts;
  /// Condition number of B of (23), moments over the machine's length, where ‖B‖ ‖B⁻¹‖ in Frobenius' norm is largest.
  double kappa = 0;
  double sine = 1;  ///< the smallest LegMargins::sine of all legs and instants
};

/// Extremes over the instants that a scenario is judged at. Keeps its memory, and the motion where that is the same
/// for all.
class MotionExtremes {
 public:
  /// Throws PoseError as the solver does, for the first instant that has no answer. `varies`: the motion is another
  /// than at the last call.
  Extremes of(const Scenario& scenario, bool varies);

 private:
  void fill(const Scenario& scenario);
  void efforts(const Scenario& scenario, Extremes& out);
  void margins(const Scenario& scenario, Extremes& out) const;

  std::vector<Motion<double>> motions_;
  std::vector<Vector6d> loads_, efforts_;
  std::vector<PoseFault> faults_;
};

}  // namespace ursula

#pragma once

#include <array>
#include <vector>

#include "model/scenario.h"
#include "nocsolver/fast/batch_dynamics.h"

namespace ursula {

/// The largest effort of one motor along a motion.
struct LargestEffort {
  double value = 0;  ///< |τ|, N·m, or N for a sliding motor
  double t = 0;      ///< the first instant of this value, s
};

struct Extremes {
  std::array<LargestEffort, motor_count> efforts;
  /// Condition number of B of (23) with moments over the machine's length, where ‖B‖ ‖B⁻¹‖ in Frobenius norms is
  /// largest.
  double kappa = 0;
  double sine = 1;  ///< the smallest LegMargins::sine over all legs and instants
};

/// Extremes over a scenario's judged instants. It reuses its memory, and the motion if that is constant.
class MotionExtremes {
 public:
  /// Throws PoseError like the solver, for the first instant without an answer. `varies` says that the motion differs
  /// from the last call's.
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

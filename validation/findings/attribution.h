#pragma once

#include <array>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/replay/windows.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/frame_change.h"
#include "validation/verdict/result.h"

namespace ursula {

/// The measured contribution of one source to the replay's position error.
struct ErrorShare {
  Vector3d error = Vector3d::Zero();  ///< m, in B
  double uncertainty = 0;             ///< m
};

/// The sources of the replay's error, at the window end with the largest error. The contributions are differences
/// between successive replays:
///   the judged replay → the same with the loops' gaps projected away → the mean over inputs changed by one rounding →
///   an exact integration → the torques without their pointwise errors → the commanded path.
/// They add up to the observed error except for the unexplained part.
struct ErrorBudget {
  double t = 0;                          ///< s
  Vector3d observed = Vector3d::Zero();  ///< m, in B
  ErrorShare model;           ///< pointwise errors of the acceleration, propagated by the variational equations
  double model_rounding = 0;  ///< m; rounding of the residuals, propagated likewise
  ErrorShare integration;     ///< from the change with a hundredfold tolerance
  ErrorShare rounding;        ///< from the change of inputs by one rounding
  ErrorShare closure;         ///< from the change when the gaps are projected away
  double amplification = 0;   ///< growth of a deviation at the window's start; not an error itself
  ErrorSource dominant = ErrorSource::unexplained;
  bool measured = false;  ///< false without a replay to analyse
  /// The lines of a plot over the window: instants, observed error, the five parts that addBudget() names, the judged
  /// replay's limit. A part is NaN where its replay ended earlier.
  std::array<std::vector<double>, 8> along;

  Vector3d unexplained() const;
  /// Uncertainty of the sum of the contributions, m.
  double uncertainty() const;
};

/// Repeats the window's replay in several ways. `windows` are the judged replays under `torques`; `plan` produced them.
/// Empty without a replay, or if the scenario's time is up, because it decides nothing.
ErrorBudget attribute(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                      const std::vector<WindowedReplay>& windows, const Amplification* amplification,
                      const ReplayPlan& plan, int threads);

/// Adds the findings, and `along` as a curve. Amplification dominates if a replay's limit, not its error, prevents a
/// verdict. `rest` is what no measured source explains.
void addBudget(const ErrorBudget& budget, ValidationResult& result, const Units& units = {},
               ErrorSource rest = ErrorSource::unexplained);

}  // namespace ursula

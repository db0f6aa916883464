#pragma once

#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/replay/windows.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/frame_change.h"
#include "validation/verdict/result.h"

namespace ursula {

enum class ErrorSource { model, integration, rounding, closure, amplification, unexplained };

/// "model", "integration", …
const char* name(ErrorSource source);

/// What one source contributes to the replay's error in position, measured.
struct ErrorShare {
  Vector3d error = Vector3d::Zero();  ///< m, in B
  double uncertainty = 0;             ///< m
};

/// The sizes of the shares at one instant, all in m; NaN where a replay did not get there.
struct ErrorsAt {
  double t = 0;  ///< s
  double observed = 0, rounding = 0, integration = 0, closure = 0, model = 0, unexplained = 0;
  double limit = 0;  ///< of the judged replay
};

/// What moved the replay off the path, at the instant where it was furthest off among the windows' ends. The shares are
/// differences of one replay and the next in the row
///   the judged replay → the loops' gaps projected away after each step → the same in other changes of frame, their
///   mean → an exact integration → the torques' pointwise errors taken off → the commanded path,
/// so that they add up to the observed error but for what is unexplained.
struct ErrorBudget {
  double t = 0;                          ///< s
  Vector3d observed = Vector3d::Zero();  ///< m, in B
  ErrorShare model;                      ///< pointwise errors of the acceleration, carried by the variational equations
  double model_rounding = 0;             ///< m; of the residuals alone, carried alike
  ErrorShare integration;                ///< from what a hundredfold tolerance changes
  ErrorShare rounding;                   ///< from what turned, relabelled and rescaled frames change
  ErrorShare closure;                    ///< from what projecting the gaps away changes
  double amplification = 0;              ///< by which a deviation at the window's start grows: no error of its own
  ErrorSource dominant = ErrorSource::unexplained;
  bool measured = false;        ///< false where there was no replay to take apart
  std::vector<ErrorsAt> along;  ///< the same from the window's start to t, to be drawn

  Vector3d unexplained() const;
  /// Of the sum of the shares, m.
  double uncertainty() const;
};

/// Replays the window once more in several ways. `windows` are the judged replays under `torques`; `plan` what they
/// were made by.
ErrorBudget attribute(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                      const std::vector<WindowedReplay>& windows, const Amplification& amplification,
                      const ReplayPlan& plan);
/// The same; empty where there is nothing to take apart, or the scenario's time is up: it decides nothing.
ErrorBudget attributeInTime(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                            const std::vector<WindowedReplay>& windows, const Amplification* amplification,
                            const ReplayPlan& plan);

/// The findings, and `along` as a curve. Where a replay's limit, not an error, is what prevents a judgement,
/// amplification dominates.
void addBudget(const ErrorBudget& budget, ValidationResult& result, const Units& units = {});

}  // namespace ursula

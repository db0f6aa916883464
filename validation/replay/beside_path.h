#pragma once

#include <functional>
#include <string>

#include "model/scenario.h"
#include "validation/limits/amplification.h"
#include "validation/limits/growth.h"
#include "validation/replay/lazily.h"
#include "validation/replay/replay.h"

namespace ursula {

/// Where replays from beside the path end: [δp; L δϑ] of the platform there.
struct EndsBeside {
  double size = 0;        ///< of a whole deviation, m
  Vector6d on_path;       ///< from the commanded state itself
  Vector6d above, below;  ///< from half a deviation beside it either way
  Vector6d whole_apart;   ///< between the two from a whole one, at a hundredth of the tolerance
  std::string gave_up;    ///< why there are none
};

/// What Simbody's loop, put off the path, makes of it under the right torques until deviations have grown well. Of the
/// scenario alone, the size of the deviations included: it comes from the right solver's equations, whoever is on
/// trial.
class BesidePath {
 public:
  using Vector12 = Amplification::Vector12;

  /// `torques` are the right ones, `acceleration_rounding` what rounding may make of the platform's acceleration at t,
  /// `tolerance` that of the coarser replays. Keeps references to all but the last.
  BesidePath(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, const Amplification& amplification,
             const std::function<double(double)>& acceleration_rounding, double tolerance);

  double end() const { return end_; }            ///< of the replays, s
  double size() const { return size_; }          ///< of the deviation, m
  double rounding() const { return rounding_; }  ///< what rounding makes of the end, over size()
  Vector12 direction() const;                    ///< of the deviation, [δp; L δϑ; δṗ; L δω], of length 1

  /// Of the right solver until end().
  const Growth& right() const { return right_; }
  /// Of other direct dynamics, over the same intervals.
  Growth growthOf(const AccelerationUnder& accelerations) const;

  /// Replayed when first asked for.
  const EndsBeside& ends() const;
  /// The same for a tenth of the deviation, so that less of it is not linear, and with more stops, also where the right
  /// solver's equations change fast: a step may pass over a joint that turns about, at any tolerance.
  const EndsBeside& endsWithStops() const;

 private:
  EndsBeside replayed(const std::vector<double>& stops, double size) const;

  const Scenario& scenario_;
  const SimbodyLoop::TorqueHistory& torques_;
  double tolerance_, length_, end_;
  bool stiff_;
  int intervals_;
  Growth right_;
  double size_, rounding_;
  Lazily<EndsBeside> ends_, ends_with_stops_;
};

}  // namespace ursula

#pragma once

#include <functional>
#include <vector>

#include "model/scenario.h"
#include "validation/pointwise.h"
#include "validation/result.h"
#include "validation/torque_file.h"

namespace ursula {

/// Somebody else's torques at their own instants, with what each may be off by.
struct ExternalTorques {
  TorqueFile file;                       ///< every instant within the motion
  std::vector<Vector6d> noc;             ///< of the NOC, N·m
  std::vector<Vector6d> precision;       ///< of the numbers printed: the torque's, and the instant's times τ̇, N·m
  std::vector<PointwiseSample> samples;  ///< against Simbody, with `precision` in the limits
  std::vector<Deviation> against_noc;    ///< N·m

  /// The largest entry of `precision`, N·m.
  double largestPrecision() const;
};

/// Pointwise at the file's own instants: there is nothing to interpolate.
ExternalTorques runExternal(const Scenario& scenario, const TorqueFile& file);

/// `torque.pointwise`, `acceleration.pointwise`, `torque.against_noc`.
std::vector<Check> judgeExternal(const ExternalTorques& torques, const Units& units = {});

}  // namespace ursula

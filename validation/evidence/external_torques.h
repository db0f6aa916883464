#pragma once

#include <string>
#include <vector>

#include "base/scalar.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/frame_change.h"
#include "validation/subject/torque_file.h"

namespace ursula {

/// External torques at their own instants, with what each may be off by.
struct ExternalTorques {
  TorqueFile file;                       ///< every instant within the motion
  std::vector<Vector6d> noc;             ///< of the NOC, N·m
  std::vector<Vector6d> precision;       ///< of the numbers printed: the torque's, and the instant's times τ̇, N·m
  std::vector<PointwiseSample> samples;  ///< against Simbody, with `precision` in the limits
  std::vector<Deviation> against_noc;    ///< N·m

  /// The largest entry of `precision`, N·m.
  double largestPrecision() const;
  /// What the numbers printed add to limits, for their basis.
  std::string precisionInWords(const Units& units) const;
};

}  // namespace ursula

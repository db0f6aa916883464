#pragma once

#include <string>
#include <vector>

#include "base/scalar.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/frame_change.h"
#include "validation/subject/torque_file.h"

namespace ursula {

/// External torques at their own instants, with the uncertainty of each.
struct ExternalTorques {
  TorqueFile file;            ///< every instant lies within the motion
  std::vector<Vector6d> noc;  ///< of the NOC, N·m
  std::vector<Vector6d>
      precision;  ///< uncertainty of the printed numbers: the torque's, and the instant's times τ̇, N·m
  std::vector<PointwiseSample> samples;  ///< against Simbody, with `precision` in the limits
  std::vector<Deviation> against_noc;    ///< N·m

  /// The largest entry of `precision`, N·m.
  double largestPrecision() const;
  /// The contribution of the printed digits to limits, in words.
  std::string precisionInWords(const Units& units) const;
};

}  // namespace ursula

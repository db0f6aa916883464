#pragma once

#include <vector>

#include "studies/identify/estimate.h"

namespace ursula::identification {

/// A machine's number and its estimate from the log.
struct NumberEstimate {
  MachineNumber number;
  double nominal = 0, value = 0;
  double tolerance = -1;    ///< the scenario's tolerance; negative for none
  double before = 0;        ///< prior standard uncertainty
  double deviation = 0;     ///< posterior standard uncertainty
  bool identified = false;  ///< whether the uncertainty is below a tenth of its own size
};

/// Estimates the likeliest machine that is physical. Masses are positive, some body can have the moments of inertia,
/// and friction resists. The prior is the scenario's numbers, within their tolerances if `by_tolerances`, otherwise
/// within their own size.
struct PhysicalEstimate {
  std::vector<NumberEstimate> numbers;
  ManipulatorParameters machine;
  Vector6d offsets = Vector6d::Zero();
};
PhysicalEstimate estimateMachine(const SquareRoot& model, const Comparison& comparison,
                                 const ManipulatorParameters& machine, const NumberTolerances& tolerances,
                                 bool by_tolerances);

}  // namespace ursula::identification

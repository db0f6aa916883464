#pragma once

#include <vector>

#include "studies/identify/estimate.h"

namespace ursula::identification {

/// A number of the machine as a log has it.
struct NumberEstimate {
  MachineNumber number;
  double nominal = 0, value = 0;
  double tolerance = -1;    ///< stated in the scenario; negative: none
  double before = 0;        ///< standard uncertainty that was assumed beforehand
  double deviation = 0;     ///< standard uncertainty afterwards
  bool identified = false;  ///< the motion says of it at least ten times what was assumed
};

/// The machine that has positive masses, moments of inertia that some body can have and friction that resists, and that
/// is the likeliest by the log, with the scenario's numbers as what is known beforehand: within their tolerances where
/// `by_tolerances`, else within their own size.
struct PhysicalEstimate {
  std::vector<NumberEstimate> numbers;
  ManipulatorParameters machine;
  Vector6d offsets = Vector6d::Zero();
};
PhysicalEstimate estimateMachine(const SquareRoot& model, const Comparison& comparison,
                                 const ManipulatorParameters& machine, const NumberTolerances& tolerances,
                                 bool by_tolerances);

}  // namespace ursula::identification

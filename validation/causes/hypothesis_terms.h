#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/scenario.h"

namespace ursula {

/// A part of the torques, or the difference that a wrong formula makes.
struct TorqueTerm {
  std::string name;
  std::vector<Vector6d> torques;     ///< N·m, one for each motion
  std::optional<double> fixed;       ///< known multiple in the residual; empty if it is to be fitted
  double size = 0;                   ///< size of the physical quantity, if known: gravity, m/s²
  std::string term = {}, body = {};  ///< names in the contract; empty if it has none
};

/// Gravity, inertia, velocity terms, friction and load as parts; formulas as printed or with omitted terms as
/// differences. The NOC computes them with changed parameters or motions. Terms that throw for this motion are skipped.
std::vector<TorqueTerm> torqueTerms(const Scenario& scenario, const std::vector<Motion<double>>& motions,
                                    const std::vector<Vector6d>& exact);

}  // namespace ursula

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/scenario.h"

namespace ursula {

/// A part of the torques, or the difference that a wrong formula makes to them.
struct TorqueTerm {
  std::string name;
  std::vector<Vector6d> torques;     ///< N·m, one for each motion
  std::optional<double> fixed;       ///< how often it must show in the residual; empty where that is to be found
  double size = 0;                   ///< of what makes it, where people know that: of gravity, m/s²
  std::string term = {}, body = {};  ///< by the contract; empty for what has no name there
};

/// Gravity, inertia, velocity terms, friction and load as parts; formulas as printed or with terms
/// dropped as differences. By the NOC with parameters or motions changed. Those that throw for this motion are left
/// out.
std::vector<TorqueTerm> torqueTerms(const Scenario& scenario, const std::vector<Motion<double>>& motions,
                                    const std::vector<Vector6d>& exact);

}  // namespace ursula

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/external/hypotheses.h"

namespace ursula {

/// What may have been different where torques were computed: another machine, another reading of the motion, a term
/// more. With one number x that is fitted, zero where nothing differs, or with none.
struct Cause {
  bool fitted = true;
  /// The torques, N·m. Throws std::invalid_argument or PoseError where there are none for this x.
  std::function<std::vector<Vector6d>(double x, const std::vector<Motion<double>>&)> torques;
  /// "platform mass 499.31 +- 0.02 kg instead of 500"; `deviation` is two standard deviations of x.
  std::function<std::string(double x, double deviation)> words;
  /// The torques' derivative by x at 0; empty where none is known but differences.
  std::function<std::vector<Vector6d>(const std::vector<Motion<double>>&)> slope = {};
  /// The same as `words`, typed; empty for what has no name in the contract.
  std::function<std::optional<NamedCause>(double x, double deviation)> named = {};
};

/// What a cause that is not fitted is called, in words and by the contract.
struct CauseName {
  std::string text;
  std::optional<NamedCause> named = {};
};

/// A cause without a number that is fitted; `torques` as above, x is 0.
Cause fixedCause(const CauseName& name,
                 std::function<std::vector<Vector6d>(const std::vector<Motion<double>>&)> torques);

/// Fits each cause to the residual: all of them to first order on a few instants, the likely ones there by
/// Gauss–Newton, and those that do best on all instants. Left out are those without effect, those that the motion does
/// not allow and those that have no fit. In the order of `causes`.
std::vector<Hypothesis> fitCauses(const std::vector<Cause>& causes, const TorqueResidual& data);

/// "499.31 +- 0.02", to the deviation's digits but at most ten.
std::string withDeviation(double value, double deviation);

}  // namespace ursula

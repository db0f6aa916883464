#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/verdict/result.h"

namespace ursula {

/// A possible difference in how torques were computed: another machine, another interpretation of the motion, an extra
/// term. It has one fitted number x, which is zero without a difference, or none.
struct Cause {
  bool fitted = true;
  /// The torques, N·m. Throws std::invalid_argument or PoseError if they do not exist for this x.
  std::function<std::vector<Vector6d>(double x, const std::vector<Motion<double>>&)> torques;
  /// "platform mass 499.31 +- 0.02 kg instead of 500"; `deviation` is two standard deviations of x.
  std::function<std::string(double x, double deviation)> words;
  /// The torques' derivative by x at 0; empty if only differences give it.
  std::function<std::vector<Vector6d>(const std::vector<Motion<double>>&)> slope = {};
  /// The same as `words`, typed; empty if the contract has no name for it.
  std::function<std::optional<NamedCause>(double x, double deviation)> named = {};
  /// Rounding of the torques of one motion, N·m; empty if it is that of the right ones.
  std::function<double(const Motion<double>&)> rounding = {};
  /// Whether a body can have the fitted number; empty if it can have every one.
  std::function<bool(double x)> is_possible = {};
  /// Where the fit may begin; other numbers than 0 are tried as they are.
  std::vector<double> starts = {0};
};

/// The name of a cause without a fitted number, in words and in the contract.
struct CauseName {
  std::string text;
  std::optional<NamedCause> named = {};
};

/// A cause without a fitted number; `torques` is as above with x = 0.
Cause fixedCause(const CauseName& name,
                 std::function<std::vector<Vector6d>(const std::vector<Motion<double>>&)> torques);

/// "499.31 +- 0.02", to the deviation's digits but at most ten.
std::string withDeviation(double value, double deviation);

}  // namespace ursula

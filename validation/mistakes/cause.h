#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/verdict/result.h"

namespace ursula {

/// The efforts that a solver gives for one motion, N·m or N. Throws PoseError if there are none.
using EffortsOf = std::function<Vector6d(const Motion<double>&)>;

/// A possible difference in how torques were computed: another machine, another interpretation of the motion, an extra
/// term. It has one fitted number x, which is zero without a difference, or none.
struct Cause {
  using Words = std::function<std::string(double x, double deviation)>;
  using Named = std::function<std::optional<NamedCause>(double x, double deviation)>;

  bool fitted = true;
  /// The solver with this x. Throws std::invalid_argument if there is none.
  std::function<EffortsOf(double x)> solver;
  /// "platform mass 499.31 +- 0.02 kg instead of 500"; `deviation` is two standard deviations of x.
  Words words;
  /// The same as `words`, typed; empty if the contract has no name for it.
  Named named = {};
  /// The torques' derivative by x at 0; empty if only differences give it.
  std::function<std::vector<Vector6d>(const std::vector<Motion<double>>&)> slope = {};
  /// Rounding of the torques of one motion, N·m; empty if it is that of the right ones.
  std::function<double(const Motion<double>&)> rounding = {};
  /// Whether a body can have the fitted number; empty if it can have every one.
  std::function<bool(double x)> is_possible = {};
  /// Where the fit may begin; other numbers than 0 are tried as they are.
  std::vector<double> starts = {0};

  /// The torques, N·m. Throws std::invalid_argument or PoseError if they do not exist for this x.
  std::vector<Vector6d> torques(double x, const std::vector<Motion<double>>& motions) const;
};

/// The name of a cause without a fitted number, in words and in the contract.
struct CauseName {
  std::string text;
  std::optional<NamedCause> named = {};

  explicit CauseName(std::string words) : text(std::move(words)) {}
  CauseName(std::string words, const NamedCause& typed) : text(std::move(words)), named(typed) {}
};

/// "499.31 +- 0.02", to the deviation's digits but at most ten.
std::string withDeviation(double value, double deviation);

}  // namespace ursula

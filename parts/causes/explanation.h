#pragma once

#include <optional>
#include <string>
#include <vector>

#include "parts/causes/hypotheses.h"
#include "validation/verdict/result.h"

namespace ursula {

/// The words about a cause, and its name.
struct Explanation {
  std::string text;
  std::optional<NamedCause> named = {};
  std::vector<NamedCause> others = {};
  CauseClaim claim = CauseClaim::likely;
  std::vector<NamedCause> together = {};  ///< two or three, of which `named` is the first
};

/// An explanation leaves at most these multiples of the limits everywhere (one for the given torques, one for the
/// cause's). The remainder must also be too small for chance.
constexpr double may_be_beyond = 2, may_be_chance = 0.1;

/// "99.0945 % of the deviation"
std::string percent(double explained);

/// A small remainder of the deviation may still be all that was answered, where few digits make wide limits.
bool explains(const Hypothesis& one);

/// Puts mass centres of either links before such of both if the others' make no difference.
void putNarrowerFirst(std::vector<Hypothesis>& best);

/// Returns the best hypotheses: all that explain everything, otherwise all near the smallest remainder. Those with
/// fewest fitted numbers come first, then the most plausible ones; a length comes after what has the same effect.
/// Numbers that no body can have are left out beside others.
std::vector<Hypothesis> bestOf(const std::vector<Hypothesis>& fitted);

/// Whether both are one mistake in other words.
bool isSameMistake(const Hypothesis& first, const Hypothesis& other);

/// "; as well explained by: …", of those after the first.
std::string othersText(const std::vector<Hypothesis>& best);

/// All of `best` explain everything. The first is named unless another needs as few numbers, or the motion is a single
/// pose. No cause is better than a wrong one.
Explanation named(const std::vector<Hypothesis>& best, const TorqueResidual& data, std::string text);

/// Explains the deviation by two or three mistakes at once; empty if none are certain. `left` are the multiples of the
/// limits that the best single mistake leaves.
Explanation severalMistakes(const Scenario& scenario, const TorqueResidual& data, double left);

/// Whether successive residuals are uncorrelated, but for outliers: their correlation is within three of its
/// deviations, and small. Few instants of a smooth deviation may be within the deviations alone.
bool isNoise(const TorqueResidual& data);

/// Says what is off, as in `result.cause_words`, in findings and at each check that fails; `off` is its short form.
void sayCause(const std::string& off, ValidationResult& result);

/// Names the state of a solver that answers the same question differently; it precedes every other cause.
void nameState(ValidationResult& result);

}  // namespace ursula

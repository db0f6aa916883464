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
};

/// Whether a cause is the length of a link.
bool isLength(const NamedCause& cause);

/// Puts mass centres of either links before such of both if the others' make no difference.
void putNarrowerFirst(std::vector<Hypothesis>& best);

/// All of `best` explain everything. The first is named unless another needs as few numbers, or the motion is a single
/// pose. No cause is better than a wrong one.
Explanation named(const std::vector<Hypothesis>& best, const TorqueResidual& data, std::string text);

/// Whether successive residuals are uncorrelated, but for outliers: their correlation is within three of its
/// deviations, and small. Few instants of a smooth deviation may be within the deviations alone.
bool isNoise(const TorqueResidual& data);

/// Names the state of a solver that answers the same question differently; it precedes every other cause.
void nameState(ValidationResult& result);

}  // namespace ursula

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/external/hypotheses.h"
#include "validation/verdict/likely_cause.h"

namespace ursula {

/// What is said of a cause, and by what name.
struct Explanation {
  std::string text;
  std::optional<NamedCause> named = {};
  std::vector<NamedCause> others = {};
};

/// `best` explain everything. The first is named where no other does so with as few numbers, and not of one pose, held
/// or repeated: silence is better than a wrong cause.
Explanation named(const std::vector<Hypothesis>& best, const TorqueResidual& data, std::string text);

/// A solver that answers the same question otherwise: whatever else its answers look like, that comes first.
void nameState(LikelyCause& likely);

}  // namespace ursula

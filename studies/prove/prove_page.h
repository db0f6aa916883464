#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "studies/prove/prove.h"

namespace ursula {

/// All that `ursula prove` found.
struct ProveFound {
  std::string scenario;
  std::optional<DefectProof> proof;  ///< none where only random scenarios were tried
  std::vector<Sensitivity> sensitivities;
  RandomOutcomes random;
  std::uint64_t seed = 0;  ///< of the first random scenario
};

/// Whether the right solver passes, every defect is caught, every check is needed and no random scenario fails.
bool isProved(const ProveFound& found);

/// A page of the report's looks: defects against checks, what each check is needed for, thresholds, random scenarios.
std::string proveHtml(const ProveFound& found);

}  // namespace ursula

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "studies/prove/prove.h"

namespace ursula {

/// All results of `ursula prove`.
struct ProveResult {
  std::string scenario;
  std::optional<DefectProof> proof;  ///< nullopt if only random scenarios were tried
  std::vector<Sensitivity> sensitivities;
  RandomOutcomes random;
  std::uint64_t seed = 0;  ///< seed of the first random scenario
};

/// Whether the right solver passes, every defect is caught, every check is needed and no random scenario fails.
bool isProved(const ProveResult& found);

/// Returns a page in the report's style: defects by checks, the need for each check, thresholds, random scenarios.
std::string proveHtml(const ProveResult& found);

}  // namespace ursula

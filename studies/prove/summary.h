#pragma once

#include <string>
#include <vector>

#include "studies/prove/prove.h"

namespace ursula {

/// Number of effective defects that too few formulations caught.
int weakDefects(const std::vector<DefectOutcome>& outcomes);

/// Whether the check catches a defect alone or first.
inline bool isNeeded(const CheckProof& proof) { return !proof.alone.empty() || !proof.first.empty(); }

/// Number of checks that are not needed, because earlier ones catch everything that they do.
int idleChecks(const std::vector<CheckProof>& checks);

/// Every check that caught anything, in the order of its first catch.
std::vector<std::string> catchingChecks(const std::vector<DefectOutcome>& outcomes);

/// The sensitivities of one kind of parameter.
struct SensitivityGroup {
  std::string name;
  int count = 0, unseen = 0;
  Sensitivity worst;          ///< the worst of those caught
  double smallest = 1;        ///< relative error that is caught
  double largest_change = 0;  ///< largest torque change, relative to the largest torque, at the smallest caught error
};
std::vector<SensitivityGroup> groupsOf(const std::vector<Sensitivity>& sensitivities);

}  // namespace ursula

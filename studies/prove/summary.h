#pragma once

#include <string>
#include <vector>

#include "studies/prove/prove.h"

namespace ursula {

/// Defects that show and were caught on fewer formulations than they must.
int weakDefects(const std::vector<DefectOutcome>& outcomes);

/// Whether it alone or first catches a defect.
inline bool isNeeded(const CheckProof& proof) { return !proof.alone.empty() || !proof.first.empty(); }

/// Checks that are not needed: they catch nothing that those before them do not.
int idleChecks(const std::vector<CheckProof>& checks);

/// Every check that caught anything, in the order of its first catch.
std::vector<std::string> catchingChecks(const std::vector<DefectOutcome>& outcomes);

/// The sensitivities of one kind of parameter.
struct SensitivityGroup {
  std::string name;
  int count = 0, unseen = 0;
  Sensitivity worst;          ///< that shows
  double smallest = 1;        ///< relative error that is caught
  double largest_change = 0;  ///< of torque, relative to the largest, that is caught at the smallest error
};
std::vector<SensitivityGroup> groupsOf(const std::vector<Sensitivity>& sensitivities);

}  // namespace ursula

#include "studies/prove/summary.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace ursula {

int weakDefects(const std::vector<DefectOutcome>& outcomes) {
  return static_cast<int>(std::count_if(outcomes.begin(), outcomes.end(), [](const DefectOutcome& outcome) {
    return outcome.shows && !outcome.caught();
  }));
}

int idleChecks(const std::vector<CheckProof>& checks) {
  return static_cast<int>(
      std::count_if(checks.begin(), checks.end(), [](const CheckProof& proof) { return !isNeeded(proof); }));
}

std::vector<std::string> catchingChecks(const std::vector<DefectOutcome>& outcomes) {
  std::vector<std::string> checks;
  for (const DefectOutcome& outcome : outcomes)
    for (const std::string& check : outcome.caught_by)
      if (std::find(checks.begin(), checks.end(), check) == checks.end()) checks.push_back(check);
  return checks;
}

std::vector<SensitivityGroup> groupsOf(const std::vector<Sensitivity>& sensitivities) {
  std::map<std::string, SensitivityGroup> groups;
  for (const Sensitivity& each : sensitivities) {
    SensitivityGroup& group = groups[each.group];
    group.name = each.group;
    ++group.count;
    if (std::isinf(each.smallest_caught)) {
      ++group.unseen;
      continue;
    }
    group.smallest = std::min(group.smallest, each.smallest_caught);
    group.largest_change = std::max(group.largest_change, each.torque_change);
    if (each.smallest_caught > group.worst.smallest_caught) group.worst = each;
  }
  std::vector<SensitivityGroup> out;
  for (const auto& [name, group] : groups) out.push_back(group);
  return out;
}

}  // namespace ursula

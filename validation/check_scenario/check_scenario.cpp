#include "validation/check_scenario/check_scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "model/scenario_files.h"

namespace ursula {

std::vector<std::string> warnings(const Scenario& scenario) {
  std::vector<Oddity> all = oddMachine(scenario);
  for (Oddity& oddity : oddMotion(scenario)) all.push_back(std::move(oddity));
  std::vector<std::string> lines;
  std::set<std::pair<std::string, std::string>> said;  // six inherited values give one warning
  for (const Oddity& oddity : all) {
    const KeyPlace place = placeInFile(scenario, oddity.key);
    if (place.given && !said.insert({place.place, oddity.subject}).second) continue;
    lines.push_back(fmt::format("{}: warning: {}: {}{}{}", place.place, place.key, oddity.what,
                                oddity.hint.empty() ? "" : ": ", oddity.hint));
  }
  return lines;
}

}  // namespace ursula

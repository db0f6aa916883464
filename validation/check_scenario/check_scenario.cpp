#include "validation/check_scenario/check_scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "model/scenario_files.h"

namespace ursula {

namespace {

/// Returns a line for each odd value; a value that legs inherit gives one line.
std::vector<std::string> linesOf(const Scenario& scenario, bool hints_alone) {
  std::vector<Oddity> all = oddMachine(scenario);
  for (Oddity& oddity : oddMotion(scenario)) all.push_back(std::move(oddity));
  std::vector<std::string> lines;
  std::set<std::string> said;  // by place, so that six inherited values give one warning
  for (const Oddity& oddity : all) {
    if (hints_alone && oddity.hint.empty()) continue;
    const KeyPlace place = placeInFile(scenario, oddity.key);
    if (place.given && !said.insert(place.place).second) continue;
    lines.push_back(fmt::format("{}: warning: {}: {}{}{}", place.place, place.key, oddity.what,
                                oddity.hint.empty() ? "" : ": ", oddity.hint));
  }
  return lines;
}

}  // namespace

std::vector<std::string> warnings(const Scenario& scenario) { return linesOf(scenario, false); }

std::vector<std::string> hints(const Scenario& scenario) { return linesOf(scenario, true); }

}  // namespace ursula

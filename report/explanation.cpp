#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "base/nearest.h"
#include "model/check_names.h"
#include "report/check_help.h"
#include "report/check_words.h"
#include "report/columns.h"

namespace ursula::report {
namespace {

/// Under a heading at the left.
std::string paragraph(const std::string& heading, const std::string& text) { return wrapped(heading, 18, text); }

const char* needsInWords(CheckNeeds needs) {
  switch (needs) {
    case CheckNeeds::load_history:
      return "a load that varies over time";
    case CheckNeeds::kinematics:
      return "a solver that gives kinematics, not torques alone";
    case CheckNeeds::any_instant:
      return "a solver that answers at any instant, not a file";
    case CheckNeeds::direct_dynamics:
      return "a solver of direct dynamics";
    case CheckNeeds::other_machines:
      return "a solver that can be made for another machine";
    case CheckNeeds::own_reactions:
      return "a solver that finds the reactions at the joints: the NOC";
    case CheckNeeds::own_complement:
      return "a solver that forms T of (32): the NOC";
    case CheckNeeds::further_engine:
      return "a build that has this formulation";
    case CheckNeeds::torque_file:
      return "torques that come from a file (--torques)";
    case CheckNeeds::nothing:
      break;
  }
  return "nothing beside the scenario";
}

std::string limitText(const CheckHelp& help) { return fmt::format("{}: {}", name(help.from), help.limit); }

}  // namespace

std::string explanation(const std::string& check) {
  const std::vector<CheckName>& known = checkNames();
  const auto found =
      std::find_if(known.begin(), known.end(), [&check](const CheckName& each) { return check == each.name; });
  if (found == known.end())
    throw std::invalid_argument(fmt::format("no check '{}'{}", check, didYouMean(check, namesOfChecks())));
  const CheckHelp help = checkHelp(check);
  const std::string unit = *found->unit == '\0' ? "a number" : fmt::format("in {}", found->unit);
  const std::string own = fmt::format(
      "[acceptance] \"{}\" = X in the scenario; where it is wider than the derived one, the result says so.", check);
  return fmt::format("{}: {}, {}\n\n{}{}{}{}{}", check, checkWords(check).title, unit, paragraph("proves", help.proves),
                     paragraph("limit", limitText(help)), paragraph("limit of yours", own),
                     paragraph("if it fails", help.on_failure), paragraph("needs", needsInWords(found->needs)));
}

std::string explanations() {
  std::string out;
  std::size_t width = 0;
  for (const CheckName& check : checkNames()) width = std::max(width, columnsOf(check.name));
  for (std::size_t k = 0; k < checkGroups().size(); ++k) {
    out += checkGroups()[k].title + "\n";
    for (const CheckName& check : checkNames())
      if (groupOf(check.name) == k)
        out += fmt::format("  {}  {}\n", padded(check.name, width), checkWords(check.name).meaning);
  }
  return out;
}

}  // namespace ursula::report

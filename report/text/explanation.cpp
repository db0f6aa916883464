#include "report/text/result_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "base/text.h"
#include "model/check_catalogue.h"
#include "report/text/quantity.h"
#include "report/text/text.h"

namespace ursula::report {
namespace {

/// A paragraph with its heading on the left.
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
    case CheckNeeds::model_file:
      return "a machine that a model file describes ([mechanism])";
    case CheckNeeds::nothing:
      break;
  }
  return "nothing beside the scenario";
}

std::string limitText(const CheckRow& row) { return fmt::format("{}: {}", name(row.from), row.limit); }

/// The nearest name, else all names of the group that was named.
std::string meant(const std::string& check) {
  const std::vector<std::string> all = namesOfChecks();
  if (const std::string nearest = didYouMean(check, all); !nearest.empty()) return nearest;
  std::string group;
  for (const std::string& name : all)
    if (name.rfind(check + ".", 0) == 0) group += (group.empty() ? "" : ", ") + name;
  return group.empty() ? "" : fmt::format(", did you mean one of {}?", group);
}

}  // namespace

std::string explanation(const std::string& check) {
  const CheckRow* row = checkRow(check);
  if (row == nullptr) throw std::invalid_argument(fmt::format("no check '{}'{}", check, meant(check)));
  const std::string unit = *row->unit == '\0' ? "a number" : "in " + prettyUnit(row->unit);
  const std::string own = fmt::format(
      "[acceptance] \"{}\" = X in the scenario; if it is wider than the derived one, the result says so.", check);
  return fmt::format("{}: {}, {}\n\n{}{}{}{}{}", check, row->title, unit, paragraph("proves", row->proves),
                     paragraph("limit", limitText(*row)), paragraph("limit of yours", own),
                     paragraph("if it fails", row->on_failure), paragraph("needs", needsInWords(row->needs)));
}

std::string explanations() {
  std::string out;
  std::size_t width = 0;
  for (const CheckRow& row : checkCatalogue()) width = std::max(width, columnsOf(row.name));
  for (std::size_t k = 0; k < checkGroups().size(); ++k) {
    out += checkGroups()[k] + "\n";
    for (const CheckRow& row : checkCatalogue())
      if (groupOf(row.name) == k) out += fmt::format("  {}  {}\n", padded(row.name, width), row.title);
  }
  return out;
}

std::string checksMarkdown() {
  std::string out =
      "# The checks\n\nThis page is made by `./dev docs` from the catalogue of checks (`model/check_catalogue.h`), as "
      "`ursula explain` is. How limits are\nderived, and by which formulas, is in [validation.md](validation.md).\n";
  for (std::size_t k = 0; k < checkGroups().size(); ++k) {
    out += fmt::format("\n## {}\n\n| check | proves | cannot see | limit | if it fails |\n", checkGroups()[k]);
    out += "| --- | --- | --- | --- | --- |\n";
    for (const CheckRow& row : checkCatalogue())
      if (groupOf(row.name) == k)
        out += fmt::format("| `{}` | {} | {} | {} | {} |\n", row.name, row.proves, row.cannot_see, limitText(row),
                           row.on_failure);
  }
  return out;
}

}  // namespace ursula::report

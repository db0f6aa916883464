#include "validation/checks/judges.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "model/check_catalogue.h"
#include "validation/checks/families.h"
#include "validation/limits/further_engines.h"

namespace ursula {
namespace {

/// Whether the core or a part of this build judges the check.
bool isJudged(const CheckRow& check) {
  const std::vector<CheckFamily>& families = checkFamilies();
  return std::any_of(families.begin(), families.end(), [&check](const CheckFamily& family) {
    return std::find(family.checks.begin(), family.checks.end(), check.name) != family.checks.end();
  });
}

/// Returns what scenario, subject or build lack for a check; empty if nothing.
std::string lacking(const CheckRow& check, const Scenario& scenario, const SubjectHas& has) {
  const auto unless = [](bool there, const std::string& why) { return there ? "" : why; };
  if (!isJudged(check)) return "no part of this build judges it; ./dev build adds all parts";
  if (check.needs == CheckNeeds::model_file) return "the scenario describes the machine itself";
  const bool of_files = check.needs == CheckNeeds::nothing || check.needs == CheckNeeds::torque_file;
  if (!has.any_instant && !of_files && check.needs != CheckNeeds::load_history)
    return "a file gives torques alone, at its own instants";
  switch (check.needs) {
    case CheckNeeds::load_history:
      return unless(scenario.load != nullptr, "there is no load");
    case CheckNeeds::kinematics:
      return unless(has.kinematics, "the subject gives no kinematics");
    case CheckNeeds::direct_dynamics:
      return unless(has.direct_dynamics, "the subject solves no direct dynamics");
    case CheckNeeds::other_machines:
      return unless(has.other_machines, "the subject cannot be made for another machine");
    case CheckNeeds::own_complement:
      return unless(has.complement, "the subject forms no T");
    case CheckNeeds::further_engine: {
      const EngineKind& engine = *furtherEngineOf(check.name);
      return unless(engine.available(), fmt::format("this build has no {}", engine.name));
    }
    case CheckNeeds::torque_file:
      return unless(!has.any_instant, "the torques do not come from a file");
    case CheckNeeds::model_file:
    case CheckNeeds::own_reactions:
    case CheckNeeds::nothing:
    case CheckNeeds::any_instant:
      break;
  }
  return "";
}

bool isLeftOut(const CheckRow& check, const SubjectHas& has) {
  const bool of_ladder = std::string_view(check.name).rfind("integration.", 0) == 0;
  return has.left_out_replays || (of_ladder && has.left_out_ladder) ||
         (check.needs == CheckNeeds::own_reactions && has.left_out_reactions);
}

/// Returns why a check does not apply; empty if it does.
std::string whyNot(const CheckRow& check, const Scenario& scenario, const SubjectHas& has) {
  const std::string why = lacking(check, scenario, has);
  return why.empty() && isLeftOut(check, has) ? "left out by the caller's options" : why;
}

Check notMadeBy(const CheckRow& check, const std::string& why, const std::string& out_of_time) {
  if (why.empty() && !out_of_time.empty())
    return notJudgeable(Reason::unfinished, check.name, std::nan(""), std::nan(""), check.unit, "", out_of_time);
  return notApplicable(check.name, check.unit, why.empty() ? "the subject has no answer" : why);
}

}  // namespace

void listEveryCheck(const Scenario& scenario, const SubjectHas& has, ValidationResult& result) {
  listEveryCheck([&](const CheckRow& check) { return whyNot(check, scenario, has); }, has.out_of_time, result);
}

void listEveryCheck(const std::function<std::string(const CheckRow&)>& why_not, const std::string& out_of_time,
                    ValidationResult& result) {
  for (const Check& check : result.checks)
    if (checkRow(check.name) == nullptr) throw std::logic_error(check.name + " has no row in the catalogue of checks");
  std::vector<Check> listed;
  for (const CheckRow& wanted : checkCatalogue()) {
    const auto found = std::find_if(result.checks.begin(), result.checks.end(),
                                    [&wanted](const Check& check) { return check.name == wanted.name; });
    listed.push_back(found != result.checks.end() ? std::move(*found)
                                                  : notMadeBy(wanted, why_not(wanted), out_of_time));
  }
  result.checks = std::move(listed);
}

}  // namespace ursula

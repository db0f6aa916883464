#include "parts/prove/prove.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "model/check_catalogue.h"
#include "report/page/html_template.h"
#include "report/page/page.h"
#include "report/page/sections.h"
#include "report/text/quantity.h"

namespace ursula {

extern const std::string_view prove_defects_html, prove_checks_html, prove_thresholds_html, prove_random_html;

namespace {

using report::HtmlValue, report::listOf, report::plainNumber, report::rendered;

Verdict verdictOf(const DefectOutcome& outcome) {
  if (!outcome.shows) return Verdict::not_applicable;
  return outcome.caught() ? Verdict::pass : Verdict::fail;
}

const char* wordOf(const DefectOutcome& outcome) {
  if (!outcome.refused.empty()) return "refused";
  if (!outcome.shows) return "no change";
  return outcome.caught() ? "caught" : "too few";
}

const char* signOf(const DefectOutcome& outcome) { return !outcome.shows ? "–" : outcome.caught() ? "✓" : "✗"; }

HtmlValue defectRow(const DefectOutcome& outcome) {
  std::vector<std::string> checks;
  for (const std::string& check : outcome.caught_by) checks.push_back(checkTitle(check));
  const std::vector<std::string> others(checks.begin() + (checks.empty() ? 0 : 1), checks.end());
  return {{"verdict", name(verdictOf(outcome))},
          {"sign", signOf(outcome)},
          {"word", wordOf(outcome)},
          {"defect", outcome.name},
          {"refused", outcome.refused},
          {"kind", outcome.group},
          {"caught", outcome.formulations()},
          {"wanted", outcome.formulations_wanted},
          {"first", checks.empty() ? "–" : checks.front()},
          {"more", others.empty() ? "" : std::to_string(others.size())},
          {"others", fmt::format("{}", fmt::join(others, ", "))}};
}

std::string defectsTable(const std::vector<DefectOutcome>& outcomes) {
  std::vector<HtmlValue> rows;
  for (const int wanted : {0, 1, 2})  // missed defects first, those without effect last
    for (const DefectOutcome& outcome : outcomes)
      if ((!outcome.shows ? 2 : outcome.caught() ? 1 : 0) == wanted) rows.push_back(defectRow(outcome));
  return rendered(prove_defects_html, {{"rows", rows}}) + "\n";
}

HtmlValue checkRowOf(const CheckProof& proof) {
  return {{"verdict", name(isNeeded(proof) ? Verdict::pass : Verdict::fail)},
          {"sign", isNeeded(proof) ? "✓" : "✗"},
          {"word", isNeeded(proof) ? "needed" : "idle"},
          {"title", checkTitle(proof.check)},
          {"check", proof.check},
          {"alone", proof.alone.size()},
          {"first", proof.first.size()},
          {"examples", caughtBy(proof, 4)}};
}

HtmlValue kindRow(const SensitivityGroup& group) {
  return {{"kind", group.name},
          {"count", group.count},
          {"unseen", group.unseen},
          {"best", plainNumber(group.smallest, 2)},
          {"worst", plainNumber(group.worst.smallest_caught, 2)},
          {"parameter", group.worst.parameter},
          {"change", plainNumber(group.largest_change, 2)}};
}

HtmlValue parameterRow(const Sensitivity& each) {
  const bool shows = !std::isinf(each.smallest_caught);
  return {{"parameter", each.parameter},
          {"caught", shows ? plainNumber(each.smallest_caught, 2) : "does not show"},
          {"change", shows ? plainNumber(each.torque_change, 2) : "–"}};
}

std::string thresholds(const std::vector<Sensitivity>& sensitivities) {
  if (sensitivities.empty()) return "";
  return rendered(prove_thresholds_html, {{"kinds", listOf(groupsOf(sensitivities), kindRow)},
                                          {"parameters", listOf(sensitivities, parameterRow)}});
}

std::string randomTable(const RandomOutcomes& random) {
  if (random.runs == 0) return "";
  const auto row = [](const auto& each) {
    return HtmlValue{{"title", checkTitle(each.first)}, {"check", each.first}, {"share", plainNumber(each.second, 2)}};
  };
  return rendered(prove_random_html, {{"remarks", !random.failed.empty() || !random.inconclusive.empty()},
                                      {"failed", random.failed},
                                      {"inconclusive", random.inconclusive},
                                      {"rows", listOf(random.largest_share, row)}}) +
         "\n";
}

std::string sentenceOf(const ProveResult& found) {
  if (!found.proof) return fmt::format("{} of {} random scenarios passed.", found.random.passed, found.random.runs);
  const DefectProof& proof = *found.proof;
  if (!proof.without_defect.empty())
    return fmt::format("Without a defect this fails: {}. Nothing is proved.", fmt::join(proof.without_defect, ", "));
  const auto shown = std::count_if(proof.outcomes.begin(), proof.outcomes.end(),
                                   [](const DefectOutcome& outcome) { return outcome.shows; });
  const int weak = weakDefects(proof.outcomes), idle = idleChecks(proof.checks);
  if (weak > 0) return fmt::format("{} of {} defects were caught on fewer formulations than they must.", weak, shown);
  if (idle > 0)
    return fmt::format("Every defect was caught, but {} of {} checks are not needed for it.", idle,
                       proof.checks.size());
  return fmt::format("Each of {} defects was caught, and each of {} checks is needed for that.", shown,
                     proof.checks.size());
}

std::vector<report::PageFigure> figuresOf(const ProveResult& found) {
  std::vector<report::PageFigure> figures;
  if (found.proof) {
    const auto& outcomes = found.proof->outcomes;
    const auto one = std::count_if(outcomes.begin(), outcomes.end(), [](const DefectOutcome& outcome) {
      return outcome.shows && outcome.formulations_wanted == 1;
    });
    const auto silent =
        std::count_if(outcomes.begin(), outcomes.end(), [](const DefectOutcome& each) { return !each.shows; });
    figures = {{"Defects", std::to_string(outcomes.size()), fmt::format("{} change nothing here", silent)},
               {"Seen by one formulation alone", std::to_string(one), "by their nature"},
               {"Checks", std::to_string(found.proof->checks.size()),
                fmt::format("{} idle", idleChecks(found.proof->checks))}};
  }
  if (found.random.runs > 0)
    figures.push_back({"Random valid scenarios", std::to_string(found.random.runs),
                       fmt::format("{} failed, {} inconclusive, seeds from {}", found.random.failed.size(),
                                   found.random.inconclusive.size(), found.seed)});
  return figures;
}

}  // namespace

bool isProved(const ProveResult& found) {
  if (!found.random.failed.empty()) return false;
  if (!found.proof) return true;
  const std::vector<DefectOutcome>& outcomes = found.proof->outcomes;
  // If some defects have no effect on a machine, their checks have nothing to catch.
  const bool all_show = std::all_of(outcomes.begin(), outcomes.end(), [](const DefectOutcome& o) { return o.shows; });
  const bool idle = all_show && idleChecks(found.proof->checks) > 0;
  return weakDefects(outcomes) == 0 && !idle && found.proof->without_defect.empty();
}

std::string proveHtml(const ProveResult& found) {
  report::Page page;
  page.kind = "Proof of the checks";
  page.title = found.proof ? found.scenario : "Random scenarios";
  page.verdict = isProved(found) ? Verdict::pass : Verdict::fail;
  page.sentence = sentenceOf(found);
  page.figures = figuresOf(found);
  if (found.proof)
    page.sections = {
        {"defects", "Defects", defectsTable(found.proof->outcomes)},
        {"checks", "Checks", rendered(prove_checks_html, {{"rows", listOf(found.proof->checks, checkRowOf)}}) + "\n"},
        {"thresholds", "Thresholds", thresholds(found.sensitivities)}};
  page.sections.push_back({"random", "Random valid scenarios", randomTable(found.random)});
  if (found.proof) page.script = report::index_script;
  return report::pageHtml(page);
}

}  // namespace ursula

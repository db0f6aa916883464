#include "studies/prove/prove.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/check_catalogue.h"
#include "report/page.h"
#include "report/quantity.h"
#include "report/sections.h"
#include "report/text.h"

namespace ursula {
namespace {

using report::escaped;
using report::plainNumber;

std::string region(const std::string& label, const std::string& table) {
  return fmt::format("<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"{}\">{}</div>\n", label, table);
}

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

/// A diamond for the first check that caught it, a tick for the others, so that colour is not essential.
std::string cell(const DefectOutcome& outcome, const std::string& check) {
  const auto hit = std::find(outcome.caught_by.begin(), outcome.caught_by.end(), check);
  if (hit == outcome.caught_by.end()) return "<td class=\"cell\"></td>";
  return hit == outcome.caught_by.begin() ? "<td class=\"cell hit first\">◆</td>" : "<td class=\"cell hit\">✓</td>";
}

std::string matrixRow(const DefectOutcome& outcome, const std::vector<std::string>& checks) {
  std::string cells;
  for (const std::string& check : checks) cells += cell(outcome, check);
  const std::string remark =
      outcome.refused.empty() ? "" : fmt::format(" <span class=\"aside\">{}</span>", escaped(outcome.refused));
  return fmt::format(
      "<tr class=\"scenario {0}\" data-verdict=\"{0}\"><td><span class=\"badge\"><span aria-hidden=\"true\">{1}</span> "
      "{2}</span></td><th scope=\"row\">{3}{4}</th><td>{5}</td><td class=\"number\" data-value=\"{6}\">{6} of {7}</td>"
      "{8}</tr>\n",
      name(verdictOf(outcome)), signOf(outcome), wordOf(outcome), escaped(outcome.name), remark, escaped(outcome.group),
      outcome.engines(), outcome.formulations_wanted, cells);
}

std::string matrix(const std::vector<DefectOutcome>& outcomes) {
  const std::vector<std::string> checks = catchingChecks(outcomes);
  std::string heads, rows;
  for (const std::string& check : checks)
    heads += fmt::format("<th scope=\"col\" class=\"upright\" title=\"{}\"><span>{}</span></th>", escaped(check),
                         escaped(checkTitle(check)));
  for (const int wanted : {0, 1, 2})  // missed defects first, those without effect last
    for (const DefectOutcome& outcome : outcomes)
      if ((!outcome.shows ? 2 : outcome.caught() ? 1 : 0) == wanted) rows += matrixRow(outcome, checks);
  return region(
      "Defects and the checks that catch them",
      fmt::format("<table class=\"suite matrix\">\n<caption>Each defect is put alone into a right validation. ✓ "
                  "a check that fails, as it should; ◆ the first of them in the result's order; empty: it does "
                  "not see the defect. Formulations: independent computations on which it was caught, of those that "
                  "must.</caption>\n<thead><tr><th scope=\"col\" class=\"sorts\">Outcome</th><th scope=\"col\" "
                  "class=\"sorts\">Defect</th><th scope=\"col\" class=\"sorts\">Kind</th><th scope=\"col\" "
                  "class=\"sorts number\">Formulations</th>{}</tr></thead>\n<tbody>\n{}</tbody></table>",
                  heads, rows));
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 4;
  std::string out;
  for (std::size_t k = 0; k < std::min(most, names.size()); ++k) out += (k > 0 ? "; " : "") + names[k];
  return names.size() > most ? out + fmt::format("; and {} more", names.size() - most) : out;
}

std::string checksTable(const std::vector<CheckProof>& checks) {
  std::string rows;
  for (const CheckProof& proof : checks) {
    const Verdict verdict = isNeeded(proof) ? Verdict::pass : Verdict::fail;
    rows += fmt::format(
        "<tr class=\"{}\"><td><span class=\"badge\"><span aria-hidden=\"true\">{}</span> {}</span></td><th "
        "scope=\"row\">"
        "{} <span class=\"aside\"><code>{}</code></span></th><td class=\"number\">{}</td><td "
        "class=\"number\">{}</td><td>"
        "{}</td></tr>\n",
        name(verdict), isNeeded(proof) ? "✓" : "✗", isNeeded(proof) ? "needed" : "idle",
        escaped(checkTitle(proof.check)), escaped(proof.check), proof.alone.size(), proof.first.size(),
        escaped(listed(proof.alone.empty() ? proof.first : proof.alone)));
  }
  return region(
      "Defects for which each check is needed",
      "<table>\n<caption>The defects that only this check catches, and those that it catches "
      "first.</caption>\n<thead><tr>"
      "<th scope=\"col\">Outcome</th><th scope=\"col\">Check</th><th scope=\"col\" class=\"number\">Alone</th>"
      "<th scope=\"col\" class=\"number\">First</th><th scope=\"col\">Such as</th></tr></thead>\n<tbody>\n" +
          rows + "</tbody></table>");
}

std::string thresholds(const std::vector<Sensitivity>& sensitivities) {
  if (sensitivities.empty()) return "";
  std::string kinds, parameters;
  for (const SensitivityGroup& group : groupsOf(sensitivities))
    kinds += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"number\">{}</td><td class=\"number\">{}</td><td "
        "class=\"number\">{}</td>"
        "<td class=\"number\">{}</td><td>{}</td><td class=\"number\">{}</td></tr>\n",
        escaped(group.name), group.count, group.unseen, plainNumber(group.smallest, 2),
        plainNumber(group.worst.smallest_caught, 2), escaped(group.worst.parameter),
        plainNumber(group.largest_change, 2));
  for (const Sensitivity& each : sensitivities) {
    const bool shows = !std::isinf(each.smallest_caught);
    parameters +=
        fmt::format("<tr><th scope=\"row\">{}</th><td class=\"number\">{}</td><td class=\"number\">{}</td></tr>\n",
                    escaped(each.parameter), shows ? plainNumber(each.smallest_caught, 2) : "does not show",
                    shows ? plainNumber(each.torque_change, 2) : "–");
  }
  const char* const number = "<th scope=\"col\" class=\"number\">";
  return region(
             "Thresholds by kind",
             fmt::format(
                 "<table>\n<caption>Smallest relative error of a parameter that torque.pointwise still "
                 "catches.</caption>\n<thead><tr><th scope=\"col\">Kind</th>{0}Parameters</th>{0}Not shown</th>"
                 "{0}Best</th>{0}WorstShare</th><th scope=\"col\">The worst</th>{0}Torque change caught, at most</th>"
                 "</tr></thead>\n<tbody>\n{1}</tbody></table>",
                 number, kinds)) +
         "<details><summary>Every parameter</summary>\n" +
         region("Thresholds by parameter",
                fmt::format(
                    "<table>\n<thead><tr><th scope=\"col\">Parameter</th>{0}Relative error caught</th>{0}Change of "
                    "torque over the largest</th></tr></thead>\n<tbody>\n{1}</tbody></table>",
                    number, parameters)) +
         "</details>";
}

std::string randomTable(const RandomOutcomes& random) {
  if (random.runs == 0) return "";
  std::string rows, items;
  for (const auto& [check, share] : random.largest_share)
    rows += fmt::format(
        "<tr><th scope=\"row\">{} <span class=\"aside\"><code>{}</code></span></th><td class=\"number\">{}</td></tr>\n",
        escaped(checkTitle(check)), escaped(check), plainNumber(share, 2));
  for (const std::string& why : random.failed) items += "<li>✗ false alarm: " + escaped(why) + "</li>\n";
  for (const std::string& why : random.inconclusive) items += "<li>? inconclusive: " + escaped(why) + "</li>\n";
  return (items.empty() ? "" : "<ul>\n" + items + "</ul>\n") +
         region("Random valid scenarios",
                "<table>\n<caption>The largest share of its limit that each check reached.</caption>\n<thead><tr><th "
                "scope=\"col\">Check</th><th scope=\"col\" class=\"number\">Share of its "
                "limit</th></tr></thead>\n<tbody>\n" +
                    rows + "</tbody></table>");
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
               {"ScenarioChange by one formulation alone", std::to_string(one), "by their nature"},
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
    page.sections = {{"defects", "Defects against checks", matrix(found.proof->outcomes)},
                     {"checks", "Checks", checksTable(found.proof->checks)},
                     {"thresholds", "Thresholds", thresholds(found.sensitivities)}};
  page.sections.push_back({"random", "Random valid scenarios", randomTable(found.random)});
  if (found.proof) page.script = report::index_script;
  return report::pageHtml(page);
}

}  // namespace ursula

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/page.h"
#include "report/text.h"
#include "studies/audit/audit.h"
#include "studies/audit/remarks.h"

namespace ursula {
namespace audit {
namespace {

using report::escaped;

std::ptrdiff_t countOf(const Audit& result, AuditRow::Kind kind) {
  return std::count_if(result.rows.begin(), result.rows.end(),
                       [kind](const AuditRow& row) { return row.kind == kind; });
}

const AuditRow* rowOf(const Audit& result, const std::string& equation) {
  const auto row = std::find_if(result.rows.begin(), result.rows.end(),
                                [&equation](const AuditRow& each) { return each.equation == equation; });
  return row == result.rows.end() ? nullptr : &*row;
}

/// The typeset formula, or the text if it is not a formula.
std::string formula(const std::string& text) {
  static const nlohmann::json mathml = nlohmann::json::parse(report::formulas_mathml);
  return mathml.contains(text) ? mathml[text].get<std::string>() : escaped(text);
}

std::string table(const std::string& caption, const std::vector<const char*>& heads, const std::string& rows) {
  if (rows.empty()) return "";
  std::string head;
  for (const char* each : heads) head += fmt::format("<th scope=\"col\">{}</th>", each);
  return fmt::format(
      "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"{0}\"><table class=\"formulas\">\n<caption>{0}"
      "</caption>\n<thead><tr>{1}</tr></thead>\n<tbody>\n{2}</tbody></table></div>",
      caption, head, rows);
}

std::string line(const std::string& head, const std::vector<std::string>& cells) {
  std::string out = fmt::format("<tr><th scope=\"row\">{}</th>", escaped(head));
  for (const std::string& cell : cells) out += "<td>" + cell + "</td>";
  return out + "</tr>\n";
}

// The badge has a sign and a word, so that it does not depend on colour.
const char* const fails_badge = "<span class=\"badge fail\"><span aria-hidden=\"true\">✗</span> ";
const char* const holds_badge = "<span class=\"badge pass\"><span aria-hidden=\"true\">✓</span> ";

std::string signedResidual(const char* badge, const std::string& text) { return badge + escaped(text) + "</span>"; }

/// Both versions, one below the other, each with its residual.
std::string pairOf(const AuditRow& row) {
  return fmt::format(
      "<tr><th scope=\"rowgroup\" rowspan=\"2\">{}</th><td>printed</td><td>{}</td><td>{}</td><td "
      "rowspan=\"2\">{}</td>"
      "</tr>\n<tr><td>holds</td><td>{}</td><td>{}</td></tr>\n",
      escaped(row.equation), formula(row.printed), signedResidual(fails_badge, residualOf(row.residual_printed, row)),
      escaped(row.note), formula(row.holds), signedResidual(holds_badge, number(row.residual_holds)));
}

std::string corrected(const Audit& result, AuditRow::Kind kind, const char* caption) {
  std::string rows;
  for (const AuditRow& row : result.rows)
    if (row.kind == kind) rows += pairOf(row);
  return table(caption, {"Equation", "Reading", "Formula", "Residual", "Note"}, rows);
}

std::string holding(const Audit& result) {
  std::string rows;
  for (const AuditRow& row : result.rows)
    if (row.kind == AuditRow::Kind::holds)
      rows +=
          line(row.equation, {formula(row.printed), signedResidual(holds_badge, residualOf(row.residual_printed, row)),
                              escaped(row.note)});
  return table("Formulas that hold as printed. Definitions are not measured by themselves.",
               {"Equation", "As printed", "Residual", "Note"}, rows);
}

std::string effectLine(const AuditRow& row, double duration) {
  const AuditEffect& effect = *row.effect;
  if (!effect.refused.empty()) return line(row.equation, {"none: " + escaped(effect.refused), "", "", "", ""});
  return line(row.equation, {number(effect.torque_error), number(effect.relative_error), instant(effect.to_1_mm),
                             instant(effect.to_10_mm), escaped(ending(effect, duration))});
}

std::string effects(const Audit& result) {
  std::string rows;
  for (const AuditRow& row : result.rows)
    if (row.effect) rows += effectLine(row, result.duration);
  for (const AuditRow& row : result.together) rows += effectLine(row, result.duration);
  return table("Each misreading alone, put into the whole algorithm; its torques replayed open loop on a Simbody model",
               {"Put into the algorithm", "Torque error, N·m", "Over the largest", "1 mm off after", "10 mm off after",
                "At the end"},
               rows);
}

std::string besides(const Audit& result) {
  std::string rows;
  for (const AuditRemark& remark : result.remarks)
    rows += line(remark.place, {escaped(remark.says), escaped(remark.found)});
  return table("Further statements of the text", {"Place", "Says", "Found"}, rows);
}

std::string method(const Audit& result) {
  std::string instants;
  for (const double t : result.instants) instants += fmt::format("{}{}", instants.empty() ? "" : ", ", t);
  return fmt::format(
      "<p>The reference does not use the paper's formulas. Points come from rigid motion and intersecting circles, "
      "rates "
      "from extrapolated central differences in 50-digit arithmetic, torques from virtual work. A residual is the "
      "largest component of a formula's mismatch with this reference, over the legs and t = {} s, with exact inputs. "
      "If a formula holds, some 1e-40 is left: the rounding of the differences.</p>\n<p>Our source is a scan: it does "
      "not tell whether an error is the paper's or the scan's. To reproduce: <code>ursula audit --out DIR</code></p>",
      instants);
}

}  // namespace
}  // namespace audit

std::string auditHtml(const Audit& result) {
  using audit::countOf, audit::number;
  report::Page page;
  page.kind = "Audit";
  page.title = "Audit of the paper's formulas";
  page.subtitle = fmt::format("{}, {:.6g} s", result.scenario, result.duration);
  page.sentence = fmt::format("{} readings fail, {} are plain misprints, {} hold as printed.",
                              countOf(result, AuditRow::Kind::fails), countOf(result, AuditRow::Kind::misprint),
                              countOf(result, AuditRow::Kind::holds));
  if (const AuditRow* torques = audit::rowOf(result, "(37)"))
    page.remarks = {fmt::format(
        "With the failing ones put right the method does what the paper says: its torques (37) agree with virtual work "
        "over differenced positions to {} of {} N·m.",
        number(torques->residual_printed), number(torques->size))};
  page.sections = {
      {"failing", "Formulas that do not hold as printed",
       audit::corrected(result, AuditRow::Kind::fails, "As printed, and the correct formula")},
      {"effects", "Effect of each on torques and motion", audit::effects(result)},
      {"misprints", "Misprints",
       audit::corrected(result, AuditRow::Kind::misprint,
                        "Dimensions or types do not match, or a symbol clearly belongs to another quantity")},
      {"holding", "Formulas that hold as printed", audit::holding(result)},
      {"besides", "Further statements of the text", audit::besides(result)},
      {"method", "Method", audit::method(result)}};
  page.footer = "<p>The same in numbers: <a href=\"audit.json\">audit.json</a>.</p>";
  return report::pageHtml(page);
}

}  // namespace ursula

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/page/html_template.h"
#include "report/page/page.h"
#include "report/page/sections.h"
#include "report/text/text.h"
#include "parts/audit/audit.h"
#include "parts/audit/remarks.h"

namespace ursula {

extern const std::string_view audit_formulas_html, audit_method_html;

namespace audit {
namespace {

using report::escaped, report::HtmlValue, report::listOf, report::rendered;

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

/// Cells are HTML.
HtmlValue line(const std::string& head, const std::vector<std::string>& cells) {
  return {{"head", head}, {"cells", cells}};
}

std::string table(const char* caption, const std::vector<std::string>& heads, const std::vector<HtmlValue>& lines,
                  const std::vector<HtmlValue>& pairs = {}) {
  if (lines.empty() && pairs.empty()) return "";
  return rendered(audit_formulas_html, {{"caption", caption}, {"heads", heads}, {"pairs", pairs}, {"lines", lines}});
}

/// Both versions, one below the other, each with its residual.
HtmlValue pairOf(const AuditRow& row) {
  return {{"equation", row.equation},
          {"printed", formula(row.printed)},
          {"residual_printed", report::badge(Verdict::fail, residualOf(row.residual_printed, row))},
          {"note", row.note},
          {"holds", formula(row.holds)},
          {"residual_holds", report::badge(Verdict::pass, number(row.residual_holds))}};
}

std::string corrected(const Audit& result, AuditRow::Kind kind, const char* caption) {
  std::vector<HtmlValue> pairs;
  for (const AuditRow& row : result.rows)
    if (row.kind == kind) pairs.push_back(pairOf(row));
  return table(caption, {"Equation", "Reading", "Formula", "Residual", "Note"}, {}, pairs);
}

std::string holding(const Audit& result) {
  std::vector<HtmlValue> lines;
  for (const AuditRow& row : result.rows)
    if (row.kind == AuditRow::Kind::holds)
      lines.push_back(
          line(row.equation, {formula(row.printed), report::badge(Verdict::pass, residualOf(row.residual_printed, row)),
                              escaped(row.note)}));
  return table("Formulas that hold as printed. Definitions are not measured by themselves.",
               {"Equation", "As printed", "Residual", "Note"}, lines);
}

HtmlValue effectLine(const AuditRow& row, double duration) {
  const AuditEffect& effect = *row.effect;
  if (!effect.refused.empty()) return line(row.equation, {"none: " + escaped(effect.refused), "", "", "", ""});
  return line(row.equation, {number(effect.torque_error), number(effect.relative_error), instant(effect.to_1_mm),
                             instant(effect.to_10_mm), escaped(ending(effect, duration))});
}

std::string effects(const Audit& result) {
  std::vector<HtmlValue> lines;
  for (const AuditRow& row : result.rows)
    if (row.effect) lines.push_back(effectLine(row, result.duration));
  for (const AuditRow& row : result.together) lines.push_back(effectLine(row, result.duration));
  return table("Each misreading alone, put into the whole algorithm; its torques replayed open loop on a Simbody model",
               {"Put into the algorithm", "Torque error, N·m", "Over the largest", "1 mm off after", "10 mm off after",
                "At the end"},
               lines);
}

std::string besides(const Audit& result) {
  const auto line_of = [](const AuditRemark& remark) {
    return line(remark.place, {escaped(remark.says), escaped(remark.found)});
  };
  return table("Further statements of the text", {"Place", "Says", "Found"}, listOf(result.remarks, line_of));
}

std::string method(const Audit& result) {
  return rendered(audit_method_html, {{"instants", fmt::format("{}", fmt::join(result.instants, ", "))}});
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
    page.remarks = {
        fmt::format("With the failing ones put right the method does what the paper says: its torques (37) agree with "
                    "virtual work over differenced positions to {} of {} N·m.",
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

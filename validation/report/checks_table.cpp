#include "validation/report/checks_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/report/report.h"
#include "validation/report/text.h"

namespace ursula::report {
namespace {

// Decades that the bars span, common to all so that they compare; the limit stands at 0.
struct Decades {
  double low = -3, high = 1;

  double percent(double share) const { return 100 * std::clamp((std::log10(share) - low) / (high - low), 0.0, 1.0); }
};

Decades decadesOf(const std::vector<Check>& checks) {
  Decades decades;
  for (const Check& check : checks) {
    const double share = limitShare(check);
    if (!std::isfinite(share) || share <= 0) continue;
    decades.low = std::max(std::min(decades.low, std::floor(std::log10(share))), -9.0);
    decades.high = std::min(std::max(decades.high, std::ceil(std::log10(share))), 9.0);
  }
  return decades;
}

std::string bar(const Check& check, const Decades& decades) {
  const double share = limitShare(check);
  if (std::isnan(share)) return "<span class=\"aside\">–</span>";
  const char* over = share > 1 ? " over" : "";
  return fmt::format(
      "<span class=\"bar{}\" aria-hidden=\"true\"><span style=\"width:{:.1f}%\"></span><i "
      "style=\"left:{:.1f}%\"></i></span>"
      "<span class=\"share\">{}</span>",
      over, share > 0 ? decades.percent(share) : 0.0, decades.percent(1), number(share));
}

std::string fact(const char* term, const std::string& text) {
  return text.empty() ? "" : fmt::format("<dt>{}</dt><dd>{}</dd>", term, escaped(text));
}

// Shortest digits that give the same doubles again.
std::string inFull(const Check& check) {
  if (std::isnan(check.value) && std::isnan(check.limit)) return "";
  return fmt::format("value {}, limit {}, unit {}", check.value, check.limit, check.unit.empty() ? "1" : check.unit);
}

std::string rows(const Check& check, std::size_t index, const Decades& decades) {
  return fmt::format(
      "<tr class=\"check {0}\" data-detail=\"detail-{1}\"><td>{2}</td><th scope=\"row\">{3}</th><td "
      "class=\"number\">{4}</td>"
      "<td class=\"number\">{5}</td><td>{6}</td><td class=\"margin\">{7}</td></tr>\n"
      "<tr class=\"detail\" id=\"detail-{1}\"><td></td><td colspan=\"5\"><dl>{8}{9}{10}</dl></td></tr>\n",
      name(check.verdict), index, verdictBadge(check.verdict), escaped(check.name), number(check.value),
      number(check.limit), escaped(check.unit), bar(check, decades), fact("Found", check.why),
      fact("Limit from", check.basis), fact("In full", inFull(check)));
}

int rank(Verdict verdict) {
  switch (verdict) {
    case Verdict::fail:
      return 0;
    case Verdict::inconclusive:
      return 1;
    case Verdict::pass:
      return 2;
    case Verdict::not_applicable:
      break;
  }
  return 3;
}

}  // namespace

std::string verdictBadge(Verdict verdict) {
  const char* sign = verdict == Verdict::pass             ? "✓"
                     : verdict == Verdict::fail           ? "✗"
                     : verdict == Verdict::not_applicable ? "–"
                                                          : "?";
  std::string word = name(verdict);
  for (char& c : word) c = c == '_' ? ' ' : static_cast<char>(c - 'a' + 'A');
  return fmt::format("<span class=\"badge {}\"><span aria-hidden=\"true\">{}</span> {}</span>", name(verdict), sign,
                     word);
}

std::string checksTable(const std::vector<Check>& checks) {
  if (checks.empty()) return "<p>No check was made.</p>";
  std::vector<Check> sorted = checks;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Check& a, const Check& b) { return rank(a.verdict) < rank(b.verdict); });
  const Decades decades = decadesOf(sorted);
  const std::ptrdiff_t applicable = judgedCount(sorted);
  const std::ptrdiff_t others = static_cast<std::ptrdiff_t>(sorted.size()) - applicable;
  std::string body;
  for (std::size_t i = 0; i < sorted.size(); ++i) body += rows(sorted[i], i, decades);
  return fmt::format(
      "<table class=\"checks\">\n<caption>{} check{}{}; a check passes if its value does not exceed its limit. Bars: "
      "value / limit"
      " on a logarithmic scale from 1e{:.0f} to 1e{:.0f}, the upright line is the limit.</caption>\n"
      "<thead><tr><th scope=\"col\">Verdict</th><th scope=\"col\">Check</th><th scope=\"col\" "
      "class=\"number\">Value</th>"
      "<th scope=\"col\" class=\"number\">Limit</th><th scope=\"col\">Unit</th><th scope=\"col\">Value / "
      "limit</th></tr></thead>\n"
      "<tbody>\n{}</tbody>\n</table>",
      applicable, applicable == 1 ? "" : "s", others > 0 ? fmt::format(", {} more that do not apply here", others) : "",
      decades.low, decades.high, body);
}

}  // namespace ursula::report

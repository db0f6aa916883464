#include "report/sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "model/check_catalogue.h"
#include "report/quantity.h"
#include "report/report.h"
#include "report/result_facts.h"
#include "report/text.h"

namespace ursula::report {
namespace {

// The decades of the bars, equal for all bars so that they are comparable; the limit is at 0.
struct Decades {
  double low = -3, high = 1;

  double percent(double share) const { return 100 * std::clamp((std::log10(share) - low) / (high - low), 0.0, 1.0); }
};

Decades decadesOf(const std::vector<Check>& checks) {
  Decades decades;
  for (const Check& check : checks) {
    const double share = limitShare(check);
    if (!std::isfinite(share) || share <= 0) continue;
    decades.low = std::max(std::min(decades.low, std::floor(std::log10(share))), -6.0);
    decades.high = std::min(std::max(decades.high, std::ceil(std::log10(share))), 12.0);
  }
  return decades;
}

std::string bar(const Check& check, const Decades& decades) {
  const double share = limitShare(check);
  if (std::isnan(share)) return "<span class=\"bar none\"></span>";
  return fmt::format(
      "<span class=\"bar{}\" aria-hidden=\"true\"><span style=\"width:{:.1f}%\"></span><i "
      "style=\"left:{:.1f}%\"></i></span>",
      share > 1 ? " over" : "", share > 0 ? decades.percent(share) : 0.0, decades.percent(1));
}

std::string entry(const char* term, const std::string& text) {
  return text.empty() ? "" : fmt::format("<dt>{}</dt><dd>{}</dd>", term, escaped(text));
}

// Uses the shortest digits that give the same doubles.
std::string inFull(const Check& check) {
  if (std::isnan(check.value) && std::isnan(check.limit)) return check.name;
  return fmt::format("{}: value {}, limit {}, unit {}", check.name, check.value, check.limit,
                     check.unit.empty() ? "1" : check.unit);
}

std::string valueOfLimit(const Check& check) {
  if (std::isnan(check.value) && std::isnan(check.limit)) return "no value";
  return fmt::format("{} <span class=\"aside\">of {}</span>", escaped(quantity(check.value, check.unit)),
                     escaped(quantity(check.limit, check.unit)));
}

const char* sign(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "✓";
    case Verdict::fail:
      return "✗";
    case Verdict::inconclusive:
      return "?";
    case Verdict::not_applicable:
      break;
  }
  return "–";
}

std::string word(Verdict verdict) {
  std::string out = name(verdict);
  std::replace(out.begin(), out.end(), '_', ' ');
  return out;
}

std::string item(const Check& check, const Decades& decades) {
  const CheckRow* row = checkRow(check.name);
  const bool open = check.verdict == Verdict::fail || check.verdict == Verdict::inconclusive;
  return fmt::format(
      "<details class=\"check {0}\"{1}><summary><span class=\"sign\"><span aria-hidden=\"true\">{2}</span>"
      "<span class=\"unseen\">{3}: </span></span><span class=\"what\">{4}</span>{5}<span class=\"numbers\">{6}</span>"
      "</summary><dl>{7}{8}{9}{10}</dl></details>\n",
      name(check.verdict), open ? " open" : "", sign(check.verdict), word(check.verdict),
      escaped(checkTitle(check.name)), bar(check, decades), valueOfLimit(check),
      entry("Means", row == nullptr ? "" : row->meaning), entry("Found", check.why),
      entry("Limit from", formulaInPrint(check.basis)), entry("In full", inFull(check)));
}

int severity(const std::vector<Check>& checks) {
  int worst = 0;
  for (const Check& check : checks)
    worst = std::max(worst, check.verdict == Verdict::fail ? 2 : check.verdict == Verdict::inconclusive ? 1 : 0);
  return worst;
}

std::string counts(const std::vector<Check>& checks) {
  const auto passed =
      std::count_if(checks.begin(), checks.end(), [](const Check& check) { return check.verdict == Verdict::pass; });
  std::string text = fmt::format("{} of {} passed", passed, checks.size());
  const Check* worst = worstCheck(checks);
  if (severity(checks) == 0 && worst != nullptr && std::isfinite(limitShare(*worst)))
    text += fmt::format(", the closest at {} of its limit", plainNumber(limitShare(*worst), 2));
  return text;
}

std::string group(const std::string& title, std::vector<Check> checks, const Decades& decades) {
  std::stable_sort(checks.begin(), checks.end(),
                   [](const Check& a, const Check& b) { return severity({a}) > severity({b}); });
  std::string items;
  for (const Check& check : checks) items += item(check, decades);
  const int worst = severity(checks);
  const Verdict verdict = worst == 2 ? Verdict::fail : worst == 1 ? Verdict::inconclusive : Verdict::pass;
  return fmt::format(
      "<details class=\"group {0}\"{1}><summary>{2} <span class=\"title\">{3}</span> <span class=\"aside\">{4}</span>"
      "</summary>\n{5}</details>\n",
      name(verdict), worst > 0 ? " open" : "", verdictBadge(verdict), escaped(title), counts(checks), items);
}

std::string notApplicable(const std::vector<Check>& checks) {
  std::map<std::string, std::string> names;  // keyed by reason
  std::size_t count = 0, reported = 0;
  for (const Check& check : checks) {
    if (check.verdict != Verdict::not_applicable) continue;
    const bool is_reported = check.reason == Reason::reported;
    std::string& of = names[is_reported ? "a tolerance is given: reported, not judged" : check.why];
    of += (of.empty() ? "" : ", ") + checkTitle(check.name);
    ++(is_reported ? reported : count);
  }
  if (count + reported == 0) return "";
  std::string items;
  for (const auto& [why, which] : names)
    items += fmt::format("<dt>since {}</dt><dd>{}</dd>", escaped(why), escaped(which));
  return fmt::format(
      "<details class=\"group not_applicable\"><summary>{} <span class=\"title\">{} more do not apply "
      "here{}</span></summary><dl>{}</dl></details>\n",
      verdictBadge(Verdict::not_applicable), count,
      reported == 0 ? "" : fmt::format(", {} are reported and not judged", reported), items);
}

}  // namespace

std::string verdictBadge(Verdict verdict) {
  std::string upper = word(verdict);
  for (char& c : upper) c = c == ' ' ? ' ' : static_cast<char>(c - 'a' + 'A');
  return fmt::format("<span class=\"badge {}\"><span aria-hidden=\"true\">{}</span> {}</span>", name(verdict),
                     sign(verdict), upper);
}

std::string checksList(const std::vector<Check>& all, const std::string& cause) {
  if (all.empty()) return "<p>No check was made.</p>";
  std::vector<Check> checks = all;
  for (Check& check : checks) check.why = withoutCause(cause, check.why);
  const Decades decades = decadesOf(checks);
  std::vector<std::vector<Check>> by_group(checkGroups().size() + 1);
  for (const Check& check : checks)
    if (check.verdict != Verdict::not_applicable) by_group[groupOf(check.name)].push_back(check);
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < by_group.size(); ++k)
    if (!by_group[k].empty()) order.push_back(k);
  std::stable_sort(order.begin(), order.end(),
                   [&by_group](std::size_t a, std::size_t b) { return severity(by_group[a]) > severity(by_group[b]); });
  std::string out;
  for (const std::size_t k : order)
    out += group(k < checkGroups().size() ? checkGroups()[k] : "Further checks", by_group[k], decades);
  return fmt::format(
      "<p class=\"aside\">Each bar is value / limit on a logarithmic scale from 10<sup>{:.0f}</sup> to "
      "10<sup>{:.0f}</sup>; the upright line is the limit. A check opens on a click.</p>\n{}{}",
      decades.low, decades.high, out, notApplicable(checks));
}

}  // namespace ursula::report

#include "report/page/sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "model/check_catalogue.h"
#include "report/files/report.h"
#include "report/page/html_template.h"
#include "report/text/mechanism_words.h"
#include "report/text/quantity.h"
#include "report/text/result_facts.h"
#include "report/text/text.h"

namespace ursula::report {

extern const std::string_view badge_html, checks_html;  // of web/

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

HtmlValue bar(const Check& check, const Decades& decades) {
  const double share = limitShare(check);
  if (std::isnan(share)) return false;
  return {{"over", share > 1},
          {"width", fmt::format("{:.1f}", share > 0 ? decades.percent(share) : 0.0)},
          {"mark", fmt::format("{:.1f}", decades.percent(1))}};
}

// Uses the shortest digits that give the same doubles.
std::string inFull(const Check& check) {
  if (std::isnan(check.value) && std::isnan(check.limit)) return check.name;
  return fmt::format("{}: value {}, limit {}, unit {}", check.name, check.value, check.limit,
                     check.unit.empty() ? "1" : prettyUnit(check.unit));
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

/// `repeated` checks are folded in a row of their own; `first` and `last` tell where it begins and ends.
struct Repeated {
  std::string first;
  bool any = false, last = false;
};

HtmlValue item(const Check& check, const Decades& decades, const std::string& kind, const Repeated& repeated) {
  const CheckWords words = checkWords(check.name, kind);
  const bool has_value = !std::isnan(check.value) || !std::isnan(check.limit);
  return {{"verdict", name(check.verdict)},
          {"open", !repeated.any && (check.verdict == Verdict::fail || check.verdict == Verdict::inconclusive)},
          {"repeated", repeated.first},
          {"repeated_end", repeated.last},
          {"sign", sign(check.verdict)},
          {"word", word(check.verdict)},
          {"title", words.title},
          {"bar", bar(check, decades)},
          {"value", has_value ? quantity(check.value, check.unit) : "no value"},
          {"limit", has_value ? quantity(check.limit, check.unit) : ""},
          {"means", words.proves},
          {"found", unbroken(check.why)},
          {"basis", unbroken(formulaInPrint(check.basis))},
          {"in_full", inFull(check)}};
}

int severity(const std::vector<Check>& checks) {
  int worst = 0;
  for (const Check& check : checks)
    worst = std::max(worst, check.verdict == Verdict::fail ? 2 : check.verdict == Verdict::inconclusive ? 1 : 0);
  return worst;
}

std::string counts(const std::vector<Check>& checks) {
  std::string text = fmt::format("{} of {} passed", countOf(checks, Verdict::pass), checks.size());
  const Check* worst = worstCheck(checks);
  if (severity(checks) == 0 && worst != nullptr && std::isfinite(limitShare(*worst)))
    text += fmt::format(", the closest at {} of its limit", plainNumber(limitShare(*worst), 2));
  return text;
}

/// The checks' rows; those that repeat the first are one.
std::vector<HtmlValue> items(std::vector<Check> checks, const Decades& decades, const std::string& kind) {
  const Check first = checks.front();
  const auto rest = std::stable_partition(checks.begin() + 1, checks.end(),
                                          [&first](const Check& check) { return repeats(check, first); });
  const auto count = static_cast<std::size_t>(rest - checks.begin()) - 1;
  std::string titles = fmt::format("{} more {} the same: ", count, count == 1 ? "finds" : "find");
  for (std::size_t k = 1; k <= count; ++k) titles += (k > 1 ? ", " : "") + checkWords(checks[k].name, kind).title;
  std::vector<HtmlValue> out;
  for (std::size_t k = 0; k < checks.size(); ++k) {
    const bool is_repeated = k >= 1 && k <= count;
    out.push_back(
        item(checks[k], decades, kind, {is_repeated && k == 1 ? titles : "", is_repeated, is_repeated && k == count}));
  }
  return out;
}

HtmlValue group(const std::string& title, std::vector<Check> checks, const Decades& decades, const std::string& kind) {
  std::stable_sort(checks.begin(), checks.end(),
                   [](const Check& a, const Check& b) { return severity({a}) > severity({b}); });
  const int worst = severity(checks);
  const Verdict verdict = worst == 2 ? Verdict::fail : worst == 1 ? Verdict::inconclusive : Verdict::pass;
  return {{"verdict", name(verdict)}, {"open", worst > 0},        {"badge", verdictBadge(verdict)},
          {"title", title},           {"counts", counts(checks)}, {"checks", items(checks, decades, kind)}};
}

HtmlValue notApplicable(const std::vector<Check>& checks, const std::string& kind) {
  std::map<std::string, std::string> names;  // keyed by reason
  std::size_t count = 0, reported = 0;
  for (const Check& check : checks) {
    if (check.verdict != Verdict::not_applicable) continue;
    const bool is_reported = check.reason == Reason::reported;
    std::string& of = names[is_reported ? "a tolerance is given: reported, not judged" : check.why];
    of += (of.empty() ? "" : ", ") + checkWords(check.name, kind).title;
    ++(is_reported ? reported : count);
  }
  if (count + reported == 0) return false;
  const auto reason = [](const auto& each) { return HtmlValue{{"why", each.first}, {"checks", each.second}}; };
  return {{"badge", verdictBadge(Verdict::not_applicable)},
          {"count", count},
          {"reported", reported == 0 ? "" : std::to_string(reported)},
          {"reasons", listOf(names, reason)}};
}

}  // namespace

std::string badge(Verdict verdict, const std::string& words) {
  return rendered(badge_html, {{"verdict", name(verdict)}, {"sign", sign(verdict)}, {"words", words}});
}

std::string verdictBadge(Verdict verdict) {
  std::string upper = word(verdict);
  for (char& c : upper) c = c == ' ' ? ' ' : static_cast<char>(c - 'a' + 'A');
  return badge(verdict, upper);
}

std::string checksList(const std::vector<Check>& checks, const std::string& kind) {
  if (checks.empty()) return "<p>No check was made.</p>";
  const Decades decades = decadesOf(checks);
  std::vector<std::vector<Check>> by_group(checkGroups().size() + 1);
  for (const Check& check : checks)
    if (check.verdict != Verdict::not_applicable) by_group[groupOf(check.name)].push_back(check);
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < by_group.size(); ++k)
    if (!by_group[k].empty()) order.push_back(k);
  std::stable_sort(order.begin(), order.end(),
                   [&by_group](std::size_t a, std::size_t b) { return severity(by_group[a]) > severity(by_group[b]); });
  const auto group_of = [&](std::size_t k) {
    return group(k < checkGroups().size() ? checkGroups()[k] : "Further checks", by_group[k], decades, kind);
  };
  return rendered(checks_html, {{"low", fmt::format("{:.0f}", decades.low)},
                                {"high", fmt::format("{:.0f}", decades.high)},
                                {"groups", listOf(order, group_of)},
                                {"not_applicable", notApplicable(checks, kind)}});
}

}  // namespace ursula::report

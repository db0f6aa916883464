#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "parts/causes/pursuit.h"

namespace ursula {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

Mistakes onlyOne(const Mistakes& of, std::size_t member) {
  return {{of.which[member]}, of.x.segment(static_cast<Index>(member), 1)};
}

/// Makes the uncertainty of a number, in type and words, that of one of several: `inflation` times as large, and at
/// least the part `shift` of what is wrong with it.
void addDoubt(double inflation, double shift, NamedAlone& named) {
  NamedCause& cause = named.cause;
  std::string& words = named.words;
  if (!cause.found) return;
  const double right = cause.expected.value_or(cause.kind == CauseKind::scale ? 1 : 0);
  const double own = cause.uncertainty.value_or(0),
               now = std::max(inflation * own, shift * std::abs(*cause.found - right));
  if (!(now > own)) return;
  cause.uncertainty = now;
  static const std::regex spread("[+]- [0-9.e+-]*[0-9]");
  const std::string text = fmt::format("+- {:.1g}", now);
  if (std::regex_search(words, spread))
    words = std::regex_replace(words, spread, text, std::regex_constants::format_first_only);
  else if (now > 1e-9 * std::abs(*cause.found))
    words += " (" + text + ")";
}

std::optional<SeveralNamed> nameSet(const Pursuit& pursuit, const Mistakes& mistakes, const VectorXd& residual,
                                    const EffortsTogether& together, const NameAlone& name) {
  std::vector<NamedAlone> members;
  const std::optional<VectorXd> all = pursuit.efforts(mistakes, together);
  const NumbersDoubt doubt = pursuit.doubt(mistakes);
  for (std::size_t i = 0; i < mistakes.which.size(); ++i) {
    const std::optional<VectorXd> one = pursuit.efforts(onlyOne(mistakes, i), together);
    if (!all || !one) return std::nullopt;
    const VectorXd effect = residual + (*one - *all);
    std::optional<NamedAlone> named = name(effect);
    if (!named) return std::nullopt;
    const auto at = static_cast<Index>(i);
    addDoubt(doubt.inflation(at), mistakes.x(at) == 0 ? 0 : doubt.shift(at) / std::abs(mistakes.x(at)), *named);
    named->cause.explained = std::clamp(residual.dot(effect) / residual.squaredNorm(), 0.0, 1.0);
    const auto& any = mistakes.any_body;
    if (std::find(any.begin(), any.end(), mistakes.which[i]) != any.end()) named->cause.body.clear();
    members.push_back(std::move(*named));
  }
  std::stable_sort(members.begin(), members.end(),
                   [](const auto& a, const auto& b) { return a.cause.explained > b.cause.explained; });
  SeveralNamed out{{}, members.size() == 2 ? "two mistakes together: " : "three mistakes together: "};
  for (const auto& [cause, words, ties, is_sure] : members) {
    const double percents = 100 * cause.explained;
    out.ties.insert(out.ties.end(), ties.begin(), ties.end());
    out.is_sure = out.is_sure && is_sure;
    out.words += (out.together.empty() ? "" : out.together.size() + 1 == members.size() ? ", and " : ", ") + words;
    out.words += percents < 0.1 ? " (less than 0.1 %)" : fmt::format(" ({:.3g} %)", percents);
    out.together.push_back(cause);
  }
  const auto order = std::find_if(out.together.begin(), out.together.end(),
                                  [](const NamedCause& one) { return one.kind == CauseKind::order; });
  for (NamedCause& one : out.together)  // whether a factor or an offset came before the order is unknown
    if (order != out.together.end() && one.motor > 0 &&
        order->legs[static_cast<std::size_t>(one.motor - 1)] != one.motor)
      one.motor = 0;
  return out;
}

}  // namespace

std::optional<SeveralNamed> nameEach(const Pursuit& pursuit, const std::vector<Mistakes>& sets,
                                     const VectorXd& residual, const EffortsTogether& together, const NameAlone& name) {
  constexpr std::size_t most_said = 3;
  if (sets.empty()) return std::nullopt;
  std::optional<SeveralNamed> out = nameSet(pursuit, sets.front(), residual, together, name);
  if (!out) return std::nullopt;
  out->is_sure = out->is_sure && sets.size() == 1;
  for (std::size_t i = 1; i < std::min(sets.size(), most_said); ++i) {
    const std::optional<SeveralNamed> other = nameSet(pursuit, sets[i], residual, together, name);
    if (!other) continue;
    const std::string words = other->words.substr(other->words.find(": ") + 2);
    out->words += (i == 1 ? "; as well explained by: " : "; ") + words;
    out->ties.insert(out->ties.end(), other->together.begin(), other->together.end());
  }
  if (sets.size() > most_said) out->words += fmt::format("; and {} more", sets.size() - most_said);
  return out;
}

}  // namespace ursula

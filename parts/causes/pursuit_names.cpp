#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "parts/causes/pursuit.h"

namespace ursula {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Makes the uncertainty of a number that of one of several: `inflation` times as large, and at least the part `shift`
/// of what is wrong with it. Returns the words with it.
std::string withDoubt(double inflation, double shift, NamedAlone& named) {
  NamedCause& cause = named.cause;
  if (!cause.found) return named.words(1);
  const double right = cause.expected.value_or(cause.kind == CauseKind::scale ? 1 : 0);
  const double own = cause.uncertainty.value_or(0),
               now = std::max(inflation * own, shift * std::abs(*cause.found - right));
  if (!(now > own)) return named.words(1);
  cause.uncertainty = now;
  const std::string words = named.words(own > 0 ? now / own : 1);
  const bool is_said = words != named.words(1) || now <= 1e-9 * std::abs(*cause.found);
  return is_said ? words : words + fmt::format(" (+- {:.1g})", now);
}

/// One of several mistakes, as it is named and said.
struct Member {
  NamedAlone named;
  std::string words;
  double along = 0;  ///< the deviation, for the order of those that explain nothing alone
};

/// The words do not say how many they are.
std::optional<SeveralNamed> nameSet(const Pursuit& pursuit, const Mistakes& mistakes, const VectorXd& residual,
                                    const EffortsTogether& together, const NameAlone& name) {
  std::vector<Member> members;
  const std::optional<VectorXd> all = pursuit.efforts(mistakes, together);
  const NumbersDoubt doubt = pursuit.doubt(mistakes);
  for (std::size_t i = 0; i < mistakes.which.size(); ++i) {
    const std::optional<VectorXd> one = pursuit.efforts(mistakes.only(i), together);
    if (!all || !one) return std::nullopt;
    const VectorXd effect = residual + (*one - *all);
    std::optional<NamedAlone> named = name(effect);
    if (!named) return std::nullopt;
    const auto at = static_cast<Index>(i);
    const double shift = mistakes.x(at) == 0 ? 0 : doubt.shift(at) / std::abs(mistakes.x(at));
    const std::string words = withDoubt(doubt.inflation(at), shift, *named) + named->others;
    named->cause.explained = std::max(0.0, 1 - (residual - effect).squaredNorm() / residual.squaredNorm());
    const auto& any = mistakes.any_body;
    if (std::find(any.begin(), any.end(), mistakes.which[i]) != any.end()) named->cause.body.clear();
    members.push_back({std::move(*named), words, residual.dot(effect)});
  }
  std::stable_sort(members.begin(), members.end(), [](const Member& a, const Member& b) {
    const double of_a = a.named.cause.explained, of_b = b.named.cause.explained;
    return of_a > of_b || (of_a == of_b && a.along > b.along);
  });
  SeveralNamed out;
  for (const Member& one : members) {
    const double percents = 100 * one.named.cause.explained;
    const auto& ties = one.named.ties;
    out.ties.insert(out.ties.end(), ties.begin(), ties.end());
    out.is_sure = out.is_sure && ties.empty();
    out.words += (out.together.empty() ? "" : out.together.size() + 1 == members.size() ? ", and " : ", ") + one.words;
    out.words += percents < 0.1       ? " (alone less than 0.1 %)"
                 : percents > 99.9999 ? " (alone more than 99.9999 %)"
                 : percents > 99      ? fmt::format(" (alone {:.4f} %)", percents)
                                      : fmt::format(" (alone {:.3g} %)", percents);
    out.together.push_back(one.named.cause);
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
  out->words = (out->together.size() == 2 ? "two mistakes together: " : "three mistakes together: ") + out->words;
  for (std::size_t i = 1; i < std::min(sets.size(), most_said); ++i) {
    const std::optional<SeveralNamed> other = nameSet(pursuit, sets[i], residual, together, name);
    if (!other) continue;
    out->words += (i == 1 ? "; as well explained by: " : "; ") + other->words;
    out->ties.insert(out->ties.end(), other->together.begin(), other->together.end());
  }
  if (sets.size() > most_said) out->words += fmt::format("; and {} more", sets.size() - most_said);
  return out;
}

}  // namespace ursula

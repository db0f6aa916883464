#include "parts/causes/explanation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>
#include <utility>

namespace ursula {
namespace {

constexpr std::size_t most_named = 4;

/// Whether the motion is one pose, held or repeated: too many causes can produce its six numbers.
bool isOnePose(const TorqueResidual& data) {
  return std::all_of(data.motions.begin(), data.motions.end(),
                     [&](const Motion<double>& each) { return sameState(each, data.motions.front()); });
}

/// Whether a cause is the length of a link.
bool isLength(const NamedCause& cause) {
  const std::string_view end = ".length", path = cause.parameter;
  return path.size() > end.size() && path.substr(path.size() - end.size()) == end;
}

/// Gravity's size and its component are one number. A missing term or a wrong sign is also a number that is 0 or
/// negated.
bool sayTheSame(const NamedCause& first, const NamedCause& other) {
  const bool one_term =
      first.kind == other.kind && first.term == other.term && first.leg == other.leg &&
      (!first.term.empty() || first.kind == CauseKind::reference_point || first.kind == CauseKind::jacobian);
  if (one_term && other.kind != CauseKind::parameter) return true;  // for other bodies that make no difference here
  const bool without_numbers =
      first.kind == CauseKind::parameter && other.kind == first.kind && !first.expected && !other.expected;
  if (without_numbers && first.parameter == other.parameter && first.leg == other.leg && first.body == other.body)
    return true;  // of one owner, in other words
  if (other.kind != CauseKind::parameter || !other.expected || !other.found) return false;
  const double expected = *other.expected, found = *other.found, little = 1e-3 * std::abs(expected);
  if (first.kind == CauseKind::missing_term) return std::abs(found) <= little;
  if (first.kind == CauseKind::sign) return std::abs(found + expected) <= little;
  return first.kind == CauseKind::parameter &&
         other.parameter.compare(0, first.parameter.size(), first.parameter) == 0 && !first.parameter.empty();
}

/// Whether a cause is a tie with a rarer one: a term left out with another mistake of the same term (weights across
/// rails, or at fixed joints), the mass centre of a rod that slides with its length, and an inertia about a fixed joint
/// with a doubled force of inertia.
bool isLikelier(const NamedCause& first, const NamedCause& other) {
  if (first.kind == CauseKind::reference_point && other.kind == CauseKind::scale && first.body == other.body)
    return true;
  if (isLength(other) && !isLength(first) && first.kind == other.kind && first.body == other.body) return true;
  const bool is_rare = other.kind == CauseKind::frame || other.kind == CauseKind::reference_point;
  return first.kind == CauseKind::missing_term && is_rare && first.term == other.term && first.body == other.body;
}

bool areEqual(const NamedCause& a, const NamedCause& b) {
  const auto fields = [](const NamedCause& of) {
    return std::tie(of.kind, of.term, of.body, of.leg, of.motor, of.parameter, of.legs, of.expected, of.found);
  };
  return fields(a) == fields(b);
}

/// Clears the body of a missing term if several bodies would do.
void clearSharedBody(const std::vector<Hypothesis>& best, NamedCause& named) {
  const std::string body = named.body;
  for (const Hypothesis& one : best) {
    if (!one.named || !sayTheSame(named, *one.named)) continue;
    if (named.kind == CauseKind::missing_term && one.named->kind == named.kind && one.named->body != body)
      named.body.clear();
  }
}

}  // namespace

void putNarrowerFirst(std::vector<Hypothesis>& best) {
  const std::optional<NamedCause> named = best.front().named;
  if (!named || named->kind != CauseKind::reference_point || named->body != "legs") return;
  const auto narrower = std::find_if(best.begin(), best.end(), [&](const Hypothesis& one) {
    return one.named && sayTheSame(*named, *one.named) &&
           (one.named->body == "proximal" || one.named->body == "distal");
  });
  if (narrower != best.end()) std::rotate(best.begin(), narrower, narrower + 1);
}

std::string percent(double explained) {
  if (explained > 1 - 1e-6) return "more than 99.9999 % of the deviation";
  return fmt::format("{:.4f} % of the deviation", 100 * std::max(0.0, explained));
}

bool explains(const Hypothesis& one) {
  return one.beyond <= may_be_beyond && one.unexplained <= may_be_chance &&
         (one.of_found <= may_be_chance || one.beyond <= 1);
}

std::vector<Hypothesis> bestOf(const std::vector<Hypothesis>& fitted) {
  const auto least = std::min_element(fitted.begin(), fitted.end(), [](const Hypothesis& a, const Hypothesis& b) {
    return a.unexplained < b.unexplained;
  });
  const bool any = std::any_of(fitted.begin(), fitted.end(), explains);
  std::vector<Hypothesis> out;
  for (const Hypothesis& one : fitted)
    if (any ? explains(one) : one.unexplained <= 2 * least->unexplained + 1e-9) out.push_back(one);
  const auto is_possible = [](const Hypothesis& one) { return one.is_possible; };
  if (std::any_of(out.begin(), out.end(), is_possible))
    out.erase(std::stable_partition(out.begin(), out.end(), is_possible), out.end());
  const auto order = [](const Hypothesis& one) {
    return std::pair(one.free_numbers, one.named && isLength(*one.named));
  };
  std::stable_sort(out.begin(), out.end(),
                   [&](const Hypothesis& a, const Hypothesis& b) { return order(a) < order(b); });
  while (out.back().free_numbers > std::max(1, out.front().free_numbers)) out.pop_back();
  putNarrowerFirst(out);
  return out;
}

bool isSameMistake(const Hypothesis& first, const Hypothesis& other) {
  if (!first.named || !other.named || first.named->term.empty()) return false;
  const NamedCause &a = *first.named, &b = *other.named;
  return a.kind == b.kind && a.term == b.term && a.body == b.body && a.leg == b.leg && a.parameter == b.parameter;
}

std::string othersText(const std::vector<Hypothesis>& best) {
  std::string out;
  std::size_t count = 1;
  for (std::size_t k = 1; k < best.size(); ++k) {
    if (isSameMistake(best.front(), best[k])) continue;
    if (count < most_named) out += (count == 1 ? "; as well explained by: " : "; ") + best[k].text;
    ++count;
  }
  if (count > most_named) out += fmt::format("; and {} more", count - most_named);
  return out;
}

Explanation named(const std::vector<Hypothesis>& best, const TorqueResidual& data, std::string text) {
  Explanation out{std::move(text)};
  if (isOnePose(data)) return out;
  const Hypothesis& first = best.front();
  bool is_alone = first.named.has_value();
  for (const Hypothesis& one : best) {
    if (&one != &first && first.named && one.named && sayTheSame(*first.named, *one.named)) continue;
    const bool is_rarer = first.named && one.named && isLikelier(*first.named, *one.named);
    if (&one != &first && one.free_numbers <= first.free_numbers && !is_rarer) is_alone = false;
    if (!one.named) continue;
    if (std::any_of(out.others.begin(), out.others.end(), [&](const auto& each) { return areEqual(each, *one.named); }))
      continue;
    out.others.push_back(*one.named);
    out.others.back().explained = 1 - one.unexplained * one.unexplained;
  }
  if (!is_alone) return out;
  out.named = out.others.front();
  out.others.erase(out.others.begin());
  clearSharedBody(best, *out.named);
  return out;
}

bool isNoise(const TorqueResidual& data) {
  constexpr double outlier = 3;  // medians: one-sided differences at the ends must not hide a pattern
  const std::size_t rows = data.residual.size();
  double along = 0, all = 0;
  for (int i = 0; i < motor_count && rows > 0; ++i) {
    std::vector<double> sizes, clipped;
    for (const Vector6d& row : data.residual) sizes.push_back(std::abs(row(i)));
    std::nth_element(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(rows / 2), sizes.end());
    const double most = outlier * sizes[rows / 2];
    for (const Vector6d& row : data.residual) clipped.push_back(std::clamp(row(i), -most, most));
    for (std::size_t k = 0; k < rows; ++k) {
      all += clipped[k] * clipped[k];
      if (k + 1 < rows) along += clipped[k] * clipped[k + 1];
    }
  }
  return rows >= 16 && std::abs(along / all) <= std::min(0.3, 3 / std::sqrt(static_cast<double>(rows)));
}

void sayCause(const std::string& off, ValidationResult& result) {
  const CauseWords& words = result.cause_words;
  result.findings.push_back({"torques that are off", words.off});
  result.findings.push_back({"likely cause", words.cause});
  const char* what = words.claim == CauseClaim::likely ? ". Likely cause: " : ": ";
  for (Check& check : result.checks)
    if (check.verdict == Verdict::fail) check.off = "Off: " + off + what + words.cause;
}

void nameState(ValidationResult& result) {
  const auto repeat = std::find_if(result.terms.begin(), result.terms.end(),
                                   [](const TermError& each) { return each.term == repeat_term; });
  if (repeat == result.terms.end() || !(repeat->error > 1e-12)) return;
  if (result.cause) result.causes.insert(result.causes.begin(), *result.cause);
  result.cause = NamedCause{CauseKind::state, "", "all"};
  result.causes_together.clear();
  result.cause_words.claim = CauseClaim::likely;
  result.cause_words.cause = fmt::format(
      "the solver answers the same question otherwise when it is asked again, by {:.2g} of the efforts; else: {}",
      repeat->error, result.cause_words.cause);
}

}  // namespace ursula

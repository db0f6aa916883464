#include <fmt/format.h>

#include <algorithm>

#include "parts/causes/explanation.h"
#include "parts/causes/mechanism_tried.h"

namespace ursula::mechanisms {
namespace {

/// Another explanation that leaves little more is as good.
constexpr double as_good = 6, may_be_digits = 0.01;
constexpr std::size_t most_listed = 4;

bool explainsAll(const Fitted& one, double beyond = may_be_beyond) {
  if (one.is_smooth || one.beyond > beyond || one.unexplained > may_be_chance) return false;
  if (one.of_found <= may_be_chance) return true;
  // The digits are nearly all that was answered: a fitted number must explain much more than they leave open.
  return one.beyond <= 1 && (one.numbers == 0 || one.unexplained <= may_be_digits);
}

/// "body.crank.inertia" of "body.crank.inertia.xx" and of itself; empty for numbers that are no entries.
std::string vectorOf(const NamedCause& cause) {
  const std::string owner = "body." + cause.body + ".";
  for (const char* key : {"inertia", "center_of_mass"})
    if (cause.parameter.rfind(owner + key, 0) == 0) return owner + key;
  return "";
}

/// Whether both are entries of one vector or tensor, of which this motion shows one number alone.
bool areOneVector(const NamedCause& a, const NamedCause& b) {
  return a.kind == CauseKind::parameter && b.kind == a.kind && !vectorOf(a).empty() && vectorOf(a) == vectorOf(b);
}

/// Whether both are a place of one joint on either body, or a body's length and a place of a joint on it.
bool areOnePlace(const NamedCause& a, const NamedCause& b) {
  const auto isOf = [](const NamedCause& each, const std::string& start) {
    return each.parameter.rfind(start, 0) == 0;
  };
  const auto isLength = [](const NamedCause& each) { return each.parameter == "body." + each.body + ".length"; };
  if (isLength(a) || isLength(b)) return a.body == b.body && a.unit == b.unit;
  return isOf(a, "joint." + a.joint + ".position") && isOf(b, "joint." + a.joint + ".position");
}

/// Whether both are one mistake: the same term, of one or of all where the others make no difference.
bool areOneMistake(const NamedCause& a, const NamedCause& b) {
  if (a.kind != b.kind || a.kind == CauseKind::parameter) return false;
  const auto isOne = [](const std::string& body) { return !body.empty() && body != "all"; };
  if (a.joint != b.joint && !a.joint.empty() && !b.joint.empty()) return false;
  if (a.body != b.body && isOne(a.body) && isOne(b.body)) return false;
  const auto of_velocities = [](const NamedCause& each) {
    return each.term == "coriolis" || each.term == "centripetal" || each.term == "gyroscopic";
  };
  if (a.kind == CauseKind::missing_term && of_velocities(a) && of_velocities(b))
    return a.term == b.term || a.body == b.body;
  if (a.kind == CauseKind::scale || a.kind == CauseKind::offset)
    return a.term == b.term && a.body == b.body && a.motor == b.motor;
  return a.term == b.term;
}

/// Whether a tie is with a rarer mistake: another density of the same body, or of all where nothing else acts.
bool isRarer(const NamedCause& first, const NamedCause& other) {
  const auto isOfAll = [](const NamedCause& each, const char* term) { return each.term == term && each.body == "all"; };
  if (first.kind != CauseKind::parameter && isOfAll(first, "") && isOfAll(other, "inertia")) return true;
  return first.kind == CauseKind::parameter && other.kind == CauseKind::scale && other.term == "inertia" &&
         first.body == other.body;
}

}  // namespace

NamedCause withShare(const Fitted& one) {
  NamedCause out = one.named;
  out.explained = std::clamp(1 - one.unexplained * one.unexplained, 0.0, 1.0);
  return out;
}

std::string percentOf(const Fitted& one) {
  const double explained = 1 - one.unexplained * one.unexplained;
  if (explained > 0.999999) return "more than 99.9999 % of the deviation";
  return fmt::format("{:.{}f} % of the deviation", 100 * std::max(0.0, explained), explained > 0.99 ? 4 : 0);
}

std::string othersIn(const std::vector<Fitted>& others) {
  std::string out;
  for (std::size_t i = 0; i < others.size() && i < most_listed; ++i)
    out += (i == 0 ? "; as well explained by: " : "; ") + inWords(others[i]);
  if (others.size() > most_listed) out += fmt::format("; and {} more", others.size() - most_listed);
  return out;
}

std::optional<Explained> explained(const std::vector<Fitted>& fitted) {
  const auto found = std::find_if(fitted.begin(), fitted.end(), [](const Fitted& one) { return explainsAll(one); });
  if (found == fitted.end()) return std::nullopt;
  Explained out{*found};
  Fitted& first = out.first;
  for (const Fitted& one : fitted) {
    if (&one == &*found || one.numbers > first.numbers || !explainsAll(one, as_good)) continue;
    if (isRarer(first.named, one.named)) continue;
    if (areOneVector(first.named, one.named)) {
      first.named.parameter = vectorOf(first.named);
      first.named.expected = first.named.found = first.named.uncertainty = std::nullopt;
      continue;
    }
    if (areOnePlace(first.named, one.named)) {
      if (one.named.body != first.named.body) first.named.body.clear();
      if (one.detail != first.detail) first.detail.clear();
      continue;
    }
    if (!areOneMistake(first.named, one.named)) {
      out.others.push_back(one);
      continue;
    }
    if (one.named.body != first.named.body) first.named.body.clear();
    if (one.named.joint != first.named.joint && one.named.body != "all") first.named.joint.clear();
    if (one.detail != first.detail) first.detail.clear();
    if (one.named.parameter != first.named.parameter) first.named.parameter.clear();
  }
  return out;
}

bool nameAll(const std::vector<Fitted>& fitted, ValidationResult& result) {
  const std::optional<Explained> found = explained(fitted);
  if (!found) return false;
  result.cause_words.claim = CauseClaim::likely;
  result.cause_words.cause =
      fmt::format("{}, which explains {}{}", inWords(found->first), percentOf(found->first), othersIn(found->others));
  if (found->others.empty()) {
    result.cause = withShare(found->first);
    return true;
  }
  result.causes.push_back(withShare(found->first));
  for (const Fitted& one : found->others) result.causes.push_back(withShare(one));
  return true;
}

}  // namespace ursula::mechanisms

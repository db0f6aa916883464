#include "validation/checks/acceptance.h"

#include <fmt/format.h>

#include <algorithm>

namespace ursula {

/// A limit decides only if there is a finished value to compare with.
void judgeByUser(double limit, const std::string& whose, Check& check) {
  const bool finished = check.reason == Reason::none || check.reason == Reason::limit_useless;
  if (!finished) {
    check.why += fmt::format("; {} allows {:.3g} {}, but there is no finished value to compare with it", whose, limit,
                             check.unit);
    return;
  }
  const bool wider = !(limit <= check.limit) || check.reason == Reason::limit_useless;
  const Largest largest = check.largest;
  const std::string where = largest.where.empty() ? "" : ", " + largest.where;
  check = judged(check.name, largest.value, limit, check.unit,
                 fmt::format("{}; derived: {:.3g}, {}", whose, check.limit, check.basis),
                 fmt::format("{}; the largest value, at t = {:.6g} s{}", check.why, largest.t, where));
  check.largest = largest;
  check.limit_by = wider ? LimitBy::user : LimitBy::derived;
}

void judgeByUser(const std::vector<AcceptanceLimit>& acceptance, ValidationResult& result) {
  for (const AcceptanceLimit& wanted : acceptance) {
    const auto found = std::find_if(result.checks.begin(), result.checks.end(),
                                    [&wanted](const Check& check) { return check.name == wanted.check; });
    if (found == result.checks.end())
      result.checks.push_back(notMade(wanted.check, "", "[acceptance] names a check that is none"));
    else if (found->verdict != Verdict::not_applicable)
      judgeByUser(wanted.limit, "[acceptance] of the scenario", *found);
  }
  for (const Check& check : result.checks)
    if (check.limit_by == LimitBy::user) result.limits = LimitBy::user;
  result.verdict = overall(result.checks);
}

}  // namespace ursula

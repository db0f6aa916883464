#pragma once

#include <string>
#include <vector>

#include "validation/verdict/result.h"

namespace ursula {

/// Returns "(none)" if there is no check of that name.
inline std::string verdictOf(const std::vector<Check>& checks, const std::string& check_name) {
  const Check* check = findCheck(checks, check_name);
  return check == nullptr ? "(none)" : name(check->verdict);
}

/// Returns the applicable checks without the verdict, with their numbers; a complaint if no check applies.
inline std::string others(const std::vector<Check>& checks, Verdict verdict) {
  std::string out;
  bool any = false;
  for (const Check& check : checks) any |= check.verdict != Verdict::not_applicable;
  if (!any) return "no check applies";
  for (const Check& check : checks)
    if (check.verdict != verdict && check.verdict != Verdict::not_applicable)
      out += check.name + " is " + name(check.verdict) + ": " + std::to_string(check.value) + " of " +
             std::to_string(check.limit) + ", " + check.why + "\n";
  return out;
}

inline std::string firstFailing(const std::vector<Check>& checks) {
  for (const Check& check : checks)
    if (check.verdict == Verdict::fail) return check.name;
  return "(none)";
}

}  // namespace ursula

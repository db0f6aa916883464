#pragma once

#include <string>

namespace ursula::report {

/// Where a check's limit comes from, unless the user gives one.
enum class LimitFrom {
  exact,     ///< equality, or what a theorem gives
  derived,   ///< rounding counted, errors carried along the motion
  measured,  ///< the same computation in other changes of frame, at other steps or tolerances
};

/// "exact", "derived" or "measured".
const char* name(LimitFrom from);

/// What `ursula explain` says of a check; all empty for one that is not known.
struct CheckHelp {
  std::string proves;
  LimitFrom from = LimitFrom::derived;
  std::string limit;       ///< where it comes from, in words
  std::string on_failure;  ///< what to do then
};
CheckHelp checkHelp(const std::string& check);

/// The page of one check, in lines of at most 100 columns. Throws std::invalid_argument for one that is not known, with
/// the nearest that is.
std::string explanation(const std::string& check);

/// Every check with its title, in groups.
std::string explanations();

}  // namespace ursula::report

#pragma once

#include <string>
#include <vector>

#include "validation/evidence/evidence.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Checks that are judged together, from one piece of the evidence.
struct CheckFamily {
  const char* id;                    ///< "formulations"
  std::vector<std::string> checks;   ///< rows of the catalogue that it judges; a test holds both lists together
  bool (*applies)(const Evidence&);  ///< the evidence has what they need
  std::vector<Check> (*judge)(const Evidence&);
  /// Where a check failed, before it is judged for good: experiments that a value beyond its limit asks for. Null where
  /// there is none, or the checks see to it themselves.
  void (*second_look)(Evidence&) = nullptr;
  bool in_si = false;  ///< judged on the scenario as given, not in its natural units
};

/// Every family; a check that is added is a function and a line here, and a row of checkCatalogue().
const std::vector<CheckFamily>& checkFamilies();

/// What was judged in natural units, in SI.
void checksInSi(const Units& units, std::vector<Check>& checks);

/// The checks of all families that apply, in SI, after the second looks that they ask for.
std::vector<Check> judgeAll(Evidence& evidence);

}  // namespace ursula

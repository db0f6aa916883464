#pragma once

#include <memory>
#include <string>
#include <vector>

#include "validation/evidence/evidence.h"
#include "validation/limits/motion_sizes.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Checks that are judged together from one part of the evidence.
struct CheckFamily {
  const char* id;                    ///< "formulations"
  std::vector<std::string> checks;   ///< rows of the catalogue that it judges; a test compares both lists
  bool (*applies)(const Evidence&);  ///< whether the evidence has what they need
  std::vector<Check> (*judge)(const Evidence&);
  /// Runs further experiments after a failure, before the final verdict. Null if there are none, or if the checks run
  /// them.
  void (*second_look)(Evidence&) = nullptr;
  bool in_si = false;  ///< judged on the given scenario instead of its natural units
  /// Makes at the samples what a part's family judges, as Evidence::witnessed[id]; null for the core's families.
  std::shared_ptr<const void> (*ask)(const Evidence&) = nullptr;
};

/// All families, of the core and of the parts in this build. A new check needs a function, an entry here and a row of
/// checkCatalogue().
const std::vector<CheckFamily>& checkFamilies();

/// The rows of the parts in this build. CMake writes the definition (cmake/parts.cmake), once for each program.
std::vector<CheckFamily> partFamilies();

/// What the families of parts ask at the samples.
std::vector<Witness> witnesses();

/// The sizes along the whole motion, for a subject or a file.
const MotionSizes& sizesOf(const Evidence& evidence);

/// Converts checks from natural units to SI.
void checksInSi(const Units& units, std::vector<Check>& checks);

/// Returns the checks of all families that apply, in SI, after their second looks.
std::vector<Check> judgeAll(Evidence& evidence);

}  // namespace ursula

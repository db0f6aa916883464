#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/subject/parameters.h"
#include "validation/verdict/likely_cause.h"

namespace ursula {

/// Parameters that are wrong together, by the same relative error: one alone, or the same of several links or legs.
struct TiedParameters {
  std::string words;  ///< "mass centre of the distal links"
  std::vector<Parameter> members;

  void disturb(ManipulatorParameters& machine, double relative) const;
  /// "mass centre of the distal links 0.65 +- 1e-05 m instead of 0.7"; where members differ, by which factor.
  std::string text(const ManipulatorParameters& machine, double relative, double deviation) const;
  /// The same typed. None for what no body can have, and where no one number of the scenario is the cause.
  std::optional<NamedCause> named(const ManipulatorParameters& machine, double relative, double deviation) const;
};

/// Those of all legs first, then both links of all legs, then both links of one leg, then each alone.
std::vector<TiedParameters> tiedParameters(const Manipulator& machine);

}  // namespace ursula

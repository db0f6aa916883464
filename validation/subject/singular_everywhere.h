#pragma once

#include <optional>
#include <string>

#include "model/scenario.h"

namespace ursula {

/// What some dozens of poses around the motion's start tell of a machine that is singular in each of them.
struct SingularEverywhere {
  int poses = 0;          ///< that were tried and that the legs can take
  double largest = 0;     ///< of J's smallest over its largest singular value, J with moments over the machine's length
  double similarity = 0;  ///< size of the platform over that of the base if they are similar hexagons, else 0

  /// "singular in every pose: similar hexagons at base and platform …; move the joints pairwise …"
  std::string words() const;
};

/// Returns nullopt if a pose is regular, or if the legs can take too few.
std::optional<SingularEverywhere> singularEverywhere(const Scenario& scenario);

}  // namespace ursula

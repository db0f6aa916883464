#pragma once

#include <functional>
#include <string>
#include <vector>

#include "validation/external/body_terms.h"
#include "validation/external/cause.h"

namespace ursula {

/// What a mistake adds to the efforts at one motion.
using EffortChange = std::function<Vector6d(const MachineTerms&)>;

/// Collects causes that add something to the NOC's efforts. The scenario outlives them.
class EffortCauses {
 public:
  explicit EffortCauses(const Scenario& scenario) : scenario_(scenario) {}

  void add(const std::string& text, const NamedCause& named, const EffortChange& change);

  std::vector<Cause> causes;

 private:
  const Scenario& scenario_;
};

/// Mistakes of a solver's own making, for every kind of leg: a term of one group of bodies left out or with the wrong
/// sign, tensors in other frames or about other points, the spin of links left out. `scenario` outlives them.
std::vector<Cause> termCauses(const Scenario& scenario);

/// A wrong Jacobian, loops left open or closed by least squares, J̇ left out. `scenario` outlives them.
std::vector<Cause> loopCauses(const Scenario& scenario);

}  // namespace ursula

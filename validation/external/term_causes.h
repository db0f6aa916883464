#pragma once

#include <functional>
#include <string>
#include <vector>

#include "validation/external/body_terms.h"
#include "validation/external/cause.h"

namespace ursula {

/// The efforts that a mistake adds for one motion.
using EffortChange = std::function<Vector6d(const MachineTerms&)>;

/// Collects causes that add something to the NOC's efforts. The scenario must outlive them.
class EffortCauses {
 public:
  explicit EffortCauses(const Scenario& scenario) : scenario_(scenario) {}

  void add(const std::string& text, const NamedCause& named, const EffortChange& change);

  std::vector<Cause> causes;

 private:
  const Scenario& scenario_;
};

/// Mistakes in a solver's own formulas, for every kind of leg. A term of a group of bodies is missing or has the wrong
/// sign; tensors use other frames or points; the links' spin is missing. `scenario` must outlive them.
std::vector<Cause> termCauses(const Scenario& scenario);

/// A wrong Jacobian, open loops or loops closed by least squares, missing J̇. `scenario` must outlive them.
std::vector<Cause> loopCauses(const Scenario& scenario);

}  // namespace ursula

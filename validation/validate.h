#pragma once

#include <functional>
#include <memory>

#include "base/deadline.h"
#include "model/scenario.h"
#include "validation/subject/subject.h"
#include "validation/verdict/result.h"

namespace ursula {

class Reference;
struct InjectedFault;

/// Parts to leave out for series of scenarios; `ursula validate` leaves out nothing.
struct ValidationOptions {
  bool ladder = true;     ///< integration.*
  bool reactions = true;  ///< reactions.pointwise
  bool budget = true;     ///< the sources of the error; they decide nothing
  /// The part that depends on the scenario alone, for many subjects on one scenario; null computes it here.
  std::shared_ptr<const Reference> reference = nullptr;
  std::shared_ptr<const InjectedFault> fault = nullptr;  ///< for negative controls; null falsifies nothing
  /// Receives the next step and the approximate share of time passed; may be empty.
  std::function<void(double share, const char* now)> progress = nullptr;
  int threads = 1;  ///< results do not depend on it
  /// Time limit from the call on, s; 0 means none. Unfinished parts are inconclusive (Reason::unfinished); no number
  /// depends on it otherwise. A given `reference` has its own limit.
  double time_limit = 0;
  /// Polled by any of the threads. Once it returns true, the limit counts as reached.
  std::function<bool()> asked_to_end = nullptr;
};

/// Validates one scenario: pointwise, replay, closure, energy, and the verdict. Deterministic: the same build on the
/// same machine gives the same bits. Throws PoseError or std::domain_error if the commanded motion is out of reach or
/// singular, so that nothing can be judged.
ValidationResult validate(const Scenario& scenario, const Subject& subject, const ValidationOptions& options = {});

/// The same with this program's NOC as the subject.
ValidationResult validate(const Scenario& scenario, const ValidationOptions& options = {});

/// The same with a subject created for the well-scaled scenario, whose positions are relative to an origin near the
/// machine.
ValidationResult validateMade(const Scenario& scenario, const SubjectOf& make, const ValidationOptions& options = {});

/// Throws OutOfTime after the deadline, as does any later request for a missing part.
std::shared_ptr<const Reference> makeReference(const Scenario& scenario, int threads = 1,
                                               const Deadline& deadline = {});

/// Estimates the time of validate() on this machine, s, from a few evaluations and their expected number.
double estimatedSeconds(const Scenario& scenario);

}  // namespace ursula

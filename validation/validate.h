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

/// What may be left out where many scenarios are judged in a row; `ursula validate` leaves out nothing.
struct ValidationOptions {
  bool ladder = true;     ///< integration.*
  bool reactions = true;  ///< reactions.pointwise
  bool budget = true;     ///< the error's sources, which decide nothing
  /// What depends on the scenario alone, made before, for many subjects on one scenario; null: made afresh.
  std::shared_ptr<const Reference> reference = nullptr;
  std::shared_ptr<const InjectedFault> fault = nullptr;  ///< for controls that must fail; null: nothing is falsified
  /// Told what begins, and about which share of the time is over by then; may be empty.
  std::function<void(double share, const char* now)> progress = nullptr;
  int threads = 1;  ///< no number depends on it
  /// From the call on, s; what is not reached by then is inconclusive (Reason::unfinished), and no number depends on it
  /// otherwise. 0: none. A `reference` made before has its own.
  double time_limit = 0;
  /// Asked again and again, by any of the threads: once it says so, and from then on, it is as if the limit was
  /// reached.
  std::function<bool()> asked_to_end = nullptr;
};

/// The whole validation of one scenario: pointwise, replay, closure, energy, and the verdict. Deterministic: the same
/// build on the same machine gives the same numbers to the last bit. Throws PoseError or std::domain_error where the
/// commanded motion itself is out of reach or singular: then there is nothing to judge.
ValidationResult validate(const Scenario& scenario, const Subject& subject, const ValidationOptions& options = {});

/// With the NOC of this program as the subject.
ValidationResult validate(const Scenario& scenario, const ValidationOptions& options = {});

/// With a subject that is made for the scenario where its numbers are good: positions from an origin near the machine.
ValidationResult validateMade(const Scenario& scenario, const SubjectOf& make, const ValidationOptions& options = {});

/// Once the deadline is over, it throws OutOfTime, and so does asking for what is not yet made.
std::shared_ptr<const Reference> makeReference(const Scenario& scenario, int threads = 1,
                                               const Deadline& deadline = {});

/// About how long validate() takes on this machine, s: from what a few evaluations take, and how many there will be.
double estimatedSeconds(const Scenario& scenario);

}  // namespace ursula

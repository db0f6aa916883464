#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "base/deadline.h"
#include "model/scenario.h"
#include "validation/subject/subject.h"
#include "validation/subject/torque_file.h"
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
  int threads = 1;        ///< results do not depend on it
  bool thorough = false;  ///< an outside solver is asked at every instant that an integrator wants
  bool quick = false;     ///< only what the samples show: no instant between them, no replay
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

/// Sets the user's tolerance. It takes precedence over the scenario's own, unless both its numbers are 0.
void setTolerance(const EffortTolerance& users, Scenario& scenario);
void setTolerance(const EffortTolerance& users, std::optional<EffortTolerance>& tolerance);

/// Throws OutOfTime after the deadline, as does any later request for a missing part.
std::shared_ptr<const Reference> makeReference(const Scenario& scenario, int threads = 1,
                                               const Deadline& deadline = {});

/// Estimates the time of validate() on this machine, s, from a few evaluations and their expected number.
double estimatedSeconds(const Scenario& scenario);

/// What else validateExternal() is told.
struct ExternalOptions {
  double time_limit = 0;
  std::function<bool()> asked_to_end = nullptr;
  int threads = 1;
  std::optional<JudgedSubject> about = std::nullopt;  ///< what made the torques, if no file or program gave them
  /// Further checks, in SI.
  std::function<std::vector<Check>()> more = nullptr;
  /// What made the torques, to be asked for its terms apart; works on the scenario as given. Null if it cannot be
  /// asked.
  const Subject* solver = nullptr;
  /// What the answers say by themselves, so that no cause is sought; empty if nothing. Asked after all else.
  std::function<std::string()> no_cause = nullptr;
};

/// Validates external torques: pointwise at their own instants, and by replay on a spline through them. The failed
/// checks' `off` and the findings describe their errors. Throws CsvError for instants outside the motion, and like
/// validate(). `time_limit`, `asked_to_end` and `threads` are those of ValidationOptions.
ValidationResult validateExternal(const Scenario& scenario, const TorqueFile& torques, double time_limit = 0,
                                  std::function<bool()> asked_to_end = nullptr, int threads = 1);
ValidationResult validateExternal(const Scenario& scenario, const TorqueFile& torques, const ExternalOptions& options);

/// The same from a file; throws CsvError like readTorqueFile.
ValidationResult validateExternal(const Scenario& scenario, const std::filesystem::path& torques_csv);

/// The part of validate() that needs no replay and little of Simbody: the commanded motion, and joint motion and
/// torques of the NOC and Simbody at the scenario's instants. Values are those of validate(); limits are derived
/// instead of measured, and so wider. Unless all pass, it makes all of validate()'s pointwise checks with their limits.
/// `of_motion` are earlier checks of the commanded motion; null makes them here. Throws like validate().
ValidationResult validatePointwise(const Scenario& scenario, const std::vector<Check>* of_motion = nullptr);

}  // namespace ursula

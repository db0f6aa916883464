#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "base/deadline.h"
#include "model/scenario.h"
#include "validation/evidence/background_tasks.h"
#include "validation/limits/amplification.h"
#include "validation/limits/rounding_profile.h"
#include "validation/replay/asked_torques.h"
#include "validation/replay/ladder.h"
#include "validation/replay/stabilised_replay.h"
#include "validation/replay/windows.h"
#include "validation/samples/engines.h"
#include "validation/samples/pointwise.h"
#include "validation/samples/simbody_samples.h"
#include "validation/subject/frame_change.h"

namespace ursula {

/// A value that the first requesting thread computes while others wait. If the computation throws, the next one tries.
template <class T>
class Lazy {
 public:
  template <class Make>
  const T& get(const Make& make) const {
    std::call_once(once_, [&] { value_.reset(new T(make())); });  // in place, so T need not be movable
    return *value_;
  }

 private:
  mutable std::once_flag once_;
  mutable std::unique_ptr<const T> value_;
};

/// Results of replays of the right torques, and the growth of deviations.
struct RightReplays {
  Amplification amplification;
  ReplayPlan plan;                      ///< with the right torques
  std::vector<WindowedReplay> windows;  ///< with their integration errors
};

/// The well-scaled scenario, which is the first step.
struct PreparedScenario {
  FrameChange natural;           ///< of the given scenario
  Scenario relocated;            ///< SI, positions from natural.origin
  Scenario scenario;             ///< in natural's units, for all experiments
  std::vector<double> instants;  ///< instants that are judged and written

  /// Throws like validate().
  explicit PreparedScenario(const Scenario& given);
};

/// The rounding of the scenario's formulations at its instants.
struct RoundingAlong {
  RoundingProfile profile;
  std::vector<Conditions> conditions;  ///< at the instants
  std::vector<Conditions> denser;      ///< at the telling instants too, if the instants do not show the motion
  double position_scale = 0;
  LoopForces forces;

  RoundingAlong(const PreparedScenario& of, const Deadline& deadline, const FormulationFaults& faults);
  /// Along the whole motion, for what is between the instants.
  const std::vector<Conditions>& along() const { return denser.empty() ? conditions : denser; }
};

/// The parts of a validation that depend on the scenario alone and not on the subject. The scenario is prepared first.
/// Each other part is made from it on first request, by the thread that requests it; background threads make long parts
/// in advance.
class Reference : public PreparedScenario {
 public:
  /// Uses that many threads, which changes no number. Throws like validate(). After the deadline, this or a request for
  /// a missing part throws OutOfTime.
  /// `faults` falsify it for negative controls. Without replays, it makes none in advance.
  explicit Reference(const Scenario& given, int threads = 1, const Deadline& deadline = {},
                     const FormulationFaults& faults = {}, bool with_replays = true);
  /// Ends what is under way, because nobody needs it any more.
  ~Reference();
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;

  /// Lets the background threads also make the parts for replays and, if asked, for direct dynamics and the ladder.
  void prepare(bool direct_dynamics, bool ladder) const;

  const Deadline deadline;  ///< of every experiment on the scenario
  const FormulationFaults faults;
  const Scenario in_simbody;  ///< with the machine of Simbody's loop at the samples

  /// Stops the background threads and removes the deadline.
  void stop() const;

  const RoundingAlong& rounding() const;
  const RightReplays& replays() const;
  const std::vector<double>& orders() const;                 ///< observedOrders() of the scenario
  const IntegrationError& closer(std::size_t window) const;  ///< closerLook() at one of the windows
  const std::vector<SimbodyAnswer>& simbody() const;         ///< at the instants
  const std::vector<EngineTorques>& engines() const;         ///< at the instants
  const std::vector<ReactionSample>& reactions() const;      ///< at the instants
  const std::vector<DirectSample>& direct() const;           ///< at some of the instants
  const Ladder& ladder() const;                              ///< of the first window
  const StabilisedReplay& stabilised() const;

 private:
  RightReplays rightReplays() const;

  Lazy<RoundingAlong> rounding_;
  Lazy<RightReplays> replays_;
  Lazy<std::vector<double>> orders_;
  Lazy<std::vector<SimbodyAnswer>> simbody_;
  Lazy<std::vector<EngineTorques>> engines_;
  Lazy<std::vector<ReactionSample>> reactions_;
  Lazy<std::vector<DirectSample>> direct_;
  Lazy<Ladder> ladder_;
  Lazy<StabilisedReplay> stabilised_;
  mutable std::mutex measuring_;
  mutable std::map<std::size_t, IntegrationError> closer_;
  mutable BackgroundTasks background_;
};

std::vector<Conditions> conditionsAt(const Scenario& scenario, const std::vector<double>& instants,
                                     const RoundingProfile& profile, const Deadline& deadline = {});

}  // namespace ursula

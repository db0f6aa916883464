#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "base/deadline.h"
#include "model/scenario.h"
#include "validation/evidence/background_tasks.h"
#include "validation/limits/amplification.h"
#include "validation/limits/rounding_profile.h"
#include "validation/replay/ladder.h"
#include "validation/replay/lazily.h"
#include "validation/replay/stabilised_replay.h"
#include "validation/replay/windows.h"
#include "validation/samples/direct_samples.h"
#include "validation/samples/engines.h"
#include "validation/samples/pointwise.h"
#include "validation/samples/reaction_samples.h"
#include "validation/subject/frame_change.h"

namespace ursula {

/// What replays of the right torques do, and how deviations grow.
struct RightReplays {
  Amplification amplification;
  ReplayPlan plan;                      ///< with the right torques
  std::vector<WindowedReplay> windows;  ///< with what their integration is off by
};

/// The first step: the scenario where its numbers are good.
struct PreparedScenario {
  FrameChange natural;           ///< of the scenario as given
  Scenario relocated;            ///< SI, positions from natural.origin
  Scenario scenario;             ///< in natural's units: what all experiments see
  std::vector<double> instants;  ///< that are judged and written

  /// Throws as validate() does. The scenario's motion throws OutOfTime once one of the deadlines is over.
  PreparedScenario(const Scenario& given, const Deadline& deadline, const Deadline& abandoned);
};

/// How the scenario's formulations round, at its instants.
struct RoundingAlong {
  RoundingProfile profile;
  std::vector<Conditions> conditions;  ///< at the instants
  double position_scale = 0;
  LoopForces forces;

  explicit RoundingAlong(const PreparedScenario& of);
};

/// What a validation needs of the scenario alone, whoever is on trial. The scenario is prepared first; all else is made
/// from that, each when first asked for, by whichever thread asks. Threads of its own make what takes long meanwhile.
class Reference : public PreparedScenario {
 public:
  /// On so many threads, which changes no number. Throws as validate() does. Once the deadline is over, what is not
  /// yet made throws OutOfTime when asked for, and so may this.
  explicit Reference(const Scenario& given, int threads = 1, const Deadline& deadline = {});
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;

  /// Lets the threads make also what a subject with these will be compared with.
  void prepare(bool direct_dynamics, bool ladder) const;

  /// Ends the threads and lifts the deadline.
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
  Reference(const Scenario& given, int threads, const Deadline& deadline,
            const std::shared_ptr<std::atomic<bool>>& abandoned);
  RightReplays rightReplays() const;

  Deadline deadline_;
  Lazily<RoundingAlong> rounding_;
  Lazily<RightReplays> replays_;
  Lazily<std::vector<double>> orders_;
  Lazily<std::vector<SimbodyAnswer>> simbody_;
  Lazily<std::vector<EngineTorques>> engines_;
  Lazily<std::vector<ReactionSample>> reactions_;
  Lazily<std::vector<DirectSample>> direct_;
  Lazily<Ladder> ladder_;
  Lazily<StabilisedReplay> stabilised_;
  mutable std::mutex measuring_;
  mutable std::map<std::size_t, IntegrationError> closer_;
  mutable BackgroundTasks background_;  ///< the last, as its tasks fill the others: they end before those do
};

std::vector<Conditions> conditionsAt(const Scenario& scenario, const std::vector<double>& instants,
                                     const RoundingProfile& profile);

}  // namespace ursula

#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "base/deadline.h"
#include "model/scenario.h"
#include "validation/evidence/ahead.h"
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

/// What a validation needs of the scenario alone, whoever is on trial: the scenario where its numbers are good, how its
/// formulations round, how deviations grow, and what replays of the right torques do.
struct Reference {
 private:  // made first: the helpers below fill it while the rest is made
  mutable std::mutex measuring_;
  mutable std::map<std::size_t, IntegrationError> closer_;
  Deadline deadline_;
  std::shared_ptr<std::atomic<bool>> abandoned_;  ///< then the scenario's motion throws OutOfTime, too
  Lazily<std::vector<double>> orders_;
  Lazily<std::vector<SimbodyAnswer>> simbody_;
  Lazily<std::vector<EngineTorques>> engines_;
  Lazily<std::vector<ReactionSample>> reactions_;
  Lazily<std::vector<DirectSample>> direct_;
  Lazily<RightReplays> replays_;
  Lazily<Ladder> ladder_;
  Lazily<StabilisedReplay> stabilised_;

 public:
  /// On so many threads, which changes no number. Throws as validate() does. Once the deadline is over, what is not
  /// yet made throws OutOfTime when asked for, and so may this.
  explicit Reference(const Scenario& given, int threads = 1, const Deadline& deadline = {});
  ~Reference();
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;

  FrameChange natural;           ///< of the scenario as given
  Scenario relocated;            ///< SI, positions from natural.origin
  Scenario scenario;             ///< in natural's units: what all experiments see
  std::vector<double> instants;  ///< that are judged and written

 private:
  mutable Ahead ahead_;  ///< before what its first tasks need not wait for

 public:
  RoundingProfile profile;
  std::vector<Conditions> conditions;  ///< at the instants
  double position_scale = 0;
  LoopForces forces;

  /// What will be asked for of these is made ahead, where there are threads for it.
  void prepare(bool direct_dynamics, bool ladder) const;

  /// Nothing is made ahead any more, and the deadline is lifted.
  void stop() const;

  /// Made with the rest, but where there is a deadline when first asked for: what needs no replay comes first.
  const RightReplays& replays() const;
  /// observedOrders() of the scenario, when first asked for.
  const std::vector<double>& orders() const;
  /// closerLook at one of the windows, when first asked for.
  const IntegrationError& closer(std::size_t window) const;

  // What the engines say of the scenario alone, and of the right torques: asked when first needed.
  const std::vector<SimbodyAnswer>& simbody() const;     ///< at the instants
  const std::vector<EngineTorques>& engines() const;     ///< at the instants
  const std::vector<ReactionSample>& reactions() const;  ///< at the instants
  const std::vector<DirectSample>& direct() const;       ///< at some of the instants
  const Ladder& ladder() const;                          ///< of the first window
  const StabilisedReplay& stabilised() const;

 private:
  RightReplays rightReplays() const;
};

std::vector<Conditions> conditionsAt(const Scenario& scenario, const std::vector<double>& instants,
                                     const RoundingProfile& profile);

}  // namespace ursula

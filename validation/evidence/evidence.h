#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/evidence/external_torques.h"
#include "validation/evidence/injected_fault.h"
#include "validation/evidence/reference.h"
#include "validation/replay/ladder.h"
#include "validation/replay/stabilised_replay.h"
#include "validation/replay/windows.h"
#include "validation/samples/complement_samples.h"
#include "validation/samples/engines.h"
#include "validation/samples/fast_samples.h"
#include "validation/samples/invariance_samples.h"
#include "validation/samples/pointwise.h"
#include "validation/samples/reaction_samples.h"
#include "validation/subject/frame_change.h"
#include "validation/subject/subject.h"

namespace ursula {

/// What a subject and its validation have beside torques.
struct SubjectHas {
  bool any_instant = true;  ///< torques at any instant, not those of a file alone
  bool kinematics = true, direct_dynamics = true, other_machines = true;
  bool left_out_ladder = false, left_out_reactions = false;  ///< by the caller's options
  std::string out_of_time;  ///< why not all experiments were made, of which those missing left nothing; else empty
};

/// What was computed for one subject on one scenario, in the scenario's natural units. Filled once, by experiments that
/// judge nothing; what an experiment did not make is empty.
struct Evidence {
  const Scenario* given = nullptr;               ///< in SI, as the caller has it
  FrameChange natural;                           ///< of `given`
  const Scenario* scenario = nullptr;            ///< in natural's units: what all experiments see
  const Subject* subject = nullptr;              ///< null for torques of a file
  const Reference* reference = nullptr;          ///< null for torques of a file
  const ExternalTorques* external = nullptr;     ///< null for a subject
  const Amplification* amplification = nullptr;  ///< null where nothing was to be replayed
  SubjectHas has;
  bool right = false;  ///< the subject is the right solver
  int threads = 1;     ///< on which it may be judged; the subject is then asked from several
  InjectedFault fault;

  std::vector<PointwiseSample> samples;
  std::vector<EngineSample> engines;
  std::vector<InvarianceSamples> invariances;
  std::vector<ReactionSample> own_reactions;  ///< where they are not the right solver's
  bool has_reactions = false;
  std::vector<ComplementSample> complement;
  FastSamples fast;
  ReplayPlan plan;  ///< under the torques on trial
  ReplayScales scales;
  std::vector<WindowedReplay> windows;
  Ladder ladder;
  std::optional<std::vector<double>> orders;
  std::optional<StabilisedReplay> stabilised;

  std::string spline;        ///< what the torques replayed may be off by between those of a file, in words
  std::string not_replayed;  ///< why there can be no replay, else empty
  double replay_bound = std::numeric_limits<double>::quiet_NaN();  ///< where a limit is why, that limit, m

  const Units& units() const { return natural.units; }
  /// The reference's, of the right solver; none where the experiment was not made.
  const std::vector<ReactionSample>& reactions() const;
  /// The subject had an answer at each of the samples.
  bool answered() const;
};

/// Which of the experiments are left out.
struct Experiments {
  bool ladder = true, reactions = true;
  std::function<void(double share)> progress = nullptr;  ///< told how much of what is done at the samples is done
};

/// All experiments on `subject`, which is asked in natural's units. `right`: it is the one whose replays the reference
/// holds; others have them where they answer the same to the last bit. Keeps pointers to its arguments.
Evidence gather(const Scenario& given, const Reference& reference, const Subject& subject, bool right,
                const InjectedFault& fault, const Experiments& experiments);

/// What is changed in the settings of the ladder's rungs: foreseen where the subject wants that, falsified for
/// controls.
std::function<void(ReplaySettings&)> rungSettings(const Evidence& evidence);

/// What a second look at the judged replay of `window` finds: what steps and rounding really do there.
void lookCloser(Evidence& evidence, std::size_t window);

}  // namespace ursula

#pragma once

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/evidence/external_evidence.h"
#include "validation/evidence/injected_fault.h"
#include "validation/evidence/reference.h"
#include "validation/replay/ladder.h"
#include "validation/replay/stabilised_replay.h"
#include "validation/replay/windows.h"
#include "validation/samples/complement_samples.h"
#include "validation/samples/engines.h"
#include "validation/samples/invariance_samples.h"
#include "validation/samples/pointwise.h"
#include "validation/samples/simbody_samples.h"
#include "validation/subject/frame_change.h"
#include "validation/subject/subject.h"

namespace ursula {

/// What a subject and its validation offer beside torques.
struct SubjectHas {
  bool any_instant = true;  ///< torques at any instant, not only those of a file
  bool kinematics = true, direct_dynamics = true, complement = true, other_machines = true;
  bool left_out_ladder = false, left_out_reactions = false;  ///< by the caller's options
  bool left_out_replays = false;                             ///< and all else that the samples alone do not need
  std::string out_of_time;  ///< why experiments are missing, if time ran out; else empty

  SubjectHas() = default;
  explicit SubjectHas(const Subject& subject);
};

/// The computed results for one subject on one scenario, in the scenario's natural units. Experiments, which judge
/// nothing, fill it; parts without an experiment stay empty. A failed check's second look refines windows and ladder,
/// and what is judged may be released.
struct Evidence {
  const Scenario* given = nullptr;               ///< in SI, as the caller gave it
  FrameChange natural;                           ///< of `given`
  const Scenario* scenario = nullptr;            ///< in natural's units, for all experiments
  const Subject* subject = nullptr;              ///< null for torques of a file
  const Reference* reference = nullptr;          ///< null for torques of a file
  const ExternalTorques* external = nullptr;     ///< null for a subject
  const Amplification* amplification = nullptr;  ///< null without replays
  SubjectHas has;
  bool right = false;  ///< whether the subject is the right solver
  int threads = 1;     ///< number of threads for the subject, which must then allow concurrent calls
  InjectedFault fault;

  std::vector<PointwiseSample> samples;
  std::vector<EngineSample> engines;
  std::vector<InvarianceSamples> invariances;
  std::vector<ReactionSample> own_reactions;  ///< empty if they are the right solver's
  bool has_reactions = false;
  std::vector<ComplementSample> complement;
  std::map<std::string, std::shared_ptr<const void>> witnessed;  ///< what parts asked, by the name of the witness
  ReplayPlan plan;                                               ///< with the subject's torques
  ReplayScales scales;
  std::vector<WindowedReplay> windows;
  Ladder ladder;
  std::optional<std::vector<double>> orders;
  std::optional<StabilisedReplay> stabilised;

  std::string spline;        ///< how the replayed torques come from those of a file or from few answers, in words
  std::string not_replayed;  ///< why no replay is possible, else empty
  double replay_bound = std::numeric_limits<double>::quiet_NaN();  ///< the limit, m, if it prevents the replay

  const Units& units() const { return natural.units; }
  /// The subject's own reactions if it has any, otherwise the right solver's; none without the experiment.
  const std::vector<ReactionSample>& reactions() const;
  /// Whether the subject answered at every sample.
  bool answered() const;
};

/// An experiment of a part at the samples. It returns its answers, which the part's checks judge.
struct Witness {
  const char* name;  ///< key of Evidence::witnessed
  std::shared_ptr<const void> (*ask)(const Evidence& evidence);
};

/// Which experiments are run.
struct Experiments {
  bool ladder = true, reactions = true, samples_alone = false;
  std::vector<Witness> witnesses = {};
  std::function<void(double share)> progress = nullptr;  ///< receives the completed share of the work at the samples
};

/// Runs all experiments on `subject`, which works in natural's units. `right` says that the reference's replays are its
/// own; another subject reuses them if its answers are bitwise equal. Keeps pointers to its arguments.
Evidence gather(const Scenario& given, const Reference& reference, const Subject& subject, bool right,
                const InjectedFault& fault, const Experiments& experiments);

/// Asks the witnesses at the samples that are there.
void askWitnesses(const std::vector<Witness>& witnesses, Evidence& evidence);

/// Changes the settings of the ladder's rungs: for subjects that foresee torques, and for negative controls.
std::function<void(ReplaySettings&)> rungSettings(const Evidence& evidence);

/// Takes a second look at the judged replay of `window`: it measures the actual errors of steps and rounding.
void refineWindow(Evidence& evidence, std::size_t window);

/// Relative work of a validation's parts, in evaluations of the closed loop's derivatives.
struct WorkParts {
  double reference = 0, samples = 0, replays = 0, checks = 0, sources = 0;  ///< in their order
  double total() const { return reference + samples + replays + checks + sources; }
};

/// By numbers of steps and samples, as measured on the shipped scenarios with up to 100,000 samples.
WorkParts workParts(const Scenario& scenario);

/// Estimates the time of validate() on this machine, s, from a few evaluations and their expected number. It is within
/// a factor of three for the shipped scenarios.
double workSeconds(const Scenario& scenario);

}  // namespace ursula

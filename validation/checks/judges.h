#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/check_catalogue.h"
#include "model/exact_trajectory.h"
#include "model/load.h"
#include "model/scenario.h"
#include "validation/evidence/evidence.h"
#include "validation/evidence/external_evidence.h"
#include "validation/limits/rounding_profile.h"
#include "validation/replay/ladder.h"
#include "validation/replay/stabilised_replay.h"
#include "validation/replay/windowed_replay.h"
#include "validation/samples/complement_samples.h"
#include "validation/samples/engines.h"
#include "validation/samples/invariance_samples.h"
#include "validation/samples/pointwise.h"
#include "validation/samples/simbody_samples.h"
#include "validation/subject/frame_change.h"
#include "validation/subject/subject.h"
#include "validation/verdict/result.h"
#include "validation/verdict/worst_share.h"

// The functions that judge turn what experiments found into checks with a value, a limit and a verdict. families.cpp
// says which of them judge a subject. `units` convert to SI for the words.

namespace ursula {

/// The words of a check that compares many instants.
struct ShownWords {
  std::string basis;
  std::string what;                             ///< precedes the instant that is shown, and its place
  std::function<std::string(int where)> place;  ///< names a place; null if there are none
  std::string cause;                            ///< of a wide limit
  std::string further = {};                     ///< follows the place
};

/// judgedIfUseful() with the words "…; shown for t = 1 s, leg 2", and with the largest value. `units` convert to SI.
Check judgedShown(const CheckedQuantity& quantity, const WorstShare& worst, const Units& units,
                  const ShownWords& words);

/// Names the motors' places; `units` must outlive it.
std::function<std::string(int where)> motorsOf(const Units& units);

/// Checks the commanded motion and the load: `motion.pose`, `.twist`, `.twist_rate`, and `motion.load` if there is a
/// load. All formulations share these and so cannot check them. No solver's results are used.
std::vector<Check> judgeCommandedMotion(const Scenario& scenario);

/// `motion.pose`, `.twist`, `.twist_rate`. The machine's `length` converts angles to metres.
std::vector<Check> judgeTrajectory(const Trajectory& trajectory, double length, const HiddenTerms& hidden);

/// The checks of these samples: `kinematics.*`, `torque.pointwise`, `acceleration.pointwise`. `units` convert the
/// samples to SI for the words; `sizes` are the motion's, here and below.
std::vector<Check> judgePointwise(const std::vector<PointwiseSample>& samples, bool has_kinematics,
                                  const Units& units = {}, const MotionSizes& sizes = {});

/// For samples of runJointsAndTorques: `kinematics.joint_*` and `torque.pointwise`, by their derived limits.
std::vector<Check> judgeJointsAndTorques(const std::vector<PointwiseSample>& samples, const Units& units = {},
                                         const MotionSizes& sizes = {});

/// Compares the subject with each further formulation of this build: `torque.twin`, `torque.maximal`, `torque.mujoco`.
/// `conditions`, at the same instants, explain wide limits; without them nothing does.
std::vector<Check> judgeEngines(const std::vector<EngineSample>& samples, const Units& units = {},
                                const std::vector<PointwiseSample>& conditions = {}, const MotionSizes& sizes = {});

/// Finds which formulation contradicts the others; each pair has its own limit.
OddOne oddOneOut(const std::vector<EngineSample>& samples);
/// The same for torques of a file, Simbody's and the NOC's.
OddOne oddOneOut(const ExternalTorques& torques);

/// `torque.between` compares the subject's torques with another formulation at thousands of instants between the other
/// checks'. The NOC is compared with Simbody, another solver with the NOC. Instants are multiples of the
/// golden ratio, which match no period, and more where the torques curve. The result gives the width of the narrowest
/// pulse that is surely found.
Check judgeBetween(const Scenario& scenario, const Subject& subject, const std::vector<PointwiseSample>& samples,
                   const RoundingProfile& profile, const Units& units = {});

/// Compares every answer that a subject ever gave with the NOC's. It replaces judgeBetween's check, whose instants it
/// includes. A solver may also go wrong after its first thousands of answers.
Check judgeAnswers(const Scenario& scenario, std::vector<Answered> answers, const std::vector<PointwiseSample>& samples,
                   const RoundingProfile& profile, const Units& units);

/// `direct.pointwise` compares the subject's direct dynamics (36) with Simbody's; `direct` is at some of `samples`.
/// Only for subjects that have direct dynamics.
Check judgeDirect(const std::vector<DirectSample>& direct, const Subject& subject,
                  const std::vector<PointwiseSample>& samples, const RoundingProfile& profile, const Units& units = {});

/// `direct.off_path`: the same in states off the commanded motion, where the trajectory cannot help.
Check judgeOffPath(const std::vector<DirectSample>& direct, const Subject& subject,
                   const std::vector<PointwiseSample>& samples, const RoundingProfile& profile,
                   const Units& units = {});

/// `complement.orthogonality` and `complement.rank`: T is the orthogonal complement of D, (33).
std::vector<Check> judgeComplement(const std::vector<ComplementSample>& samples, const Units& units);

/// Exact invariances without a reference, `invariance.*`: the world rotated (with gravity), axes turned, other units,
/// legs relabelled, masses doubled, time reversed. Returns none if the subject is no solver. Loads are left out.
std::vector<Check> judgeInvariances(const std::vector<InvarianceSamples>& invariances,
                                    const std::vector<PointwiseSample>& samples, const RoundingProfile& profile,
                                    const Units& units = {});

/// `invariance.engines`: the efforts of each engine in other frames against those in the given one.
Check judgeEngineFrames(const std::vector<FrameDifference>& differences, const std::vector<PointwiseSample>& samples,
                        const Units& units = {});

/// `reactions.pointwise` compares the joint reactions from the solver's formulation with Simbody's mobilizer and
/// constraint reactions, at the instants of `samples`. For subjects that find reactions.
Check judgeReactions(const std::vector<ReactionSample>& reactions, const std::vector<PointwiseSample>& samples,
                     const RoundingProfile& profile, const Units& units = {});

/// `replay.position`, `replay.orientation`, `closure.position`, `closure.velocity`, `energy.balance`, over all windows.
/// `cause` says why the accelerations' rounding is large, for limits that it makes useless.
std::vector<Check> judgeReplay(const std::vector<WindowedReplay>& windows, double position_scale, double length,
                               const LoopForces& forces, const Units& units = {}, const std::string& cause = "");

/// `integration.ladder` and `integration.second`.
std::vector<Check> judgeLadder(const Ladder& ladder, const WindowedReplay& finest, double position_scale,
                               const Units& units = {});

/// `integration.order` compares the orders from observedOrders() with the nominal one of the replay's integrator.
Check judgeOrder(const std::vector<double>& orders);

/// `feedback.torque`, N·m: the torque that the stabilising term added. `largest` is that of the right torques.
Check judgeStabilised(const StabilisedReplay& found, double largest, const Units& units = {});

/// `torque.against_noc`: external torques against this program's own.
Check judgeAgainstNoc(const ExternalTorques& torques, const Units& units = {});

/// `motion.load` compares the load that every formulation uses, over time, with its rows or with its force and moment.
Check judgeLoad(const Load& load, double duration);

/// The part for a table: `at` interpolates the rows by the quintics that LoadHistory promises, and is constant beyond.
Check judgeLoadTable(const std::vector<TimedWrench>& rows, const std::function<Wrench<double>(double)>& at);

/// Sorts the checks in the order of checkCatalogue() and adds those that do not apply, each with its reason.
void listEveryCheck(const Scenario& scenario, const SubjectHas& has, ValidationResult& result);
/// The same by `why_not`, which returns why a check does not apply; empty if it does. Checks that `out_of_time` left
/// out are unfinished.
void listEveryCheck(const std::function<std::string(const CheckRow&)>& why_not, const std::string& out_of_time,
                    ValidationResult& result);

}  // namespace ursula

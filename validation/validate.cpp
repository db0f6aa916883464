#include "validation/validate.h"

#include <algorithm>
#include <iterator>

#include "validation/attribution.h"
#include "validation/curves.h"
#include "validation/dense_torques.h"
#include "validation/direct_checks.h"
#include "validation/feedback.h"
#include "validation/finish.h"
#include "validation/integration_order.h"
#include "validation/invariance.h"
#include "validation/judge_replay.h"
#include "validation/ladder.h"
#include "validation/pointwise.h"
#include "validation/reference.h"
#include "validation/roads.h"
#include "validation/spoil.h"
#include "validation/timeseries.h"
#include "validation/windows.h"

namespace ursula {

std::vector<double> equallySpaced(double duration, int count) {
  std::vector<double> instants;
  instants.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) instants.push_back(duration * k / (count - 1));
  return instants;
}

namespace {

void append(std::vector<Check>& checks, std::vector<Check> more) {
  std::move(more.begin(), more.end(), std::back_inserter(checks));
}

bool anyFails(const std::vector<Check>& checks) {
  return std::any_of(checks.begin(), checks.end(), [](const Check& each) { return each.verdict == Verdict::fail; });
}

/// One subject on one scenario, in the scenario's natural units.
class Trial {
 public:
  /// `right`: the subject is the one whose replays the reference holds.
  Trial(const Reference& reference, const Subject& subject, bool right, const ValidationOptions& options)
      : reference_(reference),
        scenario_(reference.scenario),
        units_(reference.natural.units),
        subject_(subject),
        right_(right),
        options_(options),
        spoil_(options.spoil ? *options.spoil : Spoil{}),
        plan_(reference.plan) {
    const auto trajectory = scenario_.trajectory;
    plan_.torques = [subject, trajectory](double t) { return subject.torques(trajectory->at(t)); };
  }

  ValidationResult result(SubjectHas& has) {
    has.kinematics = static_cast<bool>(subject_.kinematics);
    has.direct_dynamics = static_cast<bool>(subject_.accelerations);
    has.other_machines = static_cast<bool>(subject_.rebuilt);
    has.left_out_ladder = !options_.ladder;
    has.left_out_reactions = !options_.reactions;
    ValidationResult result;
    result.scenario = scenario_.name;
    samples_ = runPointwise(scenario_, subject_, reference_.instants, reference_.profile);
    if (spoil_.sample) std::for_each(samples_.begin(), samples_.end(), spoil_.sample);
    result.checks = judgePointwise(samples_, static_cast<bool>(subject_.kinematics), units_);
    const bool answers = std::none_of(samples_.begin(), samples_.end(),
                                      [](const PointwiseSample& sample) { return !sample.refused.empty(); });
    if (answers)
      judgeAnswers(result);
    else
      append(result.checks, judgeReplay({}, 0, 0, {}));
    addResults(result);
    return result;
  }

 private:
  void judgeAnswers(ValidationResult& result) {
    const std::vector<RoadSample> roads = roadSamples();
    append(result.checks, judgeRoads(roads, units_));
    append(result.checks, judgeInvariances(scenario_, subject_, samples_, reference_.profile, units_));
    if (options_.reactions)
      result.checks.push_back(
          judgeReactions(scenario_, samples_, reference_.profile, &reactions_, units_, spoil_.reactions));
    result.checks.push_back(judgeBetween(scenario_, subject_, samples_, reference_.profile, units_));
    if (subject_.accelerations) judgeDirectDynamics(result);
    judgeReplays(result);
    result.findings.emplace_back("odd one out of the roads", oddOneOut(roads));
  }

  std::vector<RoadSample> roadSamples() const {
    std::vector<RoadSample> out = runRoads(scenario_, samples_, reference_.profile);
    const auto replace = [&](const Spoil::Seen& seen, auto RoadSample::*road) {
      if (!seen) return;
      const std::vector<RoadSample> spoilt = runRoads(seen(scenario_), samples_, reference_.profile);
      for (std::size_t k = 0; k < out.size(); ++k) out[k].*road = spoilt[k].*road;
    };
    replace(spoil_.twin, &RoadSample::twin);
    replace(spoil_.maximal, &RoadSample::maximal);
    replace(spoil_.mujoco, &RoadSample::mujoco);
    return out;
  }

  void judgeDirectDynamics(ValidationResult& result) {
    result.checks.push_back(judgeDirect(scenario_, subject_, samples_, reference_.profile, units_));
    const bool right_here = result.checks.back().verdict != Verdict::fail;  // else what is wrong is known
    result.checks.push_back(judgeGrowth(scenario_, subject_, reference_.plan.torques, reference_.amplification,
                                        plan_.acceleration, 10 * coarser * plan_.tolerance, units_, right_here));
  }

  void judgeReplays(ValidationResult& result) {
    windows_ = right_ && !spoil_.replay ? reference_.windows : replayed();
    const auto judgeWindows = [this](const std::vector<WindowedReplay>& windows) {
      return judgeReplay(windows, reference_.position_scale, reference_.amplification.length(), reference_.forces,
                         units_);
    };
    const auto judgeClimbed = [this] {
      return judgeLadder(ladder_, windows_.front(), reference_.position_scale, units_);
    };
    // What is beyond a limit gets a second look, at what steps and rounding really do there.
    for (std::size_t k = 0; k < windows_.size(); ++k)
      if (anyFails(judgeWindows({windows_[k]}))) windows_[k].closer = reference_.closer(k);
    if (options_.ladder) {
      ladder_ = climb(scenario_, plan_.torques, windows_.front(), right_, spoil_.ladder);
      if (anyFails(judgeClimbed())) {
        windows_.front().closer = reference_.closer(0);
        if (torquesHold()) climbOn(scenario_, plan_.torques, windows_.front(), spoil_.ladder, ladder_);
      }
    }
    append(result.checks, judgeWindows(windows_));
    if (options_.ladder) {
      append(result.checks, judgeClimbed());
      result.checks.push_back(spoil_.lower_order ? judgeOrder(scenario_, true) : reference_.order());
    }
    const Spoil::Seen& seen = spoil_.feedback;
    const Scenario fed_back = seen ? seen(scenario_) : scenario_;
    result.checks.push_back(judgeFeedback(fed_back, subject_, reference_.amplification, samples_, units_));
  }

  /// Of wrong torques it is known what is wrong.
  bool torquesHold() const {
    return std::all_of(samples_.begin(), samples_.end(),
                       [](const PointwiseSample& sample) { return sample.torque.error <= sample.torque.limit; });
  }

  /// In the windows of the right torques, with what those say of the integration.
  std::vector<WindowedReplay> replayed() const {
    std::vector<WindowedReplay> out = reference_.windows;
    for (WindowedReplay& window : out) {
      ReplaySettings settings = settingsOf(scenario_, plan_, window.window, 1);
      if (spoil_.replay) spoil_.replay(settings);
      window.replay = replay(scenario_, plan_.torques, settings);
      window.replay.tolerance = plan_.tolerance;  // that it is taken to have
    }
    return out;
  }

  void addResults(ValidationResult& result) {
    addFindings(samples_, windows_, result, units_);
    if (options_.budget)
      addBudget(attribute(scenario_, samples_, windows_, reference_.amplification, plan_), result, units_);
    result.timeseries = validationSeries(samples_, windows_);
    for (std::size_t k = 0; k < reactions_.names.size(); ++k)
      result.timeseries.add(reactions_.names[k], std::move(reactions_.columns[k]));
    addCurves(samples_, windows_, result);
    if (!ladder_.rungs.empty()) result.curves.emplace_back("Work and precision", workPrecision(ladder_));
  }

  const Reference& reference_;
  const Scenario& scenario_;
  const Units& units_;
  const Subject& subject_;
  bool right_;
  const ValidationOptions& options_;
  Spoil spoil_;
  ReplayPlan plan_;
  std::vector<PointwiseSample> samples_;
  TimeSeries reactions_;
  std::vector<WindowedReplay> windows_;
  Ladder ladder_;
};

ValidationResult run(const Scenario& scenario, const Reference& reference, const Subject& subject, bool right,
                     const ValidationOptions& options) {
  SubjectHas has;
  ValidationResult result = Trial(reference, subject, right, options).result(has);
  restore(reference.natural, result);
  addPicture(scenario, result);
  prependMotionChecks(scenario, result);
  listEveryCheck(scenario, has, result);
  judgeByUser(scenario.acceptance, result);
  addProvenance(scenario, subject.name, result);
  return result;
}

std::shared_ptr<const Reference> referenceOf(const Scenario& scenario, const ValidationOptions& options) {
  return options.reference ? options.reference : makeReference(scenario);
}

ValidationResult validateOwn(const Scenario& scenario, const SubjectOf& make, bool right,
                             const ValidationOptions& options) {
  const std::shared_ptr<const Reference> reference = referenceOf(scenario, options);
  const Subject subject = presented(make(reference->relocated), Vector3d::Zero(), reference->natural.units);
  return run(scenario, *reference, subject, right, options);
}

}  // namespace

ValidationResult validate(const Scenario& scenario, const Subject& subject, const ValidationOptions& options) {
  const std::shared_ptr<const Reference> reference = referenceOf(scenario, options);
  return run(scenario, *reference, presented(subject, reference->natural.origin, reference->natural.units), false,
             options);
}

ValidationResult validateMade(const Scenario& scenario, const SubjectOf& make, const ValidationOptions& options) {
  return validateOwn(scenario, make, false, options);
}

ValidationResult validate(const Scenario& scenario, const ValidationOptions& options) {
  const SubjectOf noc = [](const Scenario& here) { return nocSubject(*here.manipulator, here.load); };
  return validateOwn(scenario, noc, true, options);
}

}  // namespace ursula

#include "validation/checks/families.h"

#include <algorithm>
#include <iterator>

#include "base/deadline.h"
#include "base/start_threads.h"
#include "validation/checks/judges.h"
#include "validation/limits/further_engines.h"
#include "validation/replay/windowed_replay.h"

namespace ursula {
namespace {

bool always(const Evidence&) { return true; }

/// False if time ran out before the samples, so that there are none.
bool sampled(const Evidence& e) { return e.has.out_of_time.empty() || !e.samples.empty(); }

bool answers(const Evidence& e) { return e.subject != nullptr && sampled(e) && e.answered(); }

std::vector<std::string> checksOfFurtherEngines() {
  std::vector<std::string> names;
  for (const EngineKind& engine : furtherEngines()) names.emplace_back(engine.check);
  return names;
}

const RoundingProfile& profileOf(const Evidence& e) { return e.reference->rounding().profile; }
std::vector<Check> judgeMotion(const Evidence& e) { return judgeCommandedMotion(*e.given); }

std::vector<Check> judgeSamples(const Evidence& e) {
  std::vector<Check> checks = judgePointwise(e.samples, e.has.kinematics, e.units(), sizesOf(e));
  if (e.external == nullptr) return checks;
  checks.push_back(judgeAgainstNoc(*e.external, e.units()));
  for (Check& check : checks) check.basis += e.external->precisionInWords(e.units());
  return checks;
}

std::vector<Check> judgeBetweenSamples(const Evidence& e) {
  if (e.subject->most_questions > 0) {
    e.reference->deadline.require();
    return {judgeAnswers(*e.scenario, e.subject->answers(), e.samples, profileOf(e), e.units())};
  }
  return {judgeBetween(*e.scenario, *e.subject, e.samples, profileOf(e), e.units())};
}

/// Compares direct dynamics under the right torques.
std::vector<Check> judgeDirectDynamics(const Evidence& e) {
  const std::vector<DirectSample>& direct = e.reference->direct();
  return {judgeDirect(direct, *e.subject, e.samples, profileOf(e), e.units()),
          judgeOffPath(direct, *e.subject, e.samples, profileOf(e), e.units())};
}

std::vector<Check> judgeWindows(const Evidence& e, const std::vector<WindowedReplay>& windows) {
  const auto noisiest = std::max_element(e.samples.begin(), e.samples.end(), [](const auto& a, const auto& b) {
    return a.conditioning.accelerationRounding() < b.conditioning.accelerationRounding();
  });
  const std::string cause = noisiest == e.samples.end() ? "" : causeOfRounding(noisiest->conditioning);
  return judgeReplay(windows, e.scales.position, e.scales.length, e.scales.forces, e.units(), cause);
}

std::vector<Check> notReplayed(double limit, const std::string& basis, const std::string& why) {
  std::vector<Check> checks;
  const std::pair<const char*, const char*> names[] = {{"replay.position", "m"},
                                                       {"replay.orientation", "rad"},
                                                       {"closure.position", "m"},
                                                       {"closure.velocity", "m/s"},
                                                       {"energy.balance", "J"}};
  for (const auto& [name, unit] : names)
    checks.push_back(notJudgeable(Reason::not_covered, name, std::nan(""), std::nan(""), unit, basis, why));
  checks.front().limit = limit;
  return checks;
}

std::vector<Check> judgeReplays(const Evidence& e) {
  if (!e.not_replayed.empty()) return notReplayed(e.replay_bound, e.spline, "not replayed: " + e.not_replayed);
  std::vector<Check> checks = judgeWindows(e, e.windows);
  if (!e.spline.empty())
    for (Check& check : checks) check.basis += "; " + e.spline;
  return checks;
}

/// False if time ran out before the replays.
bool replayed(const Evidence& e) {
  return !e.has.left_out_replays && (e.has.out_of_time.empty() || !e.windows.empty());
}

void lookAtReplays(Evidence& e) {
  for (std::size_t k = 0; k < e.windows.size() && e.reference != nullptr; ++k)
    if (anyIs(judgeWindows(e, {e.windows[k]}), Verdict::fail)) refineWindow(e, k);
}

bool climbed(const Evidence& e) { return !e.ladder.rungs.empty(); }

std::vector<Check> judgeClimbed(const Evidence& e) {
  return judgeLadder(e.ladder, e.windows.front(), e.scales.position, e.units());
}

void lookAtLadder(Evidence& e) {
  refineWindow(e, 0);
  // If the torques are wrong, the cause is already known.
  const bool torques_hold = std::all_of(e.samples.begin(), e.samples.end(), [](const PointwiseSample& sample) {
    return sample.torque.error <= sample.torque.limit;
  });
  if (torques_hold)
    extendLadder(*e.scenario, e.plan.torques, e.windows.front(), rungSettings(e), e.plan.deadline, e.ladder);
}

std::vector<Check> judgeStabilisedReplay(const Evidence& e) {
  return {judgeStabilised(*e.stabilised, sizesOf(e).of(Rounded::torque), e.units())};
}

template <class T>
void append(std::vector<T>& all, std::vector<T> more) {
  std::move(more.begin(), more.end(), std::back_inserter(all));
}

std::vector<CheckFamily> familiesOfCore() {
  using E = const Evidence&;
  return {
      {"motion",
       {"motion.pose", "motion.twist", "motion.twist_rate", "motion.load"},
       always,
       judgeMotion,
       nullptr,
       true},
      // Machines of this kind have no file; validateMechanism() judges these.
      {"model", {"model.reading", "energy.power"}, [](E) { return false; }, [](E) { return std::vector<Check>(); }},
      {"samples",
       {"kinematics.joint_angles", "kinematics.joint_rates", "kinematics.joint_accelerations", "kinematics.positions",
        "kinematics.twists", "kinematics.accelerations", "kinematics.jacobian", "kinematics.jacobian_rate",
        "kinematics.jacobian_difference", "torque.pointwise", "acceleration.pointwise", "torque.against_noc"},
       sampled,
       judgeSamples},
      {"formulations", checksOfFurtherEngines(), [](E e) { return answers(e) && !e.engines.empty(); },
       [](E e) { return judgeEngines(e.engines, e.units(), e.samples, sizesOf(e)); }},
      {"complement",
       {"complement.orthogonality", "complement.rank"},
       [](E e) { return !e.complement.empty(); },
       [](E e) { return judgeComplement(e.complement, e.units()); }},
      {"invariances",
       {"invariance.rotation", "invariance.axes", "invariance.units", "invariance.labels", "invariance.mass",
        "invariance.time_reversal"},
       [](E e) { return answers(e) && !e.invariances.empty(); },
       [](E e) { return judgeInvariances(e.invariances, e.samples, profileOf(e), e.units()); }},
      {"engines in other frames",
       {"invariance.engines"},
       answers,
       [](E e) { return std::vector<Check>{judgeEngineFrames(profileOf(e).acrossFrames(), e.samples, e.units())}; }},
      {"reactions",
       {"reactions.pointwise"},
       [](E e) { return !e.reactions().empty(); },
       [](E e) { return std::vector<Check>{judgeReactions(e.reactions(), e.samples, profileOf(e), e.units())}; }},
      {"between samples",
       {"torque.between"},
       [](E e) { return answers(e) && !e.has.left_out_replays; },
       judgeBetweenSamples},
      {"direct dynamics",
       {"direct.pointwise", "direct.off_path"},
       [](E e) { return answers(e) && e.has.direct_dynamics && !e.has.left_out_replays; },
       judgeDirectDynamics},
      {"replays",
       {"replay.position", "replay.orientation", "closure.position", "closure.velocity", "energy.balance"},
       replayed,
       judgeReplays,
       lookAtReplays},
      {"ladder", {"integration.ladder", "integration.second"}, climbed, judgeClimbed, lookAtLadder},
      {"order",
       {"integration.order"},
       [](E e) { return e.orders.has_value(); },
       [](E e) { return std::vector<Check>{judgeOrder(*e.orders)}; }},
      {"stabilised replay", {"feedback.torque"}, [](E e) { return e.stabilised.has_value(); }, judgeStabilisedReplay},
  };
}

}  // namespace

const MotionSizes& sizesOf(const Evidence& e) { return e.reference ? profileOf(e).sizes() : e.external->sizes; }

const std::vector<CheckFamily>& checkFamilies() {
  static const std::vector<CheckFamily> families = [] {
    std::vector<CheckFamily> all = familiesOfCore();
    append(all, partFamilies());
    return all;
  }();
  return families;
}

std::vector<Witness> witnesses() {
  std::vector<Witness> out;
  for (const CheckFamily& family : checkFamilies())
    if (family.ask != nullptr) out.push_back({family.id, family.ask});
  return out;
}

void checksInSi(const Units& units, std::vector<Check>& checks) {
  for (Check& check : checks) {
    const double unit = units.sizeOf(check.unit);
    check.value *= unit;
    check.limit *= unit;
    check.largest.value *= unit;
  }
}

std::vector<Check> judgeAll(Evidence& evidence) {
  std::vector<Check> out;
  std::vector<const CheckFamily*> left;
  // A family is skipped if time runs out, because without its second look it might fail a right result.
  const auto inTime = [&evidence](const auto& work) {
    try {
      work();
      return true;
    } catch (const OutOfTime& over) {
      evidence.has.out_of_time = over.what();
      return false;
    }
  };
  for (const CheckFamily& family : checkFamilies()) {
    if (!family.applies(evidence)) continue;
    const bool ready = inTime([&] {
      if (family.second_look && anyIs(family.judge(evidence), Verdict::fail)) family.second_look(evidence);
    });
    if (ready) left.push_back(&family);
  }
  std::vector<std::vector<Check>> judged(left.size());
  inParallel(evidence.threads, static_cast<int>(left.size()), [&](int k) {
    inTime([&] {
      judged[k] = left[k]->judge(evidence);
      if (!left[k]->in_si) checksInSi(evidence.units(), judged[k]);
    });
  });
  for (std::vector<Check>& checks : judged) append(out, std::move(checks));
  return out;
}

}  // namespace ursula

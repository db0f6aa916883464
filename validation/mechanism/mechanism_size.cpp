#include <algorithm>
#include <utility>

#include "validation/mechanism/validate_mechanism.h"

namespace ursula {
namespace {

/// Numbers of joints that a scenario can leave out: of passive ones by a word, of motors one by one.
struct LeavableNumbers {
  const char* term;
  const char* word;  ///< of `leave_out`; null for the motors' numbers
  std::vector<std::pair<const char*, double MechanismJoint::*>> numbers;
};

const std::vector<LeavableNumbers>& leavables() {
  const std::vector<std::pair<const char*, double MechanismJoint::*>> friction = {
      {"damping", &MechanismJoint::damping}, {"friction", &MechanismJoint::friction}};
  static const std::vector<LeavableNumbers> all = {
      {"springs", "springs", {{"stiffness", &MechanismJoint::stiffness}}},
      {"rotor_inertia", "passive-armature", {{"armature", &MechanismJoint::rotor_inertia}}},
      {"friction", "passive-friction", friction},
      {"rotor_inertia", nullptr, {{"armature", &MechanismJoint::rotor_inertia}}},
      {"friction", nullptr, friction}};
  return all;
}

/// Sets the numbers to zero; returns how a scenario says so, empty if all are zero anyway.
std::vector<ScenarioChange> leaveOut(const LeavableNumbers& which, MechanismParameters& machine) {
  std::vector<ScenarioChange> out;
  const bool is_any = which.word != nullptr && std::string(which.word) == "springs";
  for (MechanismJoint& joint : machine.joints)
    for (const auto& [name, member] : which.numbers) {
      if (joint.*member == 0 || (!is_any && joint.driven != (which.word == nullptr))) continue;
      joint.*member = 0;
      if (which.word == nullptr) out.push_back({"mechanism.numbers.joint." + joint.name + "." + name, "0"});
      if (which.word != nullptr && out.empty()) out.push_back({"mechanism.leave_out", which.word});
    }
  return out;
}

MechanismScenario changed(const MechanismScenario& scenario, MechanismParameters machine) {
  MechanismScenario out = scenario;
  const Mechanism& own = *scenario.mechanism;
  out.read.machine = machine;
  out.mechanism = std::make_shared<const Mechanism>(std::move(machine), own.bodies()[own.output()].name);
  return out;
}

using Samples = std::vector<const MechanismSample*>;
using ChangeMotion = void (*)(MotorMotion&);

/// Efforts of all samples in the shown unit, of a machine with the same geometry and perhaps another motion.
std::vector<double> effortsOf(const Mechanism& machine, const MechanismEvidence& evidence, const Samples& samples,
                              ChangeMotion change = nullptr) {
  const LoopSolver solver(machine);
  std::vector<double> out;
  LoopWork work;
  for (const MechanismSample* sample : samples) {
    MotorMotion motion = sample->motion;
    loops::LoopPose pose = evidence.motion->near(motion.t);
    solver.moveTo(motion.q, pose);
    if (change != nullptr) change(motion);
    const MotorEfforts efforts = solver.inverseDynamics(motion, pose, work).cwiseProduct(evidence.efforts_in);
    out.insert(out.end(), efforts.data(), efforts.data() + efforts.size());
  }
  return out;
}

/// The terms of the equations as a whole, then what the scenario can leave out.
std::vector<ModelTerm> termsOf(const MechanismEvidence& evidence, const Samples& samples,
                               const std::vector<double>& right) {
  const Mechanism& own = *evidence.scenario->mechanism;
  std::vector<ModelTerm> out;
  const auto add = [&](ModelTerm term, const std::vector<double>& without) {
    for (std::size_t i = 0; i < right.size(); ++i) term.efforts.push_back(right[i] - without[i]);
    out.push_back(std::move(term));
  };
  MechanismParameters weightless = own.parameters();
  weightless.gravity.setZero();
  add({"gravity"}, effortsOf(Mechanism(weightless), evidence, samples));
  add({"acceleration"}, effortsOf(own, evidence, samples, [](MotorMotion& motion) { motion.qddot.setZero(); }));
  add({"velocity"}, effortsOf(own, evidence, samples, [](MotorMotion& motion) { motion.qdot.setZero(); }));
  for (const LeavableNumbers& which : leavables()) {
    MechanismParameters machine = own.parameters();
    std::vector<ScenarioChange> changes = leaveOut(which, machine);
    if (changes.empty()) continue;
    const MechanismScenario without = changed(*evidence.scenario, std::move(machine));
    add({which.term, {}, std::move(changes)}, effortsOf(*without.mechanism, evidence, samples));
  }
  return out;
}

/// Whether all formulations find the efforts right if the scenario has these changes.
bool areRightWith(const std::vector<ScenarioChange>& changes, const MechanismEvidence& evidence, const Samples& samples,
                  const std::vector<MakeMechanismEngine>& makers, double allowed) {
  MechanismParameters machine = evidence.scenario->mechanism->parameters();
  for (const LeavableNumbers& which : leavables()) {
    MechanismParameters without = machine;
    const std::vector<ScenarioChange> needs = leaveOut(which, without);
    const auto isAsked = [&](const ScenarioChange& need) {
      return std::any_of(changes.begin(), changes.end(), [&](const ScenarioChange& change) {
        return change.key == need.key && change.value == need.value;
      });
    };
    if (!needs.empty() && std::all_of(needs.begin(), needs.end(), isAsked)) machine = without;
  }
  const MechanismScenario other = changed(*evidence.scenario, std::move(machine));
  GivenEfforts given;
  for (const MechanismSample* sample : samples) {
    given.t.push_back(sample->motion.t);
    given.efforts.push_back(sample->subject);
    given.precision.push_back(sample->given);
  }
  MechanismSubject subject;
  subject.given = std::make_shared<const GivenEfforts>(std::move(given));
  const MechanismAlong along(other);
  const MechanismEvidence found =
      gatherMechanism(along.scenario(), along.motion(), subject, makers, Deadline(), nullptr);
  for (const Check& check : judgeMechanism(found, subject))
    if (isOf(check, "torque") && check.reason != Reason::not_covered && check.verdict != Verdict::pass &&
        !(check.largest.value <= allowed))
      return false;
  return true;
}

}  // namespace

std::optional<FailureSize> failureSize(const MechanismEvidence& evidence,
                                       const std::vector<MakeMechanismEngine>& makers, const ValidationResult& result) {
  constexpr std::size_t most = 300;
  if (!result.deviation || evidence.samples.empty()) return std::nullopt;
  Samples samples;
  const std::size_t rows = evidence.samples.size(), count = std::min(rows, most);
  for (std::size_t i = 0; i < count; ++i)
    samples.push_back(&evidence.samples[count == 1 ? 0 : i * (rows - 1) / (count - 1)]);
  const std::vector<double> right = effortsOf(*evidence.scenario->mechanism, evidence, samples);
  JudgedEfforts efforts;
  efforts.largest = evidence.largest;
  efforts.allowed = result.deviation->allowed;
  for (const MechanismSample* sample : samples)
    for (Eigen::Index k = 0; k < sample->subject.size(); ++k) {
      const double in = evidence.efforts_in(k);
      efforts.residual.push_back(sample->subject(k) * in - right[efforts.residual.size()]);
      efforts.limits.push_back(evidence.limit(*sample, k) + sample->given(k) * in);
      efforts.condition.push_back(sample->condition * sample->condition);
    }
  return sizeOf(efforts, termsOf(evidence, samples, right), result, [&](const std::vector<ScenarioChange>& changes) {
    return areRightWith(changes, evidence, samples, makers, efforts.allowed);
  });
}

}  // namespace ursula

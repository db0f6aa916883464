// What a solver's and a simulator's answers tell of a mechanism's mistake: terms asked apart, answers that depend on
// earlier ones, accelerations of another scale, sign or order; and causes that say the file's own numbers.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/validation/loop_machine.h"
#include "validation/outside/outside_simulator.h"

namespace ursula {
namespace {

using Eigen::VectorXd;
using testing::HasSubstr;

/// A solver that answers by a machine of its own.
class SolverOf {
 public:
  SolverOf(const Machine& machine, const MechanismParameters& own)
      : own_(own), solver_(own_), motion_(solver_, *machine.scenario().trajectory) {}

  MotorEfforts operator()(const MechanismQuestion& question) const {
    loops::LoopPose pose = motion_.near(question.motion.t);
    solver_.moveTo(question.motion.q, pose);
    return solver_.inverseDynamics(question.motion, pose, work_);
  }
  VectorXd accelerations(const MechanismQuestion& state, const MotorEfforts& efforts) const {
    return solver_.directDynamics(state.motion, efforts, motion_.near(state.motion.t), work_);
  }

 private:
  Mechanism own_;
  LoopSolver solver_;
  LoopMotion motion_;
  mutable LoopWork work_;
};

/// Judges answers, and counts the questions.
template <class Answer>
ValidationResult judgeSolver(const Machine& machine, const Answer& answer, std::size_t* questions = nullptr) {
  MechanismSubject subject;
  subject.about = {"mine", Formulation::external, CalledBy::program};
  subject.answers = [&](const std::vector<MechanismQuestion>& all) {
    std::vector<MotorEfforts> out;
    for (const MechanismQuestion& each : all) out.push_back(answer(each));
    if (questions != nullptr) *questions += all.size();
    return out;
  };
  return validateMechanism(machine.scenario(), subject);
}

double errorOf(const ValidationResult& result, const std::string& term) {
  for (const TermError& each : result.terms)
    if (each.term == term) return each.error;
  return std::nan("");
}

class MechanismAnswers : public testing::TestWithParam<const char*> {
 protected:
  MechanismAnswers() : machine(GetParam()) {}
  const Machine machine;
};

TEST_P(MechanismAnswers, TermsAskedApartShowWhichIsOff) {
  MechanismParameters light = machine.parameters();
  light.gravity *= 0.99;
  std::size_t questions = 0;
  const ValidationResult weight = judgeSolver(machine, SolverOf(machine, light), &questions);
  EXPECT_LE(questions, 2000U);
  EXPECT_NEAR(errorOf(weight, "statics"), 0.01, 1e-9);
  for (const char* right : {"acceleration", "velocity", "odd"}) EXPECT_LT(errorOf(weight, right), 1e-9) << right;
  EXPECT_EQ(errorOf(weight, "repeat"), 0);
  MechanismParameters rubbing = machine.parameters();
  for (MechanismJoint& joint : rubbing.joints)
    if (joint.name == machine.mechanism().motor(0).name) joint.damping += 0.1;
  const ValidationResult odd = judgeSolver(machine, SolverOf(machine, rubbing));
  EXPECT_GT(errorOf(odd, "odd"), 1e-3);
  for (const char* right : {"statics", "acceleration", "velocity"}) EXPECT_LT(errorOf(odd, right), 1e-9) << right;
}

TEST(SolverWithMemory, IsNamedByItsState) {
  const Machine machine("fourbar");
  const SolverOf right(machine, machine.parameters());
  MotorEfforts before = MotorEfforts::Zero(static_cast<Eigen::Index>(machine.mechanism().motorCount()));
  const ValidationResult result = judgeSolver(machine, [&](const MechanismQuestion& question) {
    const MotorEfforts now = right(question), out = now + 1e-3 * before;
    before = now;
    return out;
  });
  ASSERT_TRUE(result.cause) << result.cause_words.cause;
  EXPECT_EQ(result.cause->kind, CauseKind::state);
  EXPECT_GT(errorOf(result, "repeat"), 1e-6);
}

/// The cause of a simulator whose right accelerations are changed.
template <class Change>
ValidationResult judgeSimulator(const Machine& machine, const Change& change) {
  const auto right = std::make_shared<SolverOf>(machine, machine.parameters());
  MechanismSimulator simulator;
  simulator.about = {"mine", Formulation::external, CalledBy::program};
  simulator.accelerations = [right, change](const auto& states, const auto& efforts) {
    std::vector<VectorXd> out;
    for (std::size_t k = 0; k < states.size(); ++k) {
      out.push_back(right->accelerations(states[k], efforts[k]));
      change(out.back());
    }
    return out;
  };
  return validateSimulator(machine.scenario(), simulator);
}

TEST_P(MechanismAnswers, WrongAccelerationsAreNamed) {
  EXPECT_FALSE(judgeSimulator(machine, [](VectorXd&) {}).cause);
  const auto named = [&](CauseKind kind, const char* words, const auto& change) {
    const ValidationResult result = judgeSimulator(machine, change);
    EXPECT_EQ(result.verdict, Verdict::fail) << words;
    if (!result.cause) {
      ADD_FAILURE() << words << ": " << result.cause_words.cause;
      return NamedCause{};
    }
    EXPECT_EQ(result.cause->kind, kind) << result.cause_words.cause;
    EXPECT_EQ(result.cause->term, "acceleration") << result.cause_words.cause;
    EXPECT_THAT(result.cause_words.cause, HasSubstr(words));
    return *result.cause;
  };
  EXPECT_NEAR(
      named(CauseKind::scale, "the acceleration has a factor of 1.01", [](auto& a) { a *= 1.01; }).found.value_or(0),
      1.01, 1e-6);
  named(CauseKind::units, "the acceleration has a factor of 57.29", [](auto& a) { a *= 180 / M_PI; });
  named(CauseKind::sign, "the sign of the acceleration is wrong", [](auto& a) { a = -a; });
  if (machine.mechanism().motorCount() == 1) return;
  const NamedCause one = named(CauseKind::scale, "the acceleration of motor 2", [](auto& a) { a(1) *= 0.9; });
  EXPECT_EQ(one.motor, 2);
  EXPECT_NEAR(one.found.value_or(0), 0.9, 1e-6);
  EXPECT_EQ(named(CauseKind::sign, "the acceleration of motor 1 is wrong", [](auto& a) { a(0) = -a(0); }).motor, 1);
  const NamedCause swapped =
      named(CauseKind::order, "the motors' accelerations are in another order", [](auto& a) { std::swap(a(0), a(1)); });
  ASSERT_GE(swapped.legs.size(), 2U);
  EXPECT_EQ(swapped.legs[0], 2);
  EXPECT_EQ(swapped.legs[1], 1);
}

INSTANTIATE_TEST_SUITE_P(Loops, MechanismAnswers, testing::Values("fourbar", "planar3rrr", "ankle"),
                         [](const auto& machine) { return std::string(machine.param); });

/// A change of axes rounds a file's number; a cause says the file's.
TEST(CauseNumbers, AreTheFilesOwn) {
  const Vector3d written(0.04, -0.03, 0.14);
  const Machine machine("fourbar",
                        [&](MechanismParameters& p) { p.bodies[1].center_of_mass = p.bodies[1].frame * written; });
  const MechanismBody& crank = machine.mechanism().bodies()[1];
  ASSERT_EQ(crank.name, "crank");
  EXPECT_NE(crank.frame.inverse() * crank.center_of_mass, written) << "or nothing is rounded";
  int named = 0;
  for (int k = 0; k < 3; ++k) {
    const ValidationResult result = judgeChanged(machine, [&](MechanismParameters& p) {
      p.bodies[1].center_of_mass += 0.01 * p.bodies[1].frame.linear().col(k);
    });
    if (!result.cause || result.cause->parameter != "body.crank.center_of_mass." + std::to_string(k)) continue;
    EXPECT_EQ(result.cause->expected.value_or(0), written(k));
    EXPECT_NEAR(result.cause->found.value_or(0), written(k) + 0.01, 1e-9);
    ++named;
  }
  EXPECT_GT(named, 0);
}

}  // namespace
}  // namespace ursula

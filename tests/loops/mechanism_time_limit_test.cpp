// A mechanism whose time ran out: what was not reached is inconclusive, whoever is judged, and nothing passes unseen.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "tests/loops/loop_scenario.h"
#include "validation/mechanism/validate_mechanism.h"

namespace ursula {
namespace {

/// The right efforts times a factor, as a program answers; counts the questions.
MechanismSubject solverOf(const MechanismAlong& along, double factor, int& asked) {
  MechanismSubject out;
  out.about = {"solver", Formulation::external, CalledBy::solver};
  out.answers = [&along, factor, &asked](const std::vector<MechanismQuestion>& questions) {
    std::vector<MotorEfforts> efforts;
    LoopWork work;
    for (const MechanismQuestion& question : questions)
      efforts.push_back(factor * along.motion().inverseDynamics(question.motion.t, work));
    asked += static_cast<int>(questions.size());
    return efforts;
  };
  return out;
}

Verdict verdictOf(const ValidationResult& result, const char* check) {
  const Check* found = findCheck(result.checks, check);
  return found == nullptr ? Verdict::not_applicable : found->verdict;
}

TEST(MechanismTimeLimit, letsNothingPassThatWasNotCompared) {
  const MechanismScenario scenario = loopScenario("fourbar");
  const MechanismAlong along(scenario);
  MechanismOptions none_at_all;
  none_at_all.time_limit = 1e-9;
  int asked = 0;
  for (const double factor : {1.0, 0.0}) {
    const ValidationResult result = validateMechanism(scenario, solverOf(along, factor, asked), none_at_all);
    EXPECT_EQ(result.verdict, Verdict::inconclusive) << factor;
    for (const char* check : {"torque.pointwise", "torque.against_noc", "torque.between", "acceleration.pointwise"})
      EXPECT_EQ(verdictOf(result, check), Verdict::inconclusive) << check;
    EXPECT_EQ(verdictOf(result, "complement.rank"), Verdict::not_applicable) << "a solver's efforts have none";
    EXPECT_FALSE(result.timeseries.names.empty()) << "files are written of it";
  }
  const ValidationResult own = validateMechanism(scenario, {}, none_at_all);
  EXPECT_EQ(own.verdict, Verdict::inconclusive);
  for (const char* check : {"torque.pointwise", "kinematics.positions", "direct.pointwise", "complement.rank",
                            "invariance.units", "replay.position"})
    EXPECT_EQ(verdictOf(own, check), Verdict::inconclusive) << check;
}

TEST(MechanismTimeLimit, judgesTheSamplesThatWereReached) {
  const MechanismScenario scenario = loopScenario("fourbar");
  const MechanismAlong along(scenario);
  for (const double factor : {1.0, 1.0 + 1e-6}) {
    int asked = 0, samples = 0;
    MechanismSubject subject = solverOf(along, factor, asked);
    subject.answers_between = [&](const std::vector<MechanismQuestion>& questions) {
      samples = asked;
      return subject.answers(questions);
    };
    MechanismOptions options;
    options.asked_to_end = [&] { return samples > 0; };
    const ValidationResult result = validateMechanism(scenario, subject, options);
    ASSERT_GT(samples, 0);
    EXPECT_EQ(verdictOf(result, "torque.between"), Verdict::inconclusive);
    EXPECT_EQ(verdictOf(result, "torque.pointwise"), factor == 1 ? Verdict::pass : Verdict::fail);
    EXPECT_EQ(result.verdict, factor == 1 ? Verdict::inconclusive : Verdict::fail);
  }
}

}  // namespace
}  // namespace ursula

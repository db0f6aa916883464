// Solvers that are no part of this program: asked in batches, never changed by that, and what they throw.

#include "validation/outside/outside_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tests/support/matchers.h"
#include "tests/support/vectors.h"
#include "tests/validation/checks.h"
#include "validation/outside/external_solver.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

ValidationOptions thorough() {
  ValidationOptions out;
  out.thorough = true;
  return out;
}

struct Case {
  Scenario scenario = vectorScenario("random-2");
  Subject right;

  Case() {
    scenario.simulation.samples = 11;
    right = nocSubject(*scenario.manipulator, scenario.load);
  }

  OutsideSolver solver(std::function<void(std::size_t)> before = nullptr) const {
    const auto answer = [right = right, before](const std::vector<Motion<double>>& motions) {
      if (before) before(motions.size());
      std::vector<Vector6d> out;
      for (const Motion<double>& motion : motions) out.push_back(right.torques(motion));
      return out;
    };
    return {"outside", answer};
  }
};

TEST(OutsideSolver, isJudgedAsWhatIsAskedOneByOne) {
  const Case here;
  std::size_t calls = 0, motions = 0;
  const ValidationResult many = validateOutside(here.scenario, here.solver([&](std::size_t count) {
    ++calls;
    motions += count;
  }),
                                                thorough());
  EXPECT_GT(motions, 8 * calls) << "it was asked one by one";
  Subject single;
  single.name = "outside";
  single.torques = here.right.torques;
  const ValidationResult one_by_one = validate(here.scenario, single);
  ASSERT_EQ(many.checks.size(), one_by_one.checks.size());
  int judged = 0;
  for (std::size_t k = 0; k < many.checks.size(); ++k) {
    const Check &a = many.checks[k], &b = one_by_one.checks[k];
    EXPECT_EQ(a.verdict, b.verdict) << a.name;
    EXPECT_EQ(a.why, b.why);
    if (a.verdict == Verdict::not_applicable) continue;
    ++judged;
    EXPECT_EQ(a.value, b.value) << a.name;
    EXPECT_EQ(a.limit, b.limit) << a.name;
  }
  EXPECT_GE(judged, 15);
}

/// Every motion takes 2 ms at least. So no call, but the first of each size, may have more than 125 of them, and none
/// begins after the limit.
TEST(OutsideSolver, isAskedInPiecesUnderATimeLimit) {
  Case here;
  here.scenario.simulation.samples = 301;
  std::size_t motions = 0, most = 0;
  const OutsideSolver slow = here.solver([&](std::size_t count) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2) * count);
    motions += count;
    most = std::max(most, count);
  });
  ValidationOptions options;
  options.time_limit = 0.5;
  const ValidationResult result = validateOutside(here.scenario, slow, options);
  EXPECT_EQ(result.verdict, Verdict::inconclusive);
  EXPECT_LE(most, 125U);
  EXPECT_LE(motions, 250U + 125U);
  std::size_t first = 0;
  try {
    validateOutside(here.scenario, here.solver([&](std::size_t count) { throw first = count; }));
  } catch (const std::size_t&) {
  }
  EXPECT_EQ(first, 301U) << "without a limit it is asked for all at once";
}

/// What a slow solver is asked: few questions show a right one and a wrong one, and a pulse longer than what is stated.
TEST(OutsideSolver, isAskedAtMostTwoThousandTimes) {
  for (const int samples : {2, 301, 5000}) {
    Case here;
    here.scenario.simulation.samples = samples;
    std::size_t asked = 0;
    const auto count = [&asked](std::size_t motions) { asked += motions; };
    const ValidationResult right = validateOutside(here.scenario, here.solver(count));
    EXPECT_EQ(right.verdict, Verdict::pass) << samples;
    EXPECT_LE(asked, 2000u) << samples;
    EXPECT_GE(asked, 1500u) << samples;
    for (const char* name : {"torque.between", "replay.position", "integration.ladder", "feedback.torque"})
      EXPECT_EQ(findCheck(right.checks, name)->verdict, Verdict::pass) << name;
    EXPECT_LT(findCheck(right.checks, "torque.between")->gap, here.scenario.trajectory->duration() / 500);
    asked = 0;
    OutsideSolver wrong = here.solver(count);
    wrong.torques = [right = wrong.torques](const std::vector<Motion<double>>& motions) {
      std::vector<Vector6d> out = right(motions);
      for (Vector6d& each : out) each(3) *= 1.01;
      return out;
    };
    const ValidationResult failed = validateOutside(here.scenario, wrong);
    EXPECT_EQ(failed.verdict, Verdict::fail) << samples;
    EXPECT_EQ(findCheck(failed.checks, "replay.position")->verdict, Verdict::fail) << samples;
    EXPECT_LE(asked, 2000u) << samples;
    ASSERT_TRUE(failed.cause) << samples;
    EXPECT_EQ(failed.cause->kind, CauseKind::scale);
  }
}

TEST(OutsideSolver, aPulseLongerThanTheStatedResolutionIsSeen) {
  const Case here;
  const double gap = findCheck(validateOutside(here.scenario, here.solver()).checks, "torque.between")->gap;
  const double end = here.scenario.trajectory->duration();
  for (const double share : {0.013, 0.372, 0.611, 0.987}) {
    OutsideSolver wrong = here.solver();
    wrong.torques = [right = wrong.torques, from = share * end, gap](const std::vector<Motion<double>>& motions) {
      std::vector<Vector6d> out = right(motions);
      for (std::size_t k = 0; k < out.size(); ++k)
        if (motions[k].t > from && motions[k].t < from + gap) out[k](1) += 1;
      return out;
    };
    EXPECT_TRUE(fails(validateOutside(here.scenario, wrong).checks, "torque.between")) << share;
  }
}

/// One that is right until it is asked the same again.
TEST(OutsideSolver, whatIsRightOnlyOnceFails) {
  const Case here;
  OutsideSolver wrong = here.solver();
  const auto asked = std::make_shared<std::vector<double>>();
  wrong.torques = [right = wrong.torques, asked](const std::vector<Motion<double>>& motions) {
    std::vector<Vector6d> out = right(motions);
    for (std::size_t k = 0; k < out.size(); ++k) {
      if (std::find(asked->begin(), asked->end(), motions[k].t) != asked->end()) out[k](0) += 1;
      asked->push_back(motions[k].t);
    }
    return out;
  };
  EXPECT_EQ(validateOutside(here.scenario, wrong).verdict, Verdict::fail);
}

TEST(OutsideSolver, quickAsksTheSamplesAlone) {
  const Case here;
  std::size_t asked = 0;
  ValidationOptions quick;
  quick.quick = true;
  const ValidationResult result =
      validateOutside(here.scenario, here.solver([&asked](std::size_t motions) { asked += motions; }), quick);
  EXPECT_EQ(asked, 11u);
  EXPECT_EQ(result.verdict, Verdict::pass);
  for (const char* name : {"torque.between", "replay.position", "integration.ladder", "feedback.torque"})
    EXPECT_EQ(findCheck(result.checks, name)->verdict, Verdict::not_applicable) << name;
  EXPECT_EQ(findCheck(result.checks, "torque.pointwise")->verdict, Verdict::pass);
}

struct Broke {
  int what;
};

TEST(OutsideSolver, whatItThrowsArrivesWhereverItIsThrown) {
  const Case here;
  int all = 0;
  validateOutside(here.scenario, here.solver([&all](std::size_t) { ++all; }), thorough());
  ASSERT_GT(all, 100);
  // Not nearer to the end: how many questions a replay in several threads asks together differs from run to run.
  for (int last : {1, 3, all / 3, 2 * all / 3, 9 * all / 10}) {
    int calls = 0;
    const auto breaks = [&](std::size_t) {
      if (++calls >= last) throw Broke{last};
    };
    try {
      validateOutside(here.scenario, here.solver(breaks), thorough());
      ADD_FAILURE() << "nothing was thrown at call " << last;
    } catch (const Broke& broke) {
      EXPECT_EQ(broke.what, last);
    }
    EXPECT_EQ(calls, last) << "it was asked again";
  }
}

TEST(OutsideSolver, anErrorOfThisProgramsKindIsNoAnswerEither) {
  const Case here;
  int calls = 0;
  const auto breaks = [&calls](std::size_t) {
    if (++calls > 40) throw std::runtime_error("mine");  // in a replay, where the loop's own make a result
  };
  EXPECT_THAT([&] { validateOutside(here.scenario, here.solver(breaks), thorough()); },
              testing::ThrowsMessage<std::runtime_error>("mine"));
}

TEST(OutsideSolver, aWrongNumberOfAnswersIsRefused) {
  const Case here;
  OutsideSolver few = here.solver();
  few.torques = [](const std::vector<Motion<double>>&) { return std::vector<Vector6d>(1, Vector6d::Zero()); };
  EXPECT_THAT([&] { validateOutside(here.scenario, few); },
              testing::ThrowsMessage<std::invalid_argument>(HasSubstr("outside: 1 answers to 11 motions")));
}

/// A slow process is not silent: each answer is progress.
TEST(ExternalSolver, everyAnswerIsTold) {
  const Case here;
  std::vector<double> shares;
  ValidationOptions options;
  options.progress = [&shares](double share, const char* now) {
    EXPECT_STREQ(now, "asking the solver");
    shares.push_back(share);
  };
  ExternalSolverOptions zeros;
  zeros.command = "while read line; do echo 0,0,0,0,0,0; done";
  EXPECT_EQ(validateExternalSolver(here.scenario, zeros, options).verdict, Verdict::fail);
  ASSERT_GT(shares.size(), 100u);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_GT(shares.front(), 0);
  EXPECT_LT(shares.back(), 1);
}

TEST(ExternalSolver, questionsAreTheMotionToTheLastBit) {
  Motion<double> motion;
  motion.t = 0.1;
  motion.p = {1.0 / 3, -2, 3e-300};
  motion.Q << 1, 0, 0, 0, -1, 0, 0, 0, -1;  // half a turn about x
  motion.p_dot = {4, 5, 6};
  motion.omega = {7, 8, 9};
  motion.p_ddot = {10, 11, 12};
  motion.omega_dot = {13, 14, 15};
  EXPECT_EQ(solverQuestion(motion),
            "0.10000000000000001,0.33333333333333331,-2,3.0000000000000002e-300,0,1,0,0,4,5,6,7,8,9,10,11,12,13,14,15");
}

TEST(ExternalSolver, answersAreSixNumbers) {
  Vector6d expected;
  expected << 1, -2.5, 3e2, 0.1, 5, 6;
  EXPECT_EQ(solverAnswer("1,-2.5,+3e2, 0.1 ,5,6\r"), expected);
  // Smaller than any double, which is no reason to refuse it.
  EXPECT_EQ(solverAnswer("1e-400,-1e-400,+1e-99999,0." + std::string(400, '0') + "1,1e-400,0e400"), Vector6d::Zero());
  for (const char* bad : {"", "1,2,3,4,5", "1,2,3,4,5,6,", "1,2,3,4,5,six", "1,2,,4,5,6", "1,2,3,4,5,0x6",
                          "1;2;3;4;5;6", "1,2,3,4,5,1e999", "1,2,3,4,5,6 7"})
    EXPECT_THROW(solverAnswer(bad), SolverProcessError) << bad;
}

}  // namespace
}  // namespace ursula

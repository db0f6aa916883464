// Results that many subjects share equal those that each would get alone; a subject that differs gets its own.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <thread>

#include "tests/support/numbers.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/checks/judges.h"
#include "validation/evidence/evidence.h"
#include "validation/evidence/reference.h"
#include "validation/replay/asked_torques.h"

namespace ursula {
namespace {

Vector6d constant(double value) { return Vector6d::Constant(value); }

/// The record of questions at 0, 1 and 2.
AskedTorques askedOf(const SimbodyLoop::TorqueHistory& torques) {
  AskedTorques asked;
  const SimbodyLoop::TorqueHistory listening = asked.recorded(torques);
  for (double t : {0.0, 1.0, 2.0}) EXPECT_EQ(listening(t), torques(t));
  return asked;
}

TEST(AskedTorques, areTheSameFromWhoeverAnswersTheSame) {
  const auto line = [](double t) { return constant(1 + t); };
  const AskedTorques asked = askedOf(line);
  EXPECT_TRUE(asked.sameFrom(line));
  EXPECT_TRUE(asked.sameFrom([](double t) { return constant(t == 1.5 ? 7 : 1 + t); })) << "nobody asked there";
  for (double at : {0.0, 1.0, 2.0})
    EXPECT_FALSE(asked.sameFrom([at](double t) { return constant((1 + t) * (t == at ? 1 + eps : 1)); })) << at;
  EXPECT_FALSE(asked.sameFrom([](double t) { return Vector6d(constant(1 + t) + 1e-15 * Vector6d::Unit(5)); }));
}

TEST(AskedTorques, differInAnyBit) {
  const AskedTorques zeros = askedOf([](double) { return constant(0); });
  EXPECT_TRUE(zeros.sameFrom([](double) { return constant(0); }));
  EXPECT_FALSE(zeros.sameFrom([](double) { return constant(-0.0); }));
  EXPECT_FALSE(zeros.sameFrom([](double) { return constant(std::nan("")); }));
}

TEST(AskedTorques, whoeverThrowsIsAskedHimself) {
  const auto throws = [](double t) { return t < 2 ? constant(0) : throw std::runtime_error("no answer"); };
  const auto zero = [](double) { return constant(0); };
  EXPECT_FALSE(askedOf(zero).sameFrom(throws));
  AskedTorques asked;
  const SimbodyLoop::TorqueHistory history = throws, listening = asked.recorded(history);
  listening(1);
  EXPECT_TRUE(asked.sameFrom(zero));
  EXPECT_THROW(listening(2), std::runtime_error);
  EXPECT_FALSE(asked.sameFrom(zero)) << "there was no answer";
}

TEST(AskedTorques, nothingAskedSaysNothing) {
  const auto zero = [](double) { return constant(0); };
  AskedTorques asked;
  EXPECT_FALSE(asked.sameFrom(zero));
  asked.add(askedOf(zero));
  EXPECT_TRUE(asked.sameFrom(zero));
  asked.add(askedOf([](double t) { return constant(t); }));
  EXPECT_FALSE(asked.sameFrom(zero)) << "what was added counts";
}

TEST(Lazy, makesOnceForAllThreadsAndAgainAfterAFailure) {
  Lazy<int> value;
  std::atomic<int> made{0};
  EXPECT_THROW(value.get([]() -> int { throw std::domain_error("not yet"); }), std::domain_error);
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k) threads.emplace_back([&] { EXPECT_EQ(value.get([&] { return 7 + made++; }), 7); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(made, 1);
}

class Shared : public testing::TestWithParam<std::string> {
 protected:
  const Scenario& here() const { return reference_->scenario; }
  /// The right torques times `factor` at t.
  Subject scaled(const std::function<double(double t)>& factor) const {
    return changedTorques(solverOf(here()), [factor](const Motion<double>& motion, const Vector6d& torques) {
      return Vector6d(factor(motion.t) * torques);
    });
  }
  SimbodyLoop::TorqueHistory historyOf(const Subject& subject) const {
    return [this, subject](double t) { return subject.torques(here().trajectory->at(t)); };
  }

  Scenario given_ = scenarioOf(GetParam(), 31);
  std::shared_ptr<const Reference> reference_ = referenceOf(GetParam(), 31);
};

TEST_P(Shared, theLoopSaysTheSameWhateverItWasAskedBefore) {
  SimbodyLoop loop(*here().manipulator, SimbodyLoop::Topology::ball_per_leg, here().load);
  const Subject right = solverOf(here());
  for (std::size_t k = reference_->instants.size(); k-- > 0;) {  // in reverse order
    const SimbodyAnswer& known = reference_->simbody()[k];
    const Motion<double> motion = here().trajectory->at(reference_->instants[k]);
    ASSERT_TRUE(known.right.has_value());
    const Vector6d torques = right.torques(motion);
    const Vector6d shared = known.twistRateUnder(torques, loop, motion);
    loop.place(motion);
    EXPECT_EQ(loop.inverseDynamics(), known.torques);
    loop.accelerate(torques);
    EXPECT_EQ(loop.platform().p_ddot, shared.tail<3>());
    EXPECT_EQ(loop.platform().omega_dot, shared.head<3>());
    EXPECT_GT((known.twistRateUnder(1.001 * torques, loop, motion) - shared).norm(), 0);
  }
}

TEST_P(Shared, replaysAskAtAllThatTheyDependOn) {
  const WindowedReplay& window = reference_->replays().windows.front();
  const double middle = (window.window.start() + window.window.end()) / 2;
  const auto run = [&](const Subject& subject) {
    return replay(here(), historyOf(subject), settingsOf(here(), reference_->replays().plan, window.window, 1));
  };
  const Subject same = scaled([](double) { return 1.0; });
  const Subject late = scaled([middle](double t) { return t < middle ? 1 : 1 + 4 * eps; });
  EXPECT_TRUE(window.replay.asked.sameFrom(historyOf(same)));
  EXPECT_EQ(run(same).steps.back().position_error, window.replay.steps.back().position_error);
  EXPECT_FALSE(window.replay.asked.sameFrom(historyOf(late)));
  EXPECT_NE(run(late).steps.back().position_error, window.replay.steps.back().position_error);
  EXPECT_TRUE(reference_->ladder().asked.sameFrom(historyOf(same)));
  EXPECT_FALSE(reference_->ladder().asked.sameFrom(historyOf(late)));
}

TEST_P(Shared, theLadderIsTheOneClimbedAlone) {
  WindowedReplay window = reference_->replays().windows.front();
  ASSERT_NE(window.coarse, nullptr);
  window.coarse = nullptr;  // then no rung is known
  const Ladder alone = replayLadder(here(), reference_->replays().plan.torques, window);
  const Ladder& shared = reference_->ladder();
  ASSERT_EQ(alone.rungs.size(), shared.rungs.size());
  for (std::size_t k = 0; k < alone.rungs.size(); ++k) {
    EXPECT_EQ(alone.rungs[k].distance, shared.rungs[k].distance);
    EXPECT_GT(shared.rungs[k].distance, 0);
  }
  EXPECT_EQ(alone.second_difference, shared.second_difference);
}

TEST_P(Shared, theStabilisedReplayStandsForTheSameTorquesOnly) {
  const StabilisedReplay& known = reference_->stabilised();
  const auto judge = [&](const Subject& subject, const StabilisedReplay* with) {
    const RoundingAlong& rounding = reference_->rounding();
    return judgeStabilised(
        stabilisedReplay(here(), subject, reference_->replays().amplification, rounding.along(), with),
        rounding.profile.sizes().of(Rounded::torque));
  };
  const Check alone = judge(solverOf(here()), nullptr), shared = judge(solverOf(here()), &known);
  EXPECT_EQ(alone.verdict, Verdict::pass);
  EXPECT_EQ(alone.value, shared.value);
  EXPECT_EQ(alone.limit, shared.limit);
  EXPECT_EQ(alone.why, shared.why);
  const double end = here().trajectory->duration();
  const Subject wrong = scaled([end](double t) { return t < 0.7 * end ? 1 : 1 + 1e-6; });
  const Check of_wrong = judge(wrong, &known);
  EXPECT_EQ(of_wrong.verdict, Verdict::fail);
  EXPECT_EQ(of_wrong.value, judge(wrong, nullptr).value);
  EXPECT_GT(of_wrong.value, alone.value);
}

/// After other subjects, also a wrong one, used the shared results, every check is the same as alone.
TEST_P(Shared, everyCheckIsTheOneOfAValidationAlone) {
  ValidationOptions options;
  options.budget = false;
  const auto off = [](double factor) -> SubjectOf {
    return [factor](const Scenario& s) { return scaledTorques(solverOf(s), factor); };
  };
  for (double factor : {1 + 1e-8, 1.0}) {
    options.reference = nullptr;
    const std::vector<Check> alone = validateMade(given_, off(factor), options).checks;
    options.reference = reference_;
    const std::vector<Check> shared = validateMade(given_, off(factor), options).checks;
    ASSERT_EQ(alone.size(), shared.size());
    EXPECT_EQ(verdictOf(shared, "torque.pointwise"), factor == 1 ? "pass" : "fail");
    EXPECT_EQ(verdictOf(shared, "feedback.torque"), factor == 1 ? "pass" : "fail");
    for (std::size_t k = 0; k < alone.size(); ++k) {
      EXPECT_EQ(alone[k].verdict, shared[k].verdict) << alone[k].name;
      EXPECT_EQ(alone[k].why, shared[k].why) << alone[k].name;
      if (!std::isnan(alone[k].value)) {
        EXPECT_EQ(alone[k].value, shared[k].value) << alone[k].name;
      }
    }
  }
}

/// A subject that answers many questions at once is told of each step. It is not asked one by one whether it answers
/// alike.
TEST_P(Shared, whoeverWantsToForeseeHasReplaysOfHisOwn) {
  Subject subject = solverOf(here());
  const auto told = std::make_shared<int>(0);
  subject.foresee = [told](const std::vector<Motion<double>>&) { ++*told; };
  const Evidence evidence = gather(given_, *reference_, subject, false, {}, {});
  EXPECT_GE(*told, evidence.windows.front().replay.accepted + evidence.stabilised->steps);
  EXPECT_EQ(evidence.windows.front().replay.steps.back().position_error,
            reference_->replays().windows.front().replay.steps.back().position_error);
  EXPECT_EQ(evidence.stabilised->torque, reference_->stabilised().torque);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Shared, testing::Values("paper-helix", "proving-ground"),
                         [](const auto& name) { return asTestName(name.param); });

}  // namespace
}  // namespace ursula

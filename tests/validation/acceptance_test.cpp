// A user's limits apply to the largest value, wherever the value nearest to its derived limit is. They never excuse a
// check that was unfinished or not made.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "report/files/report.h"
#include "report/files/written_files.h"
#include "tests/support/matchers.h"
#include "tests/support/numbers.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/checks/tolerance.h"

namespace ursula {
namespace {

ValidationResult judgedBy(const std::vector<AcceptanceLimit>& acceptance, const std::vector<Check>& checks) {
  ValidationResult result;
  result.scenario = "made";
  result.checks = checks;
  judgeByUser(acceptance, result);
  return result;
}

/// A check whose value 1 is nearest to its derived limit, and whose largest value 5 is far from it.
Check twoWorsts() {
  Check check = judged("torque.pointwise", 1, 2, "N m", "derived", "found");
  check.largest = {5, 0.75, "leg 3"};
  return check;
}

TEST(UserLimits, areHeldAgainstTheLargestValueNotTheNearestToItsLimit) {
  const Check between = judgedBy({{"torque.pointwise", 3}}, {twoWorsts()}).checks.front();
  EXPECT_EQ(between.verdict, Verdict::fail);
  EXPECT_EQ(between.value, 5);
  EXPECT_EQ(between.limit, 3);
  EXPECT_EQ(between.largest.value, 5);
  EXPECT_THAT(between.why, AllOf(HasSubstr("t = 0.75 s"), HasSubstr("leg 3")));
  EXPECT_THAT(between.basis, AllOf(HasSubstr("[acceptance]"), HasSubstr("derived: 2")));
  EXPECT_EQ(judgedBy({{"torque.pointwise", 5}}, {twoWorsts()}).verdict, Verdict::pass);
}

TEST(UserLimits, thatAreWiderDecideAndAreNamed) {
  const ValidationResult wider = judgedBy({{"torque.pointwise", 6}}, {judged("other", 1, 2, "m", "", ""), twoWorsts()});
  EXPECT_EQ(wider.verdict, Verdict::pass);
  EXPECT_EQ(wider.limits, LimitBy::user);
  EXPECT_EQ(wider.checks[1].limit_by, LimitBy::user);
  EXPECT_EQ(wider.checks[0].limit_by, LimitBy::derived);
  const nlohmann::json summary = nlohmann::json::parse(report::summaryJson(wider));
  EXPECT_EQ(summary.at("limits"), "user");
  EXPECT_EQ(summary.at("checks")[1].at("limit_by"), "user");
  EXPECT_THAT(summary.at("reason").get<std::string>(), HasSubstr("1 at the user's limits, wider than the derived"));
}

TEST(UserLimits, thatAreTighterAndHoldLeaveTheDerivedOnesTheLimits) {
  const Check check = judged("torque.pointwise", 1, 4, "N m", "derived", "found");
  const ValidationResult tighter = judgedBy({{"torque.pointwise", 2}}, {check});
  EXPECT_EQ(tighter.verdict, Verdict::pass);
  EXPECT_EQ(tighter.limits, LimitBy::derived);
  EXPECT_EQ(tighter.checks.front().limit, 2);
  const nlohmann::json summary = nlohmann::json::parse(report::summaryJson(tighter));
  EXPECT_EQ(summary.at("limits"), "derived");
  EXPECT_EQ(summary.at("reason").get<std::string>().find("user"), std::string::npos);
  EXPECT_EQ(judgedBy({{"torque.pointwise", 0.5}}, {check}).verdict, Verdict::fail);
}

TEST(UserLimits, liftALimitThatSaysNothing) {
  const Check useless =
      notJudgeable(Reason::limit_useless, "replay.position", 1e-9, 1e-3, "m", "derived", "says nothing");
  EXPECT_EQ(judgedBy({}, {useless}).verdict, Verdict::inconclusive);
  for (const double limit : {1e-8, 1e-2}) {  // wider or not, because there was no useful limit
    const ValidationResult removed = judgedBy({{"replay.position", limit}}, {useless});
    EXPECT_EQ(removed.verdict, Verdict::pass);
    EXPECT_EQ(removed.limits, LimitBy::user);
  }
  EXPECT_EQ(judgedBy({{"replay.position", 1e-10}}, {useless}).verdict, Verdict::fail);
}

TEST(UserLimits, liftNothingElseThatWasNotJudged) {
  for (const Reason reason : {Reason::unfinished, Reason::not_covered}) {
    const Check open = notJudgeable(reason, "replay.position", 1e-9, 1e-3, "m", "derived", "stopped");
    const ValidationResult result = judgedBy({{"replay.position", 1}}, {open});
    EXPECT_EQ(result.verdict, Verdict::inconclusive) << name(reason);
    EXPECT_EQ(result.limits, LimitBy::derived) << name(reason);
    EXPECT_THAT(result.checks.front().why, AllOf(HasSubstr("stopped"), HasSubstr("no finished value")));
  }
  const ValidationResult failed = judgedBy({{"replay.position", 1}}, {notMade("replay.position", "m", "gave up")});
  EXPECT_EQ(failed.verdict, Verdict::fail);
  EXPECT_EQ(failed.limits, LimitBy::derived);
}

TEST(UserLimits, ofACheckThatWasNotMadeFail) {
  EXPECT_EQ(judgedBy({{"torque.pontwise", 1}}, {twoWorsts()}).verdict, Verdict::fail);
}

TEST(UserLimits, acceptNoNaN) {
  Check check = judged("torque.pointwise", nan, 2, "N m", "derived", "found");
  EXPECT_EQ(judgedBy({{"torque.pointwise", 1e9}}, {check}).verdict, Verdict::fail);
  check.value = 1;
  check.largest.value = nan;
  EXPECT_EQ(judgedBy({{"torque.pointwise", 1e9}}, {check}).verdict, Verdict::fail);
  EXPECT_EQ(judgedBy({{"torque.pointwise", nan}}, {twoWorsts()}).verdict, Verdict::fail);
}

/// The paper's machine with the third motor's torque a thousandth too large, by 25 N·m.
class LegThree : public testing::Test {
 protected:
  ValidationResult run(double limit) const {
    Scenario scenario = scenarioOf("paper-helix", 31);
    scenario.acceptance = {{"torque.pointwise", limit}};
    const Subject subject = changedTorques(torquesAlone(scenario), [](const auto&, Vector6d torques) {
      torques(2) *= 1.001;
      return torques;
    });
    return validate(scenario, subject, {false, false, false, referenceOf("paper-helix", 31)});
  }
};

TEST_F(LegThree, failsALimitThatIsBelowWhatItIsOffByAndPassesOneAbove) {
  const ValidationResult strict = run(15);
  const Check& fails = *findCheck(strict.checks, "torque.pointwise");
  EXPECT_EQ(fails.verdict, Verdict::fail);
  EXPECT_NEAR(fails.value, 25, 1);
  EXPECT_EQ(fails.largest.where, "leg 3");
  const ValidationResult lax = run(30);
  EXPECT_EQ(verdictOf(lax.checks, "torque.pointwise"), "pass");
  EXPECT_EQ(lax.limits, LimitBy::user);
  EXPECT_EQ(lax.verdict, Verdict::fail) << "the other checks keep their own limits";
}

}  // namespace
}  // namespace ursula

// Somebody else's torques judged: exact ones are never called wrong, wrong ones never pass, few ones are inconclusive.

#include "validation/validate.h"

#include <gtest/gtest.h>

#include "tests/support/matchers.h"
#include "tests/validation/checks.h"
#include "tests/validation/external_torques.h"

namespace ursula {
namespace {

std::string finding(const ValidationResult& result, const std::string& key) {
  for (const Finding& each : result.findings)
    if (each.name == key) return textOf(each);
  return "(none)";
}

TEST(External, exactTorquesPass) {
  for (int count : {31, 301}) {
    const ValidationResult result = validateExternal(helix(), exactTorques(helix(), count).file());
    EXPECT_EQ(others(result.checks, Verdict::pass), "") << count;
    EXPECT_EQ(result.verdict, Verdict::pass);
    EXPECT_EQ(finding(result, "likely cause"), "(none)");
    EXPECT_EQ(result.timeseries.rows(), static_cast<std::size_t>(count));
  }
}

TEST(External, everyVectorsExactTorquesPassPointwiseAndFailNowhere) {
  for (const std::string& name : vectorNames()) {
    const Scenario scenario = vectorScenario(name);
    const ValidationResult result = validateExternal(scenario, exactTorques(scenario, 101).file());
    EXPECT_EQ(firstFailing(result.checks), "(none)") << name << ": " << others(result.checks, Verdict::pass);
    EXPECT_EQ(verdictOf(result.checks, "torque.pointwise"), "pass");
  }
}

TEST(External, anErrorOfOnePartIn1e8FailsOnBothEngines) {
  for (int count : {31, 301}) {
    const TorqueTable wrong = exactTorques(helix(), count).changed([](std::size_t, Vector6d& tau) { tau *= 1 + 1e-8; });
    const ValidationResult result = validateExternal(helix(), wrong.file());
    EXPECT_EQ(result.verdict, Verdict::fail);
    for (const char* name : {"torque.pointwise", "acceleration.pointwise", "torque.against_noc"})
      EXPECT_EQ(verdictOf(result.checks, name), "fail") << name;
    EXPECT_THAT(findCheck(result.checks, "torque.pointwise")->off,
                HasSubstr("Off: all legs by up to 0.0002507 N m (1e-06 % of the largest torque), from t = 0 to 3 s"));
    EXPECT_THAT(findCheck(result.checks, "torque.pointwise")->off, HasSubstr("Likely cause: every torque scaled by"));
    EXPECT_THAT(finding(result, "likely cause"), HasSubstr("scaled by 1 + 1e-08,"));
  }
}

TEST(External, wrongTorquesFailTheReplayAsWell) {
  const TorqueTable wrong = exactTorques(helix(), 301).changed([](std::size_t, Vector6d& tau) { tau(2) += 0.1; });
  const ValidationResult result = validateExternal(helix(), wrong.file());
  EXPECT_EQ(verdictOf(result.checks, "replay.position"), "fail");
  EXPECT_EQ(verdictOf(result.checks, "replay.orientation"), "fail");
}

TEST(External, sixDigitsWidenTheLimitByHalfOfTheLast) {
  const TorqueTable exact = exactTorques(helix(), 61);
  const ValidationResult result = validateExternal(helix(), exact.printed("{:.6g}"));
  const Check& torque = *findCheck(result.checks, "torque.pointwise");
  EXPECT_EQ(torque.verdict, Verdict::pass);
  EXPECT_GT(torque.limit, 0.01);
  EXPECT_LT(torque.limit, 0.0501);
  EXPECT_THAT(torque.basis, HasSubstr("half a unit of the last digit printed (torques of up to 6 significant digits"));
  EXPECT_EQ(firstFailing(result.checks), "(none)");
  // The controls: the same numbers claimed to more digits, and others that are off by one unit of the last.
  EXPECT_EQ(validateExternal(helix(), exact.printed("{:.5e}")).verdict, result.verdict);
  const TorqueFile rounded = exact.printed("{:.6g}");
  EXPECT_EQ(validateExternal(helix(), TorqueTable{rounded.t, rounded.torques}.printed("{:.16e}")).verdict,
            Verdict::fail);
  const TorqueTable off = exact.changed([](std::size_t, Vector6d& tau) { tau(2) *= 1.0001; });
  EXPECT_EQ(validateExternal(helix(), off.printed("{:.6g}")).verdict, Verdict::fail);
}

TEST(External, tooFewSamplesLeaveTheReplayOpen) {
  for (int count : {2, 5, 6, 8}) {
    const ValidationResult result = validateExternal(helix(), exactTorques(helix(), count).file());
    EXPECT_EQ(result.verdict, Verdict::inconclusive) << count;
    for (const char* name : {"torque.pointwise", "acceleration.pointwise", "torque.against_noc"})
      EXPECT_EQ(verdictOf(result.checks, name), "pass") << name;
    for (const char* name : {"replay.position", "replay.orientation", "closure.position", "energy.balance"})
      EXPECT_EQ(verdictOf(result.checks, name), "inconclusive") << name;
    EXPECT_THAT(findCheck(result.checks, "replay.position")->why, HasSubstr("too few samples"));
  }
}

/// A hole in a file of many rows is what is wanting, and not rows; where all gaps are alike, none is the widest.
TEST(External, aHoleIsNamedByItsEnds) {
  TorqueTable torques = exactTorques(helix(), 301);
  torques.t.erase(torques.t.begin() + 101, torques.t.begin() + 200);
  torques.torques.erase(torques.torques.begin() + 101, torques.torques.begin() + 200);
  const ValidationResult result = validateExternal(helix(), torques.file());
  EXPECT_EQ(result.verdict, Verdict::inconclusive);
  EXPECT_THAT(findCheck(result.checks, "replay.position")->why,
              HasSubstr("no sample between t = 1 and 2 s, the widest gap"));
  EXPECT_THAT(findCheck(validateExternal(helix(), exactTorques(helix(), 8).file()).checks, "replay.position")->why,
              HasSubstr("too few samples or digits"));
}

TEST(External, theRowsThatAreSaidToDoAreJudgedAndMuchFewerAreNot) {
  for (const int count : {5, 8}) {
    const ValidationResult sparse = validateExternal(helix(), exactTorques(helix(), count).file());
    ASSERT_TRUE(sparse.needed) << count;
    const auto enough = static_cast<int>(sparse.needed->rows);
    EXPECT_EQ(sparse.needed->given, static_cast<std::size_t>(count));
    EXPECT_THAT(findCheck(sparse.checks, "replay.position")->why,
                HasSubstr(std::to_string(enough) + " equally spaced rows"));
    const ValidationResult result = validateExternal(helix(), exactTorques(helix(), enough).file());
    EXPECT_EQ(result.verdict, Verdict::pass) << enough << ": " << firstFailing(result.checks);
    EXPECT_FALSE(result.needed);
    EXPECT_EQ(validateExternal(helix(), exactTorques(helix(), 3 * enough / 4).file()).verdict, Verdict::inconclusive);
  }
  const ValidationResult coarse = validateExternal(helix(), exactTorques(helix(), 8).printed("{:.3g}"));
  EXPECT_FALSE(coarse.needed);
  EXPECT_THAT(findCheck(coarse.checks, "replay.position")->why, HasSubstr("give more digits"));
}

TEST(External, aPartOfTheMotionLeavesTheReplayOpen) {
  TorqueTable part = exactTorques(helix(), 61);
  part.t.erase(part.t.begin());
  part.torques.erase(part.torques.begin());
  const ValidationResult result = validateExternal(helix(), part.file());
  EXPECT_EQ(result.verdict, Verdict::inconclusive);
  EXPECT_THAT(findCheck(result.checks, "replay.position")->why, HasSubstr("the samples cover 0.05 to 3 s"));
}

TEST(External, oneSampleIsJudgedPointwise) {
  TorqueTable one = exactTorques(helix(), 3);
  one.t = {one.t[1]};
  one.torques = {one.torques[1]};
  EXPECT_EQ(validateExternal(helix(), one.file()).verdict, Verdict::inconclusive);
  one.torques[0](4) += 1e-5;
  const ValidationResult wrong = validateExternal(helix(), one.file());
  EXPECT_EQ(wrong.verdict, Verdict::fail);
  EXPECT_THAT(findCheck(wrong.checks, "torque.pointwise")->off, HasSubstr("Off: leg 5 by up to 1e-05 N m"));
}

TEST(External, wrongTorquesDoNotWidenTheirOwnLimit) {
  const TorqueTable exact = exactTorques(helix(), 61);
  const TorqueTable wild = exact.changed([](std::size_t k, Vector6d& tau) { tau(0) += k % 2 == 0 ? 50 : -50; });
  EXPECT_EQ(finding(validateExternal(helix(), wild.file()), "spline"),
            finding(validateExternal(helix(), exact.file()), "spline"));
}

TEST(External, theScenariosOwnLimitsHold) {
  Scenario strict = helix();
  strict.acceptance = {{"torque.pointwise", 1e-30}};
  EXPECT_EQ(validateExternal(strict, exactTorques(helix(), 31).file()).verdict, Verdict::fail);
}

}  // namespace
}  // namespace ursula

// A user's tolerance judges torques; their effect on the motion is reported.

#include <gtest/gtest.h>

#include <cmath>

#include "report/files/report.h"
#include "tests/support/matchers.h"
#include "tests/validation/checks.h"
#include "tests/validation/external_torques.h"
#include "tests/validation/scenario_files.h"
#include "validation/checks/tolerance.h"
#include "validation/validate.h"

namespace ursula {
namespace {

constexpr int all_samples = 301;

/// The verdict on torques that `change` makes of the right ones.
ValidationResult judgedWith(const std::string& name, const std::optional<EffortTolerance>& tolerance,
                            const TorqueChange& change) {
  Scenario scenario = scenarioOf(name);
  scenario.tolerance = tolerance;
  Subject subject = changedTorques(solverOf(scenario), change);
  subject.rebuilt = nullptr;
  ValidationOptions quick{false, false, false};
  quick.reference = referenceOf(name, all_samples);
  return validate(scenario, subject, quick);
}

/// The paper's helix with torques of leg 3 that are too large by a share.
ValidationResult judgedWith(double error, const std::optional<EffortTolerance>& tolerance) {
  return judgedWith("paper-helix", tolerance, [error](const auto&, Vector6d torques) {
    torques(2) *= 1 + error;
    return torques;
  });
}

TEST(Tolerance, passesWhatIsWithinAndSaysWhose) {
  const ValidationResult result = judgedWith(1e-3, EffortTolerance{1.1e-3, 0});
  EXPECT_EQ(result.verdict, Verdict::pass);
  EXPECT_EQ(result.limits, LimitBy::user);
  ASSERT_TRUE(result.deviation);
  EXPECT_GT(result.deviation->largest, 1);
  EXPECT_LE(result.deviation->relative(), 1e-3 * (1 + 1e-9));
  EXPECT_EQ(result.deviation->where, "leg 3");
  EXPECT_GT(result.deviation->drift, 0);
  const Check* replay = findCheck(result.checks, "replay.position");
  EXPECT_EQ(replay->verdict, Verdict::not_applicable);
  EXPECT_EQ(replay->reason, Reason::reported);
}

TEST(Tolerance, failsWhatIsBeyond) {
  EXPECT_EQ(judgedWith(1e-3, EffortTolerance{1e-5, 0}).verdict, Verdict::fail);
  EXPECT_EQ(judgedWith(1e-3, std::nullopt).verdict, Verdict::fail);
}

TEST(Tolerance, theSmallestThatIsNamedPassesAndALittleLessDoesNot) {
  const ValidationResult result = judgedWith(1e-4, std::nullopt);
  ASSERT_TRUE(result.deviation);
  const double smallest = result.deviation->smallestRelative();
  ASSERT_GT(smallest, 0);
  EXPECT_EQ(judgedWith(1e-4, EffortTolerance{smallest, 0}).verdict, Verdict::pass);
  EXPECT_EQ(judgedWith(1e-4, EffortTolerance{0.99999 * smallest, 0}).verdict, Verdict::fail);
}

TEST(Tolerance, addsBothParts) {
  const ValidationResult result = judgedWith(1e-3, std::nullopt);
  const double largest = result.deviation->largest, effort = result.deviation->largest_effort;
  EXPECT_EQ(judgedWith(1e-3, EffortTolerance{0.6 * largest / effort, 0.6 * largest}).verdict, Verdict::pass);
  EXPECT_EQ(judgedWith(1e-3, EffortTolerance{0.4 * largest / effort, 0.4 * largest}).verdict, Verdict::fail);
}

/// Three legs of 0.5 m have two motors each, one that rotates and one that slides. Newtons and newton metres are
/// compared by their numbers.
TEST(Tolerance, isPlainNumbersForMotorsOfBothSorts) {
  const auto judged = [](int motor, double error) {
    return judgedWith(
               "three-legs", EffortTolerance{0, 5},
               [=](const auto&, const Vector6d& torques) { return Vector6d(torques + error * Vector6d::Unit(motor)); })
        .verdict;
  };
  for (const int motor : {0, 1}) {
    EXPECT_EQ(judged(motor, 4.9), Verdict::pass) << "motor " << motor + 1;
    EXPECT_EQ(judged(motor, 5.1), Verdict::fail) << "motor " << motor + 1;
  }
}

TEST(Tolerance, noNumberIsNeverWithin) {
  const ValidationResult result = judgedWith(std::nan(""), EffortTolerance{1, 1e9, true});
  EXPECT_EQ(result.verdict, Verdict::fail);
}

TEST(EffortDeviation, keepsWhatIsNoNumberInAnyOrder) {
  const Scenario scenario = scenarioOf("paper-helix");
  Evidence evidence;
  evidence.given = evidence.scenario = &scenario;
  evidence.samples.resize(1);
  const auto with = [&evidence](double a, double b) {
    std::vector<Check> checks = {judged("torque.pointwise", a, 1, "N m", "", ""),
                                 judged("torque.twin", b, 1, "N m", "", "")};
    for (Check& check : checks) check.missed = check.value;
    return *effortDeviation(evidence, checks);
  };
  const double nan = std::nan("");
  EXPECT_TRUE(std::isnan(with(nan, 2).largest) && std::isnan(with(2, nan).largest));
  EXPECT_TRUE(std::isnan(with(nan, nan).seen));
  EXPECT_EQ(with(nan, 2).seen, 2) << "one check would have failed";
  EXPECT_EQ(with(2, nan).seen, 2);
  EXPECT_EQ(with(3, 2).seen, 2);
  EXPECT_EQ(with(2, 3).seen, 2);
  EXPECT_EQ(with(2, 3).largest, 3);
}

/// The headline's two numbers are of one check.
TEST(EffortDeviation, saysHowLargeAndHowLongAnErrorIsSeen) {
  const Scenario scenario = scenarioOf("paper-helix");
  Evidence evidence;
  evidence.given = evidence.scenario = &scenario;
  evidence.samples.resize(3);
  for (std::size_t k = 0; k < 3; ++k) evidence.samples[k].motion.t = std::pow(static_cast<double>(k), 2) / 100;
  std::vector<Check> checks = {judged("torque.pointwise", 1, 1, "N m", "", "")};
  checks[0].missed = 1e-13;
  EXPECT_EQ(effortDeviation(evidence, checks)->seen, 1e-13);
  EXPECT_DOUBLE_EQ(effortDeviation(evidence, checks)->seen_for, 0.03) << "the widest gap of the samples";
  checks.push_back(judged("torque.between", 1, 1, "N m", "", ""));
  checks[1].missed = 3e-13, checks[1].gap = 5e-4;
  EXPECT_EQ(effortDeviation(evidence, checks)->seen, 3e-13);
  EXPECT_EQ(effortDeviation(evidence, checks)->seen_for, 5e-4);
}

/// Efforts are expected from the other formulations, and a tolerance has to cover all.
TEST(EffortDeviation, leavesOutTheOddEngine) {
  const Scenario scenario = scenarioOf("paper-helix");
  Evidence evidence;
  evidence.given = evidence.scenario = &scenario;
  evidence.samples.resize(1);
  std::vector<Check> checks;
  for (const auto& [check, error] : {std::pair("torque.pointwise", 3.0), {"torque.twin", 4.0}, {"torque.maximal", 0.5}})
    checks.push_back(judged(check, error, 1, "N m", "", ""));
  const OddOne simbody{5, false, {{"Simbody", {}}}}, either{5, false, {{"Simbody", {}}, {"", {}}}};
  const EffortDeviation found = *effortDeviation(evidence, checks, simbody);
  EXPECT_EQ(found.largest, 0.5);
  EXPECT_EQ(found.from_without, 4);
  EXPECT_GE(found.smallestRelative() * found.largest_effort, 4);
  EXPECT_EQ(effortDeviation(evidence, checks)->largest, 4);
  EXPECT_EQ(effortDeviation(evidence, checks, either)->largest, 4);
}

TEST(Tolerance, aReplayThatAcceptanceNamesIsJudged) {
  Scenario scenario = scenarioOf("paper-helix");
  scenario.tolerance = EffortTolerance{1e-3, 0};
  scenario.acceptance = {{"replay.position", 1e-30}};
  ValidationOptions quick{false, false, false};
  quick.reference = referenceOf("paper-helix", all_samples);
  EXPECT_EQ(verdictOf(validate(scenario, quick).checks, "replay.position"), "fail");
}

TEST(Tolerance, isReadFromAcceptance) {
  const auto read = [](const std::string& acceptance) {
    const Scenario helix = scenarioOf("paper-helix");
    return parseScenario(helix.text + "\n[acceptance]\n" + acceptance + "\n", helix.file);
  };
  const Scenario both = read("torque = { relative = 1e-3, absolute = 2 }");
  ASSERT_TRUE(both.tolerance);
  EXPECT_EQ(both.tolerance->relative, 1e-3);
  EXPECT_EQ(both.tolerance->absolute, 2);
  const Scenario beside = read("torque.absolute = 3\ntorque.pointwise = 4");
  EXPECT_EQ(beside.tolerance->absolute, 3);
  EXPECT_EQ(beside.acceptance.size(), 1u);
  EXPECT_THROW(read("torque = { relative = 0 }"), ScenarioError);
  EXPECT_THROW(read("torque = { relativ = 1e-3 }"), ScenarioError);
}

/// The file has four digits at 31 instants, which no replay can judge.
TEST(Tolerance, judgesAFileOfFewDigits) {
  Scenario scenario = scenarioOf("paper-helix");
  const TorqueFile four = exactTorques(scenario, 31).printed("{:.3e}");
  const auto judged = [&] { return validateExternal(scenario, four); };
  EXPECT_EQ(judged().verdict, Verdict::inconclusive);
  scenario.tolerance = EffortTolerance{1e-3, 0};
  const ValidationResult tolerant = judged();
  EXPECT_EQ(tolerant.verdict, Verdict::pass);
  EXPECT_EQ(tolerant.limits, LimitBy::user);
  scenario.tolerance = EffortTolerance{1e-6, 0};
  EXPECT_EQ(judged().verdict, Verdict::fail) << "four digits are not right to a millionth";
}

/// A file whose motor with the largest effort is off by 5 units of its fourth digit, and the one with the smallest by 9
/// of its own, which is a larger share of that motor's limit.
TEST(Tolerance, isOfTheLargestErrorNotOfTheLargestShare) {
  Scenario scenario = scenarioOf("paper-helix");
  const TorqueTable right = exactTorques(scenario, 301);
  const auto unit = [](double x) { return std::pow(10, std::floor(std::log10(std::abs(x))) - 3); };
  const auto off = [&](double of_largest, const char* format) {
    return right
        .changed([&](std::size_t, Vector6d& tau) {
          Eigen::Index most = 0, least = 0;
          tau.cwiseAbs().maxCoeff(&most), tau.cwiseAbs().minCoeff(&least);
          const Vector6d was = tau;
          tau(most) += of_largest * unit(was(most));
          tau(least) += 9 * unit(was(least));
        })
        .printed(format);
  };
  const auto largestOf = [&right](const TorqueFile& file) {
    double out = 0;
    for (std::size_t k = 0; k < file.rows(); ++k)
      out = std::max(out, (file.torques[k] - right.torques[k]).cwiseAbs().maxCoeff());
    return out;
  };
  const TorqueFile file = off(5, "{:.4g}");
  scenario.tolerance = EffortTolerance{3.83e-4, 0};
  const ValidationResult result = validateExternal(scenario, file);
  EXPECT_EQ(result.verdict, Verdict::fail);
  ASSERT_TRUE(result.deviation);
  const double largest = largestOf(file);
  EXPECT_GT(largest, 5 * result.deviation->allowed);
  EXPECT_NEAR(result.deviation->largest, largest, 1e-6);
  for (const char* check : {"torque.pointwise", "torque.against_noc"})
    EXPECT_NEAR(findCheck(result.checks, check)->largest.value, largest, 1e-6) << check;
  EXPECT_EQ(validateExternal(scenario, off(0, "{:.4g}")).verdict, Verdict::pass) << "the control";
}

/// Each motor has its own limit, also in the time series.
TEST(Tolerance, theSmallestForAFileOfFewDigitsPasses) {
  Scenario scenario = scenarioOf("paper-helix");
  const TorqueFile file =
      exactTorques(scenario, 31).changed([](std::size_t, Vector6d& tau) { tau *= 1 + 1e-4; }).printed("{:.5g}");
  const ValidationResult result = validateExternal(scenario, file);
  const double smallest = result.deviation->smallestRelative();
  EXPECT_GT(smallest, 1e-4);
  scenario.tolerance = EffortTolerance{smallest, 0};
  EXPECT_EQ(validateExternal(scenario, file).verdict, Verdict::pass);
  scenario.tolerance = EffortTolerance{0.999 * smallest, 0};
  EXPECT_EQ(validateExternal(scenario, file).verdict, Verdict::fail);
  const std::vector<double>&one = *result.timeseries.find("limit_tau_1_Nm"),
        &three = *result.timeseries.find("limit_tau_3_Nm");
  EXPECT_NE(one, three);
}

/// The scale is the largest effort of the motion, not of the file's instants.
TEST(Tolerance, isRelativeToTheMotionsLargestEffortForAnyFile) {
  const Scenario scenario = scenarioOf("paper-helix");
  TorqueTable start = exactTorques(scenario, 301);
  start.t.resize(11);
  start.torques.resize(11);
  const auto of = [&](const TorqueTable& table) { return validateExternal(scenario, table.file()).deviation; };
  const auto short_one = of(start), whole = of(exactTorques(scenario, 31)), own = judgedWith(0, {}).deviation;
  ASSERT_TRUE(short_one && whole && own);
  EXPECT_EQ(short_one->largest_effort, own->largest_effort);
  EXPECT_EQ(whole->largest_effort, own->largest_effort);
  double largest_at_start = 0;
  for (const Vector6d& row : start.torques) largest_at_start = std::max(largest_at_start, row.cwiseAbs().maxCoeff());
  EXPECT_LT(largest_at_start, 0.99 * own->largest_effort) << "the start has the largest: nothing is shown";
}

/// Missing parts are not within any tolerance.
TEST(Tolerance, doesNotCoverWhatTheFileLeavesOut) {
  Scenario scenario = scenarioOf("paper-helix");
  scenario.tolerance = EffortTolerance{1e-3, 0};
  TorqueTable half = exactTorques(scenario, 31);
  half.t.resize(16);
  half.torques.resize(16);
  EXPECT_EQ(validateExternal(scenario, half.file()).verdict, Verdict::inconclusive);
}

/// A tolerance judges the given rows. Between 2, 5 or 11 rows the torques may be anything.
TEST(Tolerance, leavesOpenWhatLiesBetweenFewRows) {
  Scenario scenario = scenarioOf("paper-helix");
  for (const auto& [rows, relative] : {std::pair(2, 1e-12), {2, 1e-3}, {3, 1e-6}, {5, 1e-6}, {6, 1e-3}, {11, 1e-3}}) {
    scenario.tolerance = EffortTolerance{relative, 0};
    EXPECT_EQ(validateExternal(scenario, exactTorques(scenario, rows).file()).verdict, Verdict::inconclusive)
        << rows << " rows, " << relative;
  }
  EXPECT_EQ(validateExternal(scenario, exactTorques(scenario, 301).file()).verdict, Verdict::pass);
}

TEST(Tolerance, atWhichTorquesOfZeroWouldPassIsRefused) {
  Scenario scenario = scenarioOf("paper-helix");
  const TorqueTable right = exactTorques(scenario, 31);
  for (const EffortTolerance& tolerance : {EffortTolerance{1, 0}, EffortTolerance{0, 3e4}, EffortTolerance{0.5, 2e4}}) {
    scenario.tolerance = tolerance;
    EXPECT_THROW(validateExternal(scenario, right.file()), ScenarioError);
    EXPECT_THROW(validate(scenario), ScenarioError);
  }
  scenario.tolerance = EffortTolerance{1, 0, true};
  EXPECT_EQ(validateExternal(scenario, right.file()).verdict, Verdict::pass);
  scenario.tolerance = EffortTolerance{0.9, 0};
  EXPECT_EQ(validateExternal(scenario, right.file()).verdict, Verdict::pass);
}

TEST(Sentence, saysWhatWouldHaveBeenSeen) {
  ValidationResult result;
  EXPECT_EQ(deviationSentence(result), "") << "nothing was compared";
  result.deviation = EffortDeviation();
  result.deviation->largest_effort = 10;
  EXPECT_THAT(deviationSentence(result), Not(HasSubstr("would have been seen")));
  result.deviation->seen = 3e-13;
  EXPECT_THAT(deviationSentence(result),
              HasSubstr("An error of 3e-13 of the largest torque at one of the judged instants would have been seen."));
  result.deviation->seen_for = 5.2e-4;
  EXPECT_THAT(deviationSentence(result),
              HasSubstr("An error of 3e-13 of the largest torque that lasts longer than 520 µs would have been seen."));
}

TEST(Sentence, saysHowRightWhereAndWhatFollows) {
  ValidationResult result;
  EffortDeviation& deviation = result.deviation.emplace();
  deviation.largest = 7.4;
  deviation.largest_effort = 25066;
  deviation.where = "leg 3";
  deviation.t = 2.97;
  deviation.drift = 0.041;
  deviation.duration = 3;
  deviation.length = 1;
  EXPECT_EQ(deviationSentence(result),
            "Off by at most 0.03 %: the largest deviation is 7.4 N m of 25066 N m, leg 3 at t = 2.97 s; from errors of "
            "this size the open-loop motion would drift by up to 41 mm in 3 s; the smallest --rtol that would pass is "
            "0.00029523.");
  deviation.drift = 2;
  EXPECT_THAT(deviationSentence(result), HasSubstr("may be lost within 3 s"));
  deviation.drift = std::nan("");
  EXPECT_THAT(deviationSentence(result), Not(HasSubstr("open-loop")));
}

}  // namespace
}  // namespace ursula

// The text of a result on a terminal, and of each check.

#include "report/text/terminal.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <sstream>

#include "model/check_catalogue.h"
#include "report/text/result_facts.h"
#include "report/text/text.h"
#include "tests/report/report_samples.h"
#include "tests/support/matchers.h"
#include "tests/support/numbers.h"

namespace ursula {
namespace {

ValidationResult of(std::vector<Check> checks) {
  ValidationResult result;
  result.scenario = "s";
  result.checks = std::move(checks);
  result.verdict = overall(result.checks);
  return result;
}

TEST(TerminalText, alignsValueLimitUnitAndShareUnderTheirGroup) {
  const std::string text = report::validationText(
      of({judged("torque.pointwise", 1.25e-9, 5e-9, "N m", "", ""),
          judged("torque.twin", 3, 2, "N m", "", "leg 3, t = 1 s"), judged("motion.pose", 0, 0, "numbers", "", "")}),
      false, true);
  EXPECT_EQ(text, R"(s: fail
verdict: fail — 1 of 3 checks failed: torque.twin, which is at 1.5 times its limit.

                                     value  limit  unit      of limit
Motors: the formulations agree on the efforts
  pass          torque.pointwise  1.25e-09  5e-09  N·m           25 %
  fail          torque.twin              3      2  N·m      1.5 times
                leg 3, t = 1 s
Input: the motion asked for is well defined
  pass          motion.pose              0      0  numbers        0 %
)");
}

TEST(TerminalText, hasALineForEachGroupAndTheChecksThatDidNotPass) {
  const std::string text = report::validationText(
      of({judged("torque.pointwise", 1.25e-9, 5e-9, "N m", "", ""),
          judged("torque.twin", 3, 2, "N m", "", "leg 3, t = 1 s"), judged("motion.pose", 1, 4, "numbers", "", ""),
          judged("motion.twist", 1, 2, "m/s", "", ""), notApplicable("torque.mujoco", "N m", "no MuJoCo")}),
      false);
  EXPECT_EQ(text, R"(s: fail
verdict: fail — 1 of 4 checks failed: torque.twin, which is at 1.5 times its limit.

  fail          Motors: the formulations agree on the efforts  1 of 2
    fail          torque.twin  3  2  N·m  1.5 times
                  leg 3, t = 1 s
  pass          Input: the motion asked for is well defined    2 checks, motion.twist at 50 % of its limit
  1 check does not apply here or was not made; --verbose says why
)");
}

TEST(TerminalText, saysWhyInsteadOfWhatIsNoNumber) {
  const std::string text = report::validationText(
      of({notJudgeable(Reason::not_covered, "closure.position", nan, nan, "m", "", "not replayed: too few samples"),
          notJudgeable(Reason::not_covered, "closure.velocity", nan, nan, "m/s", "", "not replayed: too few samples"),
          judged("motion.load", 1, 4, "N, N m", "", ""),
          notApplicable("torque.mujoco", "N m", "this build has no MuJoCo")}),
      false, true);
  EXPECT_THAT(text, AllOf(HasSubstr("  inconclusive  closure.position\n  inconclusive  closure.velocity\n"
                                    "                not replayed: too few samples\n"),
                          HasSubstr("not applicable, since this build has no MuJoCo: torque.mujoco\n"),
                          Not(HasSubstr("nan")), Not(HasSubstr("N, N")), HasSubstr(" 25 %\n")));
}

TEST(TerminalText, ofACleanPassHasNoDominantErrorAndNoColour) {
  const std::string text = report::validationText(test::passedSample(), false);
  EXPECT_THAT(text,
              AllOf(Not(HasSubstr("dominant error")), Not(HasSubstr("\033")), HasSubstr("\nverdict: pass — 8 of 8")));
  ValidationResult failed = test::failedSample();
  EXPECT_THAT(report::validationText(failed, false), HasSubstr("\ndominant error: "));
  for (Check& check : failed.checks)
    if (check.name == "replay.position") check.verdict = Verdict::pass;
  EXPECT_THAT(report::validationText(failed, false), Not(HasSubstr("dominant error"))) << "the replay holds";
}

TEST(TerminalText, showsWrongMotorsAsATable) {
  ValidationResult result = of({judged("torque.pointwise", 12.5, 1e-9, "N m", "", "leg 2")});
  result.timeseries.add("t_s", {0, 1, 2});
  result.timeseries.add("tau_1_Nm", {10.01, -20.02, 30.03});
  result.timeseries.add("simbody_tau_1_Nm", {10, -20, 30});
  result.timeseries.add("tau_2_Nm", {-12.5, -2.5, 7.5});
  result.timeseries.add("simbody_tau_2_Nm", {0, 10, 20});
  result.timeseries.add("tau_3_Nm", {1, 2, nan});
  result.timeseries.add("simbody_tau_3_Nm", {1, 2.5, 3});
  result.cause_words = {"", "of two kinds"};
  EXPECT_THAT(report::validationText(result, false), HasSubstr(R"(
torques against the expected ones:
  motor    off by  at t  factor     offset
      1  0.03 N·m   2 s   1.001
      2  12.5 N·m   0 s          -12.5 N·m
      3   nan N·m   2 s
)"));
  EXPECT_THAT(
      report::validationText(result, false),
      HasSubstr("times its limit.\nworst: motor 3 was given no number where 3\u00a0N·m is expected, at t = 2 s\n"
                "likely cause: of two kinds\n\n"));
}

TEST(TerminalText, saysOneFactOnce) {
  const ValidationResult result =
      of({judged("torque.pointwise", 2, 1, "N m", "", "leg 3"), judged("acceleration.pointwise", 5, 1, "m/s^2", "", ""),
          judged("torque.twin", 2.001, 1, "N m", "", ""), judged("torque.maximal", 3, 1, "N m", "", "leg 4"),
          judged("torque.mujoco", 0, 1, "N m", "", "")});
  EXPECT_THAT(report::validationText(result, false),
              AllOf(HasSubstr("efforts  4 of 5\n    fail          torque.pointwise  2"),
                    HasSubstr("\n    fail          torque.maximal    3"), Not(HasSubstr("fail          torque.twin")),
                    HasSubstr("\n                  the same: acceleration.pointwise, torque.twin\n")));
  EXPECT_THAT(report::validationText(result, false, true),
              AllOf(HasSubstr("fail          torque.twin"), Not(HasSubstr("the same"))));
}

TEST(TerminalText, spellsUnitsInOneWay) {
  ValidationResult result = of({judged("torque.pointwise", 2, 1, "N m", "", "off by 2 N m")});
  result.cause_words = {"", "a constant offset: +3 N m on leg 5"};
  EXPECT_THAT(report::validationText(result, false) + report::quietText(result, false),
              AllOf(HasSubstr("+3 N·m on leg 5"), HasSubstr("off by 2 N·m"), Not(HasSubstr("N m"))));
}

TEST(BlindText, namesTheBodiesOfOneMistakeTogether) {
  const auto term = [](const char* mistake, const char* body) {
    return BlindSpot{mistake, {}, {CauseKind::missing_term, "spin", body}};
  };
  const auto number = [](const char* mistake, const char* body) {
    return BlindSpot{mistake, {}, {CauseKind::parameter, "", body}};
  };
  const std::vector<BlindSpot> blind = {term("the spin is left out", "all"),
                                        term("the spin of 'a' is left out", "a"),
                                        term("the spin of 'b' is left out", "b"),
                                        number("the inertia xx of 'a' is 1.1 instead of 1", "a"),
                                        number("the inertia xx of 'b' is 3 instead of 2", "b"),
                                        number("the mass of 'b' is 3 instead of 2", "b")};
  const std::vector<BlindSpot> said = report::alikeAsOne(blind);
  ASSERT_EQ(said.size(), 3u);
  EXPECT_EQ(said[0].mistake, "the spin is left out (also that of 'a', 'b' alone)");
  EXPECT_EQ(said[1].mistake, "the inertia xx of 'a', 'b'");
  EXPECT_EQ(said[2].mistake, "the mass of 'b' is 3 instead of 2");
  EXPECT_THAT(report::blindText(blind), HasSubstr("  - and 1 more: --json"));
}

TEST(BlindText, namesFewOfManyBodiesAndNoneTwice) {
  std::vector<BlindSpot> blind;
  for (const char* body : {"a", "b", "c", "a, b, c", "d", "e"})
    blind.push_back(
        {std::string("the spin of '") + body + "' is left out", {}, {CauseKind::missing_term, "spin", body}});
  EXPECT_EQ(report::alikeAsOne(blind).at(0).mistake, "the spin of 'a', 'b', 'c', and 2 more is left out");
  blind.resize(3);
  EXPECT_EQ(report::alikeAsOne(blind).at(0).mistake, "the spin of 'a', 'b', 'c' is left out");
  const std::vector<BlindSpot> together = {blind[0],
                                           {"the mass of 'a, b' is wrong", {}, {CauseKind::parameter, "", "a, b"}}};
  EXPECT_EQ(report::alikeAsOne(together).at(1).mistake, "the mass of 'a, b' is wrong");
}

TEST(TerminalText, saysNothingOfMotorsThatAreRight) {
  EXPECT_THAT(report::validationText(test::passedSample(), false), Not(HasSubstr("torques against")));
}

TEST(TerminalText, callsOnlyAClaimedCauseLikely) {
  ValidationResult result = test::failedSample();
  const auto texts = [&result](const char* cause, CauseClaim claim) {
    result.cause_words = {"leg 3", cause, claim};
    return report::validationText(result, false) + report::quietText(result, false) + report::sentence(result);
  };
  const std::string likely = texts("a factor on leg 3", CauseClaim::likely);
  EXPECT_THAT(likely, HasSubstr("\nlikely cause: a factor on leg 3\n"));
  EXPECT_THAT(likely, HasSubstr("are wrong. Likely cause: a factor on leg 3."));
  for (const CauseClaim claim : {CauseClaim::none, CauseClaim::interval}) {
    const std::string unclaimed = texts("no simple explanation", claim);
    EXPECT_THAT(unclaimed, HasSubstr("\nno simple explanation\n"));
    EXPECT_THAT(unclaimed, HasSubstr("are wrong: no simple explanation."));
    EXPECT_THAT(unclaimed, Not(HasSubstr("ikely cause")));
  }
  EXPECT_THAT(texts("a likely part: a factor", CauseClaim::part), HasSubstr("are wrong. A likely part: a factor."));
}

TEST(Sentence, namesTheEffortsAndKeepsNames) {
  ValidationResult result = test::failedSample();
  result.effort = "force";
  result.subject = {"my torque data.csv", Formulation::external, CalledBy::torques};
  EXPECT_THAT(report::sentence(result), StartsWith("The forces of my torque data.csv "));
}

TEST(TerminalText, isColouredOnlyWhereThatIsWanted) {
  EXPECT_THAT(report::validationText(test::failedSample(), true), HasSubstr("\033[1;31mfail\033[0m"));
  EXPECT_TRUE(report::wantsColour(true, nullptr, "xterm"));
  EXPECT_TRUE(report::wantsColour(true, "", nullptr));
  EXPECT_FALSE(report::wantsColour(true, "1", "xterm"));
  EXPECT_FALSE(report::wantsColour(true, nullptr, "dumb"));
  EXPECT_FALSE(report::wantsColour(false, nullptr, "xterm"));
}

TEST(TerminalText, quietlyIsOneLine) {
  EXPECT_EQ(
      report::quietText(test::passedSample(), false),
      "paper-helix: pass — 8 of 8 checks held; the closest to its limit, replay.position, is at 81 % of its limit.\n");
  const std::string failed = report::quietText(test::externalSample(), false);
  EXPECT_THAT(failed, AllOf(StartsWith("leg-3-off: fail — "), HasSubstr("; likely cause: a factor of 1.001 on leg 3")));
  EXPECT_EQ(std::count(failed.begin(), failed.end(), '\n'), 1);
  EXPECT_EQ(failed.back(), '\n');
}

TEST(Columns, countCharactersAndNotBytes) {
  EXPECT_EQ(report::columnsOf("N·m"), 3u);
  EXPECT_EQ(report::padded("µm", 4), "µm  ");
  EXPECT_EQ(report::padded("µm", 4, report::Align::right), "  µm");
  EXPECT_EQ(report::padded("longer", 4), "longer");
}

TEST(CheckHelp, ofEachCheckSaysThreeThingsOfItsOwn) {
  std::set<std::string> texts;
  ASSERT_GT(checkCatalogue().size(), 30u);
  for (const CheckRow& check : checkCatalogue()) {
    for (const std::string text : {check.proves, check.limit, check.on_failure}) {
      EXPECT_NE(text, "") << check.name;
      EXPECT_TRUE(texts.insert(text).second) << check.name << " shares: " << text;
    }
    EXPECT_STRNE(check.title, "") << check.name;
    EXPECT_LT(groupOf(check.name), checkGroups().size()) << check.name;
  }
  EXPECT_EQ(texts.size(), 3 * checkCatalogue().size());
  EXPECT_EQ(groupOf("torque.unheard_of"), checkGroups().size());
  EXPECT_EQ(checkTitle("torque.unheard_of"), "torque.unheard_of");
}

TEST(CheckHelp, isAPageWithLinesOfAtMostAHundredColumns) {
  std::istringstream lines(report::explanation("feedback.torque"));
  std::size_t count = 0, longest = 0;
  for (std::string line; std::getline(lines, line); ++count) longest = std::max(longest, report::columnsOf(line));
  EXPECT_GT(count, 6u);
  EXPECT_GT(longest, 60u);
  EXPECT_LE(longest, 100u);
  try {
    report::explanation("torque.pontwise");
    ADD_FAILURE() << "there is no such check";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "no check 'torque.pontwise', did you mean 'torque.pointwise'?");
  }
  try {
    report::explanation("replay");
    ADD_FAILURE() << "a group is no check";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("no check 'replay', did you mean one of replay."));
  }
}

}  // namespace
}  // namespace ursula

// Two histories channel by channel: tubes in value and time, channels that are not compared, and that nothing missing
// passes.

#include "parts/compare/compare.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/csv.h"
#include "tests/base/temporary_folder.h"
#include "tests/model/refusals.h"
#include "tests/studies/histories.h"
#include "tests/support/matchers.h"
#include "tests/support/numbers.h"
#include "validation/validate.h"

namespace ursula {
namespace {

TEST(Compare, aHistoryPassesAgainstItself) {
  const Comparison result = compare(history(t_101), history(t_101), {});
  EXPECT_EQ(result.verdict, Verdict::pass);
  ASSERT_EQ(result.channels.size(), 2U);
  EXPECT_EQ(result.channels[0].max_error, 0);
  EXPECT_EQ(result.channels[0].scale, 20);  // of all tau_*
  EXPECT_EQ(result.channels[0].group, "tau_*_Nm");
  EXPECT_EQ(result.instants, 101U);
  EXPECT_EQ(result.interpolated, 0U);
  EXPECT_THAT(comparisonText(result), HasSubstr("compared 2 of 2 channels at 101 instants; 2 within tolerance"));
}

/// 1e15 s is rounded to an eighth of a second, which must be no tolerance for instants within a third of a second.
TEST(Compare, tellsTwoInstantsOfTheReferenceApart) {
  const TimeSeries reference = history(equallySpaced(0.3, 301));
  const TimeSeries one = history({0, 1e15});
  const Comparison result = compare(reference, one, {});
  EXPECT_EQ(result.verdict, Verdict::inconclusive);
  EXPECT_GE(result.skipped, 299U);
  EXPECT_EQ(compare(reference, reference, {}).verdict, Verdict::pass) << "the control";
}

TEST(Compare, maximumRmsAndFinalErrorAreThoseOfTheDifference) {
  TimeSeries test = history(t_101);
  test.columns[1][50] += 3;
  test.columns[1][100] -= 1;
  const Comparison result = compare(history(t_101), test, {});
  const ChannelComparison& channel = result.channels[0];
  EXPECT_EQ(result.verdict, Verdict::fail);
  EXPECT_NEAR(channel.max_error, 3, 1e-12);
  EXPECT_EQ(channel.max_at, 0.5);
  EXPECT_NEAR(channel.rms_error, std::sqrt(10.0 / 101), 1e-12);
  EXPECT_NEAR(channel.final_error, 1, 1e-12);
  EXPECT_EQ(channel.verdict, Verdict::fail);
  EXPECT_EQ(result.channels[1].verdict, Verdict::pass);
}

TEST(Compare, theToleranceIsOfTheGroupsScale) {
  TimeSeries test = history(t_101);
  test.columns[1][50] += 1.9e-8;
  EXPECT_EQ(compare(history(t_101), test, {}).verdict, Verdict::pass);  // 1e-9 of 20
  test.columns[1][50] += 0.2e-8;
  EXPECT_EQ(compare(history(t_101), test, {}).verdict, Verdict::fail);
  EXPECT_EQ(compare(history(t_101), test, {1e-8, 0}).verdict, Verdict::pass);
}

TEST(Compare, errorChannelsAreMeasuredOnTheScaleOfWhatTheyAreErrorsOf) {
  const TimeSeries reference{{"t_s", "p_x_m", "error_p_m"}, {{0, 1}, {2, 2}, {1e-12, 1e-12}}};
  TimeSeries test = reference;
  test.columns[2] = {3e-12, 4e-12};
  EXPECT_EQ(compare(reference, test, {}).verdict, Verdict::pass);
  test.columns[2] = {3e-12, 4e-8};
  EXPECT_EQ(compare(reference, test, {}).verdict, Verdict::fail);
}

TEST(Compare, energyErrorsAreMeasuredOnTheWork) {
  const TimeSeries reference{{"t_s", "tau_1_Nm", "phi_1_rad", "error_energy_J"},
                             {{0, 1}, {3, 4}, {0.5, 2}, {0, 1e-11}}};
  TimeSeries test = reference;
  test.columns[3] = {1e-10, 7e-9};
  const Comparison result = compare(reference, test, {});
  EXPECT_EQ(result.verdict, Verdict::pass);
  EXPECT_EQ(result.channels.back().scale, 8);
  test.columns[3][1] = 9e-9;
  EXPECT_EQ(compare(reference, test, {}).verdict, Verdict::fail);
}

TEST(Compare, theTubeIsInTimeAsWell) {
  const TimeSeries late = history(t_101, -0.01);
  EXPECT_EQ(compare(history(t_101), late, {1e-9, 0}).verdict, Verdict::fail);
  EXPECT_EQ(compare(history(t_101), late, {1e-9, 0.009}).verdict, Verdict::fail);
  const Comparison result = compare(history(t_101), late, {1e-9, 0.0101});
  // Only the first instant is wrong: its value is from before the reference begins.
  EXPECT_EQ(result.channels[0].verdict, Verdict::fail);
  EXPECT_NEAR(result.channels[0].outside, 10 * std::sin(0.02), 1e-9);
  TimeSeries held = late;
  held.columns[1][0] = 0;
  EXPECT_EQ(compare(history(t_101), held, {1e-9, 0.0101}).verdict, Verdict::pass);
}

TEST(Compare, nanNeverPasses) {
  for (const bool in_test : {true, false}) {
    TimeSeries reference = history(t_101), test = history(t_101);
    (in_test ? test : reference).columns[1][70] = nan;
    const Comparison result = compare(reference, test, {1e9, 0.5});
    EXPECT_EQ(result.verdict, Verdict::fail);
    EXPECT_EQ(result.channels[0].verdict, Verdict::fail);
    EXPECT_TRUE(std::isnan(result.channels[0].max_error));
    EXPECT_TRUE(std::isnan(result.channels[0].rms_error));
    EXPECT_EQ(result.channels[1].verdict, Verdict::pass);
  }
}

/// A turn about z by more than half a revolution, in which w changes its sign.
TimeSeries turning(const std::vector<double>& t, double sign) {
  TimeSeries out{{"t_s", "q_w", "q_x", "q_y", "q_z"}, {t, {}, {}, {}, {}}};
  for (const double at : t)
    for (std::size_t k = 1; k < 5; ++k)
      out.columns[k].push_back(sign * (k == 1 ? std::cos(2 * at) : k == 4 ? std::sin(2 * at) : 0));
  return out;
}

TEST(Compare, quaternionsAreRotations) {
  TimeSeries flipping = turning(t_101, 1);
  for (std::size_t k = 1; k < 5; ++k)
    for (std::size_t row = 0; row < 101; row += 3) flipping.columns[k][row] *= -1;
  EXPECT_EQ(compare(turning(t_101, 1), turning(t_101, -1), {}).verdict, Verdict::pass);
  EXPECT_EQ(compare(turning(t_101, 1), flipping, {}).verdict, Verdict::pass);
  EXPECT_EQ(compare(flipping, turning(equallySpaced(1, 68), 1), {1e-7, 0}).verdict, Verdict::pass);
  TimeSeries other = turning(t_101, 1);
  for (double& z : other.columns[4]) z *= -1;  // the conjugate is another rotation
  EXPECT_EQ(compare(turning(t_101, 1), other, {}).verdict, Verdict::fail);
}

TEST(Compare, whatIsNoNumberOrBeyondThemNeverPasses) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const TimeSeries endless{{"t_s", "p_x_m"}, {{0, 1}, {1, inf}}}, up{{"t_s", "p_x_m"}, {{0, 1}, {1, 1e308}}},
      down{{"t_s", "p_x_m"}, {{0, 1}, {1, -1e308}}};
  EXPECT_EQ(compare(endless, endless, {}).verdict, Verdict::fail);
  EXPECT_EQ(compare(up, down, {1.9, 0}).verdict, Verdict::fail) << "2e308 is beyond 1.9e308";
  EXPECT_EQ(compare(up, up, {1.9, 0}).verdict, Verdict::pass);
}

TEST(Compare, columnsAreChosenByName) {
  CompareOptions options;
  options.columns = {"tau_*_Nm"};
  TimeSeries reference = history(t_101), test = history(t_101);
  reference.add("p_x_m", std::vector<double>(101, 0));
  test.add("p_x_m", std::vector<double>(101, 1));
  EXPECT_EQ(compare(reference, test, {}).verdict, Verdict::fail);
  EXPECT_EQ(compare(reference, test, options).verdict, Verdict::pass);
  EXPECT_EQ(compare(reference, test, options).channels.size(), 2U);
  options.columns = {"tau_2_Nm"};
  EXPECT_EQ(compare(reference, test, options).channels.size(), 1U);
  options.columns = {"nothing*"};
  EXPECT_THROW(compare(reference, test, options), std::invalid_argument);
}

TEST(Compare, hundredsOfColumnsAreCounted) {
  TimeSeries test = history(t_101);
  for (int k = 0; k < 300; ++k) test.add("reaction_" + std::to_string(k), std::vector<double>(101, 0));
  const std::string text = comparisonText(compare(history(t_101), test, {}));
  EXPECT_THAT(text, HasSubstr("300 channels only in the test: reaction_0, "));
  EXPECT_EQ(text.find("reaction_100"), std::string::npos);
}

TEST(Compare, junitHasACaseForEachChannel) {
  TimeSeries reference = history(t_101), test = history(t_101);
  reference.add("p_x_m", std::vector<double>(101, 0));
  test.columns[1][50] += 3;
  const SuiteEntry entry = comparisonSuite(compare(reference, test, {}), "a : b");
  ASSERT_EQ(entry.checks.size(), 3U);
  EXPECT_EQ(entry.verdict, Verdict::fail);
  EXPECT_EQ(entry.checks[0].verdict, Verdict::fail);
  EXPECT_EQ(entry.checks[1].verdict, Verdict::pass);
  EXPECT_EQ(entry.checks[2].verdict, Verdict::inconclusive);
}

TEST(Compare, aFolderThatHoldsOnlyWhatShipsGivesItsInverseDynamics) {
  const TemporaryFolder folder;
  folder.write("inverse.csv", "t_s,x\n0,1\n1,2\n");
  EXPECT_EQ(readHistory(folder.path()).columns[1][1], 2);
  folder.write("timeseries.csv", "t_s,x\n0,1\n1,5\n");
  EXPECT_EQ(readHistory(folder.path()).columns[1][1], 5);
}

TEST(Compare, namesTheChannelsOfOneFileOnly) {
  TimeSeries reference = history(t_101), test = history(t_101);
  test.add("note", std::vector<double>(101, 0));
  EXPECT_EQ(compare(reference, test, {}).verdict, Verdict::pass);
  reference.add("p_x_m", std::vector<double>(101, 0));
  const Comparison result = compare(reference, test, {});
  EXPECT_EQ(result.verdict, Verdict::inconclusive);
  EXPECT_THAT(result.only_in_reference, ElementsAre("p_x_m"));
  EXPECT_THAT(result.only_in_test, ElementsAre("note"));
  const std::string text = comparisonText(result);
  EXPECT_THAT(text, HasSubstr("compared 2 of 3 channels"));
  EXPECT_THAT(text, HasSubstr("1 channel only in the reference: p_x_m\n"));
  EXPECT_THAT(text, HasSubstr("1 channel only in the test: note\n"));
}

TEST(Compare, nothingInCommonFails) {
  const TimeSeries other{{"t_s", "x"}, {t_101, t_101}};
  const Comparison channels = compare(history(t_101), other, {});
  EXPECT_EQ(channels.verdict, Verdict::fail);
  EXPECT_THAT(comparisonText(channels), HasSubstr("no channel is common to both\ncompared 0 of 2 channels"));
  std::vector<double> later = t_101;
  for (double& t : later) t += 5;
  const Comparison times = compare(history(t_101), history(later), {1e9, 0});
  EXPECT_EQ(times.verdict, Verdict::fail);
  EXPECT_THAT(comparisonText(times), HasSubstr("nothing to compare: the reference spans 0 to 1 s, the test 5 to 6 s"));
}

TEST(Compare, readsFoldersAndRefusesInstantsThatDoNotIncrease) {
  const TemporaryFolder folder;
  folder.write("timeseries.csv", "t_s,x\n0,nan\n1,2\n");
  EXPECT_TRUE(std::isnan(readHistory(folder.path()).columns[1][0]));
  for (const char* text : {"t_s,x\n0,1\n0,2\n", "t_s,x\n1,1\n0,2\n", "t_s,x\n0,1\nnan,2\n"})
    EXPECT_THAT(refusal<CsvError>([&] { readHistory(folder.write("a.csv", text)); }), HasSubstr("a.csv:3: error: t_s"));
  EXPECT_THAT(refusal<CsvError>([&] { readHistory(folder.write("a.csv", "x\n1\n")); }),
              HasSubstr("missing column 't_s'"));
}

TEST(Compare, theTableAsCsvHasOneRowForEachChannel) {
  const std::string text = comparisonCsv(compare(history(t_101), history(t_101), {}));
  EXPECT_THAT(text, HasSubstr("channel,verdict,max_error,t_max_s,rms_error,final_error,outside,tolerance,scale,group\n"
                              "tau_1_Nm,pass,0,0,0,0,0,"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
  Comparison odd;
  odd.channels.emplace_back().name = "a,\"b\"\x1b[31m";
  EXPECT_THAT(comparisonCsv(odd), HasSubstr("\n\"a,\"\"b\"\"\\x1b[31m\","));
}

}  // namespace
}  // namespace ursula

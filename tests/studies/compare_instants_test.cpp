// Two histories at different instants: interpolation, open questions, and parts.

#include <gtest/gtest.h>

#include "parts/compare/compare.h"
#include "tests/studies/histories.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

CompareOptions interpolating(double tolerance) {
  CompareOptions options;
  options.tolerance = tolerance;
  options.interpolate = true;
  return options;
}

TEST(Compare, otherInstantsAreInterpolatedAndWhatThatMissesIsLeftOpen) {
  const std::vector<double> finer = equallySpaced(1, 151);
  const Comparison result = compare(history(t_101), history(finer), interpolating(1e-15));
  EXPECT_EQ(result.interpolated, 100U);
  EXPECT_EQ(result.channels[0].verdict, Verdict::inconclusive);
  EXPECT_EQ(result.channels[1].verdict, Verdict::pass);
  EXPECT_EQ(result.verdict, Verdict::inconclusive);
  EXPECT_EQ(compare(history(t_101), history(finer), interpolating(1e-7)).verdict, Verdict::pass);
  EXPECT_EQ(compare(history(t_101), history(finer, 0.01), interpolating(1e-7)).verdict, Verdict::fail);
}

TEST(Compare, statesWhatInterpolationMayMissAndItMissesLess) {
  const Comparison result = compare(history(equallySpaced(1, 21)), history(equallySpaced(1, 34)), interpolating(1e-9));
  const ChannelComparison& channel = result.channels[0];
  EXPECT_GT(channel.interpolation, 1e-8);
  EXPECT_LT(channel.interpolation, 1e-3);
  EXPECT_GT(channel.max_error, 0);
  EXPECT_LE(channel.max_error, channel.interpolation);
  EXPECT_THAT(comparisonText(result), HasSubstr("which may miss "));
}

TEST(Compare, aFinerReferenceIsInterpolatedAndACoarserOneOnlyWhenAsked) {
  const TimeSeries coarse = history(equallySpaced(1, 68)), fine = history(t_101);
  const Comparison by_default = compare(fine, coarse, {1e-6, 0});
  EXPECT_GT(by_default.interpolated, 0U);
  EXPECT_EQ(by_default.verdict, Verdict::pass);
  const Comparison left_out = compare(coarse, fine, {1e-6, 0});
  EXPECT_EQ(left_out.interpolated, 0U);
  EXPECT_GT(left_out.left_out, 0U);
  EXPECT_EQ(left_out.verdict, Verdict::inconclusive);
  EXPECT_THAT(comparisonText(left_out), HasSubstr("--interpolate"));
  EXPECT_EQ(compare(coarse, fine, interpolating(1e-5)).verdict, Verdict::pass);
}

TEST(Compare, aPartOfTheTimeIsComparedAndSaid) {
  const std::vector<double> part(t_101.begin() + 10, t_101.end());
  const Comparison short_test = compare(history(t_101), history(part), {});
  EXPECT_EQ(short_test.verdict, Verdict::inconclusive);
  EXPECT_THAT(comparisonText(short_test), HasSubstr("compared from 0.1 to 1 s only"));
  EXPECT_THAT(comparisonText(short_test), HasSubstr("the reference is not covered"));
  const Comparison long_test = compare(history(part), history(t_101), {});
  EXPECT_EQ(long_test.verdict, Verdict::pass);
  EXPECT_EQ(long_test.instants, 91U);
}

TEST(Compare, aTestWithGapsLeavesThemOpen) {
  const Comparison ends = compare(history(t_101), history({0, 1}), {});
  EXPECT_EQ(ends.verdict, Verdict::inconclusive);
  EXPECT_EQ(ends.skipped, 99U);
  EXPECT_THAT(comparisonText(ends), HasSubstr("not compared are 99 instants of the reference in gaps of the test\n"));
  EXPECT_EQ(compare(history(t_101), history(equallySpaced(1, 51)), {}).verdict, Verdict::pass);
}

/// The missing row may have been the only peak.
TEST(Compare, oneMissingRowIsAGap) {
  std::vector<double> t = t_101;
  t.erase(t.begin() + 40);
  EXPECT_EQ(compare(history(t_101), history(t), {}).skipped, 1U);
  EXPECT_EQ(compare(history(t_101), history(t), {}).verdict, Verdict::inconclusive);
  std::vector<double> half = equallySpaced(1, 51);
  half.erase(half.begin() + 20);
  EXPECT_EQ(compare(history(t_101), history(half), {}).skipped, 3U);
  for (const int finer : {101, 151, 201, 1234, 4567})  // other instants, of which none may be skipped
    EXPECT_EQ(compare(history(t_101), history(equallySpaced(1, finer)), {}).skipped, 0U) << finer;
}

}  // namespace
}  // namespace ursula

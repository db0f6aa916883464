// The value that a check shows of many instants: the largest share of a limit and the largest value, with NaN before
// all.

#include "tests/support/numbers.h"
#include "validation/verdict/worst_share.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace ursula {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Each {
  double value, limit;
};

/// Adds each value with its index as t and as place.
WorstShare worstOf(const std::vector<Each>& all) {
  WorstShare out;
  for (std::size_t k = 0; k < all.size(); ++k)
    out.add(all[k].value, all[k].limit, static_cast<double>(k), static_cast<int>(k));
  return out;
}

TEST(WorstShare, keepsTheWorstShareAndTheLargestValueApart) {
  const WorstShare found = worstOf({{3, 10}, {2, 4}, {5, 100}, {1, 3}});
  EXPECT_EQ(found.value, 2);
  EXPECT_EQ(found.limit, 4);
  EXPECT_EQ(found.t, 1);
  EXPECT_EQ(found.where, 1);
  EXPECT_EQ(found.largest, 5);
  EXPECT_EQ(found.largest_t, 2);
  EXPECT_EQ(found.largest_where, 2);
  EXPECT_EQ(found.widest_limit, 100);
  EXPECT_EQ(found.widest_t, 2);
  EXPECT_FALSE(found.beyond());
}

TEST(WorstShare, showsTheLargestOfAFailure) {
  const JudgedValue both = worstOf({{3, 1}, {5, 4}}).shown(100);
  EXPECT_TRUE(both.beyond);
  EXPECT_EQ(both.value, 5) << "the largest, not the 3 that is further beyond its limit";
  EXPECT_EQ(both.limit, 4);
  EXPECT_EQ(both.where, 1);
  const JudgedValue other = worstOf({{3, 1}, {5, 6}}).shown(100);
  EXPECT_TRUE(other.beyond);
  EXPECT_EQ(other.value, 3) << "the largest is within its own limit";
}

TEST(WorstShare, doesNotDependOnTheOrder) {
  std::vector<Each> all = {{3, 10}, {2, 4}, {5, 100}, {1, 3}};
  for (int turns = 0; turns < 4; ++turns) {
    std::rotate(all.begin(), all.begin() + 1, all.end());
    const WorstShare found = worstOf(all);
    EXPECT_EQ(found.value / found.limit, 0.5);
    EXPECT_EQ(found.largest, 5);
    EXPECT_EQ(found.widest_limit, 100);
  }
}

TEST(WorstShare, isTheFirstOfEqualOnes) {
  const WorstShare found = worstOf({{1, 2}, {1, 2}, {2, 4}, {2, 4}});
  EXPECT_EQ(found.where, 0);
  EXPECT_EQ(found.largest_where, 2);
  EXPECT_EQ(found.widest_t, 2);
}

/// NaN comes before any value beyond its limit, wherever it occurs; the first of several is kept.
TEST(WorstShare, keepsNaNBeforeAll) {
  for (std::size_t at = 0; at < 3; ++at) {
    std::vector<Each> all = {{9, 1}, {1e9, 1}, {infinite, 1}};
    all.insert(all.begin() + static_cast<std::ptrdiff_t>(at), {nan, 1});
    all.push_back({nan, 1});
    const WorstShare found = worstOf(all);
    EXPECT_TRUE(std::isnan(found.value)) << at;
    EXPECT_TRUE(std::isnan(found.largest)) << at;
    EXPECT_EQ(found.where, static_cast<int>(at));
    EXPECT_EQ(found.largest_where, static_cast<int>(at));
    EXPECT_TRUE(found.beyond());
  }
}

TEST(WorstShare, aLimitThatIsNoNumberIsBeyondAllOthersButNaN) {
  const WorstShare found = worstOf({{1, 2}, {0, nan}, {1.9, 2}});
  EXPECT_EQ(found.where, 1);
  EXPECT_TRUE(found.beyond());
  EXPECT_TRUE(std::isnan(found.widest_limit));
  EXPECT_EQ(worstOf({{1, nan}, {nan, 2}}).where, 1);
}

TEST(WorstShare, nothingOfNothingIsWithin) {
  const WorstShare found = worstOf({{0, 0}});
  EXPECT_FALSE(found.beyond());
  EXPECT_TRUE(found.any);
  EXPECT_FALSE(WorstShare{}.any);
  EXPECT_EQ(WorstShare::share(0, 0), 0);
  EXPECT_EQ(WorstShare::share(1, 0), infinite);
  EXPECT_EQ(WorstShare::share(nan, 1), infinite);
  EXPECT_EQ(WorstShare::share(1, nan), infinite);
  EXPECT_TRUE(worstOf({{0, 0}, {1e-300, 0}}).beyond());
}

TEST(WorstShare, addsEachMotorWithItsOwnLimit) {
  Vector6d errors, limits;
  errors << 5, -9, 0, 0, 0, 0.5;
  limits << 100, 100, 1, 1, 1, 1;
  WorstShare found;
  found.addEach(errors, limits, 2);
  EXPECT_EQ(found.where, 5) << "the largest share";
  EXPECT_EQ(found.largest, 9);
  EXPECT_EQ(found.largest_where, 1);
  EXPECT_EQ(found.widest_limit, 100);
}

TEST(Exceeds, keepsNaN) {
  EXPECT_TRUE(exceeds(2, 1));
  EXPECT_FALSE(exceeds(1, 1));
  EXPECT_TRUE(exceeds(nan, 1));
  EXPECT_FALSE(exceeds(1, nan));
  EXPECT_FALSE(exceeds(nan, nan)) << "the first of several";
}

TEST(Larger, isNaNWhereEitherIs) {
  EXPECT_EQ(larger(1, 2), 2);
  EXPECT_EQ(larger(2, 1), 2);
  EXPECT_TRUE(std::isnan(larger(nan, 1)));
  EXPECT_TRUE(std::isnan(larger(1, nan)));
}

}  // namespace
}  // namespace ursula

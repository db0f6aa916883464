// Compares the statistics of a sweep with closed forms: a linear model, the Ishigami function, a grid's exact main
// effects.

#include <boost/random/sobol.hpp>
#include <cmath>
#include <limits>

#include "base/scalar.h"
#include "parts/sweep/report/relations.h"
#include "parts/sweep/report/sweep_rows.h"
#include "tests/studies/sweep_databases.h"
#include "tests/support/matchers.h"
#include "tests/support/numbers.h"

namespace ursula {
namespace {

using test::Dice;

Relation relation(const std::vector<double>& x, const std::vector<double>& y, Classes classes = Classes::quantiles) {
  return relationOf({x, orderOf(x)}, y, ranksOf(y), classes, true);
}

/// Columns of uniform numbers in [0, 1).
std::vector<std::vector<double>> uniform(std::size_t columns, std::size_t rows, std::uint64_t seed) {
  Dice dice(seed);
  std::vector<std::vector<double>> out(columns);
  for (std::size_t k = 0; k < rows; ++k)
    for (std::vector<double>& column : out) column.push_back(dice.roll());
  return out;
}

TEST(Spread, IsThatOfASampleWithoutWhatIsNotFinite) {
  const Spread spread = spreadOf({4, nan, 1, 3, 2, std::numeric_limits<double>::infinity(), 5});
  EXPECT_EQ(spread.count, 5U);
  EXPECT_EQ(spread.min, 1);
  EXPECT_EQ(spread.max, 5);
  EXPECT_EQ(spread.median, 3);
  EXPECT_NEAR(spread.low, 1.2, 1e-15);
  EXPECT_NEAR(spread.high, 4.8, 1e-15);
  EXPECT_NEAR(spread.sd, std::sqrt(2.5), 1e-15);
  EXPECT_FALSE(spread.constant);
  EXPECT_TRUE(std::isnan(spreadOf({nan}).mean));
}

TEST(Spread, KnowsConstantsToRounding) {
  EXPECT_TRUE(spreadOf({0.1 + 0.2, 0.3, 0.3}).constant);
  EXPECT_FALSE(spreadOf({0.3, 0.3 * (1 + 1e-13)}).constant);
}

TEST(Ranks, GiveTiesTheirMeanAndGapsNone) {
  const std::vector<double> ranks = ranksOf({3, 1, nan, 3, 2});
  EXPECT_THAT((std::vector<double>{ranks[0], ranks[1], ranks[3], ranks[4]}), ElementsAre(3.5, 1, 3.5, 2));
  EXPECT_TRUE(std::isnan(ranks[2]));
}

TEST(Histograms, HoldEveryFiniteValueOnce) {
  const std::vector<double> values = {1, 2, 3, 4, nan};
  EXPECT_THAT(histogramOf(values, spreadOf(values), 3).counts, ElementsAre(1, 1, 2));
  const std::vector<double> decades = {1, 10, 100, 1e4};
  const Histogram histogram = histogramOf(decades, spreadOf(decades), 4);
  EXPECT_TRUE(histogram.log);
  EXPECT_THAT(histogram.counts, ElementsAre(1, 1, 1, 1));
  EXPECT_TRUE(histogramOf({2, 2}, spreadOf({2, 2}), 3).counts.empty());
}

TEST(Correlations, AreThoseOfAnscombe) {  // F. J. Anscombe, The American Statistician 27 (1973): the first of his four
  const std::vector<double> x = {10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5};
  const std::vector<double> y = {8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68};
  EXPECT_NEAR(relation(x, y).pearson, 0.81642, 1e-5);
  EXPECT_NEAR(relation(x, y).spearman, 1 - 6 * 40.0 / (11 * 120), 1e-12);  // 1 − 6 Σd² / (n (n² − 1))
}

TEST(Correlations, OfRanksSeeWhatIsMonotonicAlone) {
  const std::vector<double> x = uniform(1, 500, 3)[0];
  std::vector<double> rising, bowl;
  for (const double each : x) rising.push_back(-std::exp(20 * each)), bowl.push_back((each - 0.5) * (each - 0.5));
  EXPECT_NEAR(relation(x, rising).spearman, -1, 1e-12);
  EXPECT_GT(relation(x, rising).pearson, -0.8);
  EXPECT_LT(std::abs(relation(x, bowl).spearman), 0.1);  // so correlation does not show this driver, but the index does
  EXPECT_GT(relation(x, bowl).first_order, 0.95);
}

TEST(Correlations, LeaveOutRowsWithoutAValue) {
  const std::vector<double> x = {1, 2, 3, 4, 5}, y = {2, 4, nan, 8, 10};
  EXPECT_NEAR(relation(x, y).pearson, 1, 1e-15);
  EXPECT_EQ(relation(x, y).count, 4U);
}

TEST(Correlations, OfConstantsAreNone) {
  const std::vector<double> x = {1, 2, 3, 4}, same(4, 0.1 + 0.2);
  for (const Relation& each : {relation(x, same), relation(same, x), relation({1, 2}, {1, 2})}) {
    EXPECT_TRUE(std::isnan(each.pearson));
    EXPECT_TRUE(std::isnan(each.spearman));
    EXPECT_TRUE(std::isnan(each.first_order));
  }
}

TEST(FirstOrder, OfALinearModelAreTheSquaresOfItsCoefficients) {
  const auto x = uniform(3, 20000, 11);
  std::vector<double> y;
  for (std::size_t k = 0; k < x[0].size(); ++k) y.push_back(4 * x[0][k] - 2 * x[1][k] + 1 * x[2][k]);
  const double wanted[] = {16.0 / 21, 4.0 / 21, 1.0 / 21};
  for (std::size_t p = 0; p < 3; ++p) {
    EXPECT_NEAR(relation(x[p], y).first_order, wanted[p], 0.02) << p;
    EXPECT_NEAR(relation(x[p], y).pearson, (p == 1 ? -1 : 1) * std::sqrt(wanted[p]), 0.02) << p;
  }
}

/// T. Ishigami, T. Homma, 1990: sin x₁ + 7 sin² x₂ + 0.1 x₃⁴ sin x₁ on [−π, π]³.
double ishigami(double x1, double x2, double x3) {
  return std::sin(x1) + 7 * std::sin(x2) * std::sin(x2) + 0.1 * std::pow(x3, 4) * std::sin(x1);
}

TEST(FirstOrder, OfIshigamiAreItsClosedForms) {
  const auto u = uniform(3, 20000, 5);
  std::vector<double> y;
  for (std::size_t k = 0; k < u[0].size(); ++k)
    y.push_back(ishigami(pi * (2 * u[0][k] - 1), pi * (2 * u[1][k] - 1), pi * (2 * u[2][k] - 1)));
  const double variance = 49.0 / 8 + 0.1 * std::pow(pi, 4) / 5 + 0.01 * std::pow(pi, 8) / 18 + 0.5;
  const double first = 0.5 * std::pow(1 + 0.1 * std::pow(pi, 4) / 5, 2) / variance, second = 49.0 / 8 / variance;
  EXPECT_NEAR(first, 0.3139, 1e-4);  // as published
  EXPECT_NEAR(relation(u[0], y).first_order, first, 0.02);
  EXPECT_NEAR(relation(u[1], y).first_order, second, 0.02);
  EXPECT_NEAR(relation(u[2], y).first_order, 0, 0.01);
  // The second has no correlation, so the index is not the square of that.
  EXPECT_LT(std::pow(relation(u[1], y).pearson, 2), 0.01);
}

TEST(FirstOrder, IsNotBiasedByChance) {
  double mean = 0;
  constexpr int draws = 200;
  for (int draw = 0; draw < draws; ++draw) {
    const auto u = uniform(2, 200, 100 + static_cast<std::uint64_t>(draw));
    mean += relation(u[0], u[1]).first_order / draws;
  }
  // One draw scatters by √(2 (M − 1)) / n = 0.0255. Without correction the mean would be (M − 1) / (n − 1) = 0.065.
  EXPECT_NEAR(mean, 0, 4 * 0.0255 / std::sqrt(draws));
}

TEST(FirstOrder, NeverPartsEqualValues) {
  std::vector<double> x, y;
  for (int k = 0; k < 600; ++k) x.push_back(k % 2), y.push_back(k % 2 + 1e-3 * k);
  EXPECT_EQ(relation(x, y).classes, 2U);
}

/// Sobol's points scatter less than independent ones, so the scatter of those must not be subtracted.
TEST(FirstOrder, OfSobolsPointsIsNotCorrectedForChance) {
  constexpr std::size_t rows = 4096;
  boost::random::sobol engine(3);
  std::vector<std::vector<double>> x(3);
  std::vector<double> y;
  for (std::size_t k = 0; k < rows; ++k) {
    for (std::vector<double>& column : x) column.push_back(static_cast<double>(engine()) / std::pow(2.0, 64));
    y.push_back(x[0][k] + 0.15 * x[1][k] + 0.15 * (x[2][k] - 0.5) * (x[0][k] - 0.5));
  }
  // Variances: 1/12, 0.15²/12 and 0.15²/144.
  const double whole = 1.0 / 12 + 0.0225 / 12 + 0.0225 / 144;
  const std::array<double, 3> exact = {1.0 / 12 / whole, 0.0225 / 12 / whole, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const Relation found = relation(x[k], y, Classes::strata);
    EXPECT_NEAR(found.first_order, exact[k], 0.005) << k;
    EXPECT_EQ(found.first_order > indexBound(found.count, found.classes, 0.01, false), exact[k] > 0) << k;
  }
  EXPECT_LT(relation(x[1], y, Classes::quantiles).first_order, 0.6 * exact[1]) << "as it was";
}

TEST(FirstOrder, OverAGridIsExact) {
  std::vector<double> a, b, y;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 3; ++j)
      a.push_back(i), b.push_back(j), y.push_back(3 * i + (j - 1) * (j - 1) + (i - 2) * (j - 1));
  // Var of 3i: 9 · 2; of (j − 1)²: 2/9; of the product: 2 · 2/3.
  const double whole = 18 + 2.0 / 9 + 4.0 / 3;
  EXPECT_NEAR(relation(a, y, Classes::levels).first_order, 18 / whole, 1e-14);
  EXPECT_NEAR(relation(b, y, Classes::levels).first_order, 2.0 / 9 / whole, 1e-14);
  y.back() += 10;
  EXPECT_GT(std::abs(relation(a, y, Classes::levels).first_order - 18 / whole), 0.01);
}

TEST(Bounds, AreExceededByChanceAsOftenAsTheySay) {
  constexpr double alpha = 0.05;
  constexpr int draws = 2000;
  int correlations = 0, indices = 0;
  for (int draw = 0; draw < draws; ++draw) {
    const auto u = uniform(2, 200, 9000 + static_cast<std::uint64_t>(draw));
    const Relation each = relation(u[0], u[1]);
    correlations += std::abs(each.pearson) > correlationBound(each.count, alpha);
    indices += each.first_order > indexBound(each.count, each.classes, alpha);
  }
  const double expected = alpha * draws, scatter = 4 * std::sqrt(expected);
  EXPECT_NEAR(correlations, expected, scatter);
  EXPECT_NEAR(indices, expected, scatter);
}

TEST(Bounds, AreOneWhereThereIsTooLittle) {
  EXPECT_EQ(correlationBound(2, 0.01), 1);
  EXPECT_EQ(indexBound(5, 5, 0.01), 1);
  EXPECT_NEAR(correlationBound(12, 0.05), 0.576, 5e-4);  // as in tables of the correlation coefficient
}

TEST(ColumnStore, GivesTheSameFromMemoryAndFile) {
  constexpr std::size_t rows = 10000;
  for (const std::size_t in_memory : {std::size_t{1'000'000}, std::size_t{9000}, std::size_t{0}}) {
    ColumnStore store(2, in_memory);
    for (std::size_t k = 0; k < rows; ++k) store.addRow({static_cast<double>(k), -static_cast<double>(k)});
    std::vector<double> third(rows, 7);
    third.back() = nan;
    ASSERT_EQ(store.addColumn(third), 2U);
    ASSERT_EQ(store.column(1).size(), rows);
    const std::vector<double> first = store.column(0), second = store.column(1);
    for (std::size_t k = 0; k < rows; ++k) ASSERT_TRUE(first[k] == static_cast<double>(k) && second[k] == -first[k]);
    EXPECT_EQ(store.column(2).front(), 7);
    EXPECT_TRUE(std::isnan(store.column(2).back()));
  }
}

TEST(ColumnStore, RefusesWhatDoesNotFit) {
  ColumnStore store(2);
  EXPECT_THROW(store.addRow({1}), std::logic_error);
  store.addRow({1, 2});
  EXPECT_THROW(store.addColumn({1, 2}), std::logic_error);
}

}  // namespace
}  // namespace ursula

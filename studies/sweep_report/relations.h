#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ursula {

/// How numbers lie; those that are not finite are left out, and all is NaN where none is left.
struct Spread {
  std::size_t count = 0;
  double min = 0, low = 0, median = 0, high = 0, max = 0;  ///< low and high: 5 % and 95 %, interpolated between ranks
  double mean = 0, sd = 0;                                 ///< sd of a sample: over n − 1
  bool constant = true;                                    ///< to rounding
};
Spread spreadOf(const std::vector<double>& values);

/// Counts in bins of equal width from `low` to `high`, in decades where `log`.
struct Histogram {
  double low = 0, high = 0;
  bool log = false;
  std::vector<std::int64_t> counts;  ///< empty where there is nothing to count
};
/// Logarithmic where all is positive and spans three decades.
Histogram histogramOf(const std::vector<double>& values, const Spread& spread, std::size_t bins);

/// Rows by ascending value; ties in the order of the rows. All must be finite.
std::vector<std::uint32_t> orderOf(const std::vector<double>& values);

/// Ranks from 1 of the finite values, ties the mean of theirs; NaN where a value is not finite.
std::vector<double> ranksOf(const std::vector<double>& values);

/// How x is divided for the variance of means.
enum class Classes {
  levels,     ///< one for each value of x: the exact main effect over a complete factorial grid
  quantiles,  ///< about √n of equal population, no value in two: what a class hides of a trend is of order 1/n
  strata  ///< about ∛n, likewise, of points that fill space evenly: chance makes less than (M − 1)/n of the variance
};

/// What a parameter x has to do with an output y, over the rows where y is finite. NaN where x or y is constant.
struct Relation {
  double pearson = 0;      ///< linear correlation
  double spearman = 0;     ///< correlation of ranks
  double first_order = 0;  ///< Var(E[y|x]) / Var(y), Sobol's index of first order; NaN where it was not asked for, too
  std::size_t classes = 0, count = 0;
  bool correlates = false;  ///< told from chance: |correlation|, linear or of ranks, is beyond correlationBound()
  bool acts = false;        ///< the first-order index is beyond indexBound(), in a complete grid beyond rounding
};

/// A parameter with what is wanted of it for every output.
struct Parameter {
  std::vector<double> x;
  std::vector<std::uint32_t> order;  ///< orderOf(x)
};

/// First-order indices from given data, whatever their design (Plischke, Borgonovo, Smith: Global sensitivity measures
/// from given data, European Journal of Operational Research 226 (2013) 536–550, section 3): the variance of y's means
/// over classes of x. In quantiles of independent points each mean carries 1/n_m of the variance within its class,
/// which is taken off (the ε² of Kelley, Proc. Natl. Acad. Sci. 21 (1935) 554–559): (S_between − (M − 1) s²_within) /
/// S_total, which may fall below 0. Levels of a complete grid need no correction, and strata of Sobol's points none:
/// what would be taken off is the scatter of independent points, which they do not have.
Relation relationOf(const Parameter& parameter, const std::vector<double>& y, const std::vector<double>& y_ranks,
                    Classes classes, bool wants_index);

/// What |correlation| of `count` rows of unrelated numbers exceeds with probability `alpha` (Student's t). 1 below
/// three rows.
double correlationBound(std::size_t count, double alpha);

/// What the first-order index in quantiles, or without their correction, of unrelated numbers exceeds with probability
/// `alpha` (Fisher's F); of Sobol's points with less.
double indexBound(std::size_t count, std::size_t classes, double alpha, bool corrected = true);

}  // namespace ursula

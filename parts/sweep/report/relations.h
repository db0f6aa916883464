#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ursula {

/// The distribution of numbers. Non-finite ones are ignored; everything is NaN if none is left.
struct Spread {
  std::size_t count = 0;
  double min = 0, low = 0, median = 0, high = 0,
         max = 0;           ///< low and high are the 5 % and 95 % quantiles, interpolated between ranks
  double mean = 0, sd = 0;  ///< sd of a sample, over n − 1
  bool constant = true;     ///< up to rounding
};
Spread spreadOf(const std::vector<double>& values);

/// Counts in bins of equal width from `low` to `high`, in decades if `log`.
struct Histogram {
  double low = 0, high = 0;
  bool log = false;
  std::vector<std::int64_t> counts;  ///< empty if there is nothing to count
};
/// Logarithmic if all values are positive and span three decades.
Histogram histogramOf(const std::vector<double>& values, const Spread& spread, std::size_t bins);

/// Returns row indices by ascending value; ties keep the order of the rows. All values must be finite.
std::vector<std::uint32_t> orderOf(const std::vector<double>& values);

/// Returns ranks from 1 of the finite values, mean ranks for ties, and NaN for other values.
std::vector<double> ranksOf(const std::vector<double>& values);

/// How x is divided into classes for the variance of means.
enum class Classes {
  levels,     ///< one class per value of x: the exact main effect over a complete factorial grid
  quantiles,  ///< about √n equally filled classes, with no value in two; what they hide of a trend is of order 1/n
  strata      ///< about ∛n classes for evenly spread points; chance gives less than (M − 1)/n of the variance
};

/// The relation of a parameter x to an output y, over the rows with finite y. NaN if x or y is constant.
struct Relation {
  double pearson = 0;      ///< linear correlation
  double spearman = 0;     ///< correlation of ranks
  double first_order = 0;  ///< Var(E[y|x]) / Var(y), Sobol's index of first order; NaN also if not requested
  std::size_t classes = 0, count = 0;
  bool correlates = false;  ///< significant: |correlation|, linear or of ranks, exceeds correlationBound()
  bool acts = false;        ///< the first-order index exceeds indexBound(), or rounding in a complete grid
};

/// A parameter with its data for all outputs.
struct SweptValues {
  std::vector<double> x;
  std::vector<std::uint32_t> order;  ///< orderOf(x)
};

/// The variance of y's means over classes of x: first-order indices from given data of any design (Plischke, Borgonovo,
/// Smith: Global sensitivity measures from given data, European Journal of Operational Research 226 (2013) 536–550,
/// section 3). In quantiles of independent points, each mean carries 1/n_m of the variance within its class. This is
/// subtracted (the ε² of Kelley, Proc. Natl. Acad. Sci. 21 (1935) 554–559): (S_between − (M − 1) s²_within) / S_total,
/// which may be negative. Levels of a complete grid and strata of Sobol's points need no correction, because they lack
/// the scatter of independent points.
Relation relationOf(const SweptValues& parameter, const std::vector<double>& y, const std::vector<double>& y_ranks,
                    Classes classes, bool wants_index);

/// The value that |correlation| of `count` rows of unrelated numbers exceeds with probability `alpha` (Student's t); 1
/// below three rows.
double correlationBound(std::size_t count, double alpha);

/// The value that the first-order index of unrelated numbers in quantiles, corrected or not, exceeds with probability
/// `alpha` (Fisher's F). The probability is smaller for Sobol's points.
double indexBound(std::size_t count, std::size_t classes, double alpha, bool corrected = true);

}  // namespace ursula

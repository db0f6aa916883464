#pragma once

#include <string>
#include <vector>

#include "studies/identify/comparison.h"

namespace ursula::identification {

/// A linear model without its rows. It satisfies ‖rows · x − y‖² = ‖R x − z‖² + rest, with noise of deviation 1 in
/// every row.
struct SquareRoot {
  Eigen::MatrixXd R;
  Eigen::VectorXd z;
  double rest = 0;
  Eigen::Index rows = 0;
};
SquareRoot squareRootOf(const Eigen::MatrixXd& rows_with_y);

/// The comparison after whitening: an autoregression for each motor whitens along time, then a covariance between
/// motors.
struct Whitened {
  Eigen::MatrixXd rows;      ///< six for each instant; columns are the directions, then measured minus model
  Eigen::MatrixXd residual;  ///< left by linear directions, offsets and delay; N·m or N, an instant in each row
  int order = 0;             ///< order of the autoregressions
  Eigen::Index rank = 0;     ///< rank of that fit
};
Whitened whiten(const Comparison& comparison);

/// A combination of directions that the motion shows, and its value.
struct BaseParameter {
  std::vector<std::pair<Eigen::Index, double>> terms;  ///< directions and factors; the first factor is 1
  double nominal = 0, value = 0;
  double deviation = 0;  ///< standard uncertainty
};

/// The least-squares fit of the combinations that the motion shows.
struct BaseFit {
  std::vector<BaseParameter> parameters;
  std::vector<Eigen::Index> unseen;  ///< directions without effect on the efforts
  Eigen::VectorXd step;              ///< one solution for the directions
  double squares = 0;                ///< remaining squares in units of the noise
  Eigen::Index freedom = 0;
  double quantile = 0;  ///< Student's quantile for 95 %
};

/// Fits the first `count` directions by QR with column pivoting. A combination counts as shown if a plausible change of
/// it is at least a tenth of the noise.
BaseFit fitBase(const SquareRoot& model, const std::vector<Direction>& directions, Eigen::Index count);

/// Sets plausible sizes of the linear directions' differences, from the machine and its efforts.
void setPlausible(const ManipulatorParameters& machine, const Comparison& comparison,
                  std::vector<Direction>& directions);

/// Root mean squares of efforts divided by their noise, on rows that were not fitted. One is for the given model, the
/// other for the fit to the first 70 % of the time. Noise alone gives 1.
struct CrossValidation {
  double given = 0, fitted = 0;
  double from_s = 0;
};
CrossValidation crossValidate(const Whitened& whitened, const Comparison& comparison);

}  // namespace ursula::identification

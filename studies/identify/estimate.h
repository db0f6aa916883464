#pragma once

#include <string>
#include <vector>

#include "studies/identify/comparison.h"

namespace ursula::identification {

/// A linear model without its rows: ‖rows · x − y‖² = ‖R x − z‖² + rest, with noise of deviation 1 in every row.
struct SquareRoot {
  Eigen::MatrixXd R;
  Eigen::VectorXd z;
  double rest = 0;
  Eigen::Index rows = 0;
};
SquareRoot squareRootOf(const Eigen::MatrixXd& rows_with_y);

/// The comparison with noise made white: along time by an autoregression for each motor, then between motors.
struct Whitened {
  Eigen::MatrixXd rows;      ///< six for each instant; columns of the directions, then what was measured less the model
  Eigen::MatrixXd residual;  ///< of the fit by all linear directions, offsets and delay, an instant a row, N·m or N
  int order = 0;             ///< of the autoregressions
  Eigen::Index rank = 0;     ///< of that fit
};
Whitened whiten(const Comparison& comparison);

/// A combination of directions that the motion shows, and what it is.
struct BaseParameter {
  std::vector<std::pair<Eigen::Index, double>> terms;  ///< direction and its factor; the first has 1
  double nominal = 0, value = 0;
  double deviation = 0;  ///< standard uncertainty
};

/// Least squares for what the motion shows of some directions.
struct BaseFit {
  std::vector<BaseParameter> parameters;
  std::vector<Eigen::Index> unseen;  ///< directions without effect on the efforts
  Eigen::VectorXd step;              ///< of the directions: one solution
  double squares = 0;                ///< left, in units of the noise
  Eigen::Index freedom = 0;
  double quantile = 0;  ///< Student's, of 95 %
};

/// By QR with column pivoting; a combination counts as shown where a plausible change of it is at least a tenth of the
/// noise. `count` is that of the leading directions.
BaseFit fitBase(const SquareRoot& model, const std::vector<Direction>& directions, Eigen::Index count);

/// Sizes that the linear directions' differences may have, from the machine and its efforts.
void setPlausible(const ManipulatorParameters& machine, const Comparison& comparison,
                  std::vector<Direction>& directions);

/// Root mean square of efforts over their noise, on rows that were not fitted: of the model as given, and as fitted to
/// the first 70 % of the time. Noise alone gives 1.
struct CrossValidation {
  double given = 0, fitted = 0;
  double from_s = 0;
};
CrossValidation crossValidate(const Whitened& whitened, const Comparison& comparison);

}  // namespace ursula::identification

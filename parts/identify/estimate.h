#pragma once

#include <Eigen/Cholesky>
#include <string>
#include <vector>

#include "parts/identify/comparison.h"
#include "parts/identify/identify.h"

namespace ursula::identification {

/// The covariance of efforts by noise of the samples of efforts and motion, after the low passes. Instants are
/// correlated within blocks, and blocks are independent of each other.
class EffortNoise {
 public:
  EffortNoise() = default;
  EffortNoise(const FilteredLog& filtered, const Comparison& comparison);

  /// Returns each motor's variance at each instant, (N·m)² or N²; an instant in each row.
  const Eigen::MatrixXd& variances() const { return variances_; }
  /// Adds noise of the efforts' samples: each motor's variances grow by `more`, (N·m)² or N².
  void add(const Vector6d& more);
  /// Makes the noise of all rows independent, with deviation 1; six rows for each instant, in the order of time.
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& rows) const;
  /// Multiplies by the inverse covariance.
  Eigen::VectorXd weighed(const Eigen::VectorXd& column) const;

 private:
  struct Block {
    Eigen::Index first = 0, count = 0;  ///< instants
    Eigen::MatrixXd covariance;
    Eigen::LLT<Eigen::MatrixXd> factors;
  };
  void fill(Block& block, const Comparison& comparison, const Eigen::VectorXd& motion) const;

  Eigen::VectorXd memory_;                  ///< correlation of the efforts' noise by the number of instants between
  std::vector<Eigen::Matrix3d> by_motion_;  ///< covariance of value, rate and acceleration, likewise, 3 × 3
  std::vector<Block> blocks_;
  Eigen::MatrixXd variances_;
};

/// Returns the likeliest noise of the motion. `weighed` is the efforts' noise of all kinds times its inverse
/// covariance. Each row has an instant's value, rate and acceleration of all channels. The noise is hardly larger than
/// its deviation.
Eigen::MatrixXd likelyNoiseOfMotion(const FilteredLog& filtered, const Comparison& comparison,
                                    const Eigen::VectorXd& weighed);

/// A possible noise of a log, by the sizes and spectra that its filter plan has.
struct NoiseDraw {
  Eigen::MatrixXd motion;   ///< an instant of the motion in each row; value, rate and acceleration of all channels
  Eigen::VectorXd efforts;  ///< what it and noise of the efforts add to measured minus modelled efforts, N·m or N, six
                            ///< rows for each instant of the comparison
};
/// Draws a noise, always the same.
NoiseDraw drawNoise(const FilteredLog& filtered, const Comparison& comparison);

/// A linear model without its rows. It satisfies ‖rows · x − y‖² = ‖R x − z‖² + rest, with noise of deviation 1 in
/// every row.
struct SquareRoot {
  Eigen::MatrixXd R;
  Eigen::VectorXd z;
  double rest = 0;
  Eigen::Index rows = 0;
  /// A right model can have this z, because columns and residual share noise of the motion. It is as large as chance
  /// makes it unless noise dominates a column.
  Eigen::VectorXd shared;
};
SquareRoot squareRootOf(const Eigen::MatrixXd& rows_with_y);

/// The comparison in units of its noise.
struct Whitened {
  Eigen::MatrixXd rows;       ///< six for each instant; columns are the directions, then measured minus model
  Eigen::MatrixXd residual;   ///< left by linear directions, offsets and delay; N·m or N, an instant in each row
  Eigen::VectorXd weighed;    ///< the residual times the inverse covariance of noise, six rows for each instant
  Eigen::MatrixXd variances;  ///< of the noise, likewise
  Vector6d expected;          ///< root mean squares of noise as the samples explain it, N·m or N
  Eigen::Index rank = 0;      ///< rank of that fit
  EffortNoise noise;          ///< the noise, whose deviation is the unit of `rows`
};
/// Divides the comparison by its noise. A motor's noise grows to its residual if that exceeds the noise by more than
/// chance.
Whitened whiten(const Comparison& comparison, EffortNoise noise);

/// Sets `model.shared`. `noisy` is the comparison with the draw's noise in its motion.
void setShared(const NoiseDraw& draw, const Comparison& comparison, const Comparison& noisy, const Whitened& whitened,
               SquareRoot& model);

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

/// Fits the first `count` directions by QR with column pivoting. A combination counts as shown if noise is at most a
/// tenth of its plausible change. What is not shown has no effect on those combinations.
BaseFit fitBase(const SquareRoot& model, const std::vector<Direction>& directions, Eigen::Index count);

/// Sets plausible sizes of the linear directions' differences, from the machine and its efforts.
void setPlausible(const ManipulatorParameters& machine, const Comparison& comparison,
                  std::vector<Direction>& directions);

/// Root mean squares of efforts on rows that were not fitted, divided by what is expected. They are 1 if the model
/// holds. `given` is that of the given model, divided by the noise. `fitted` is that of the fit to the first 70 % of
/// the time, divided by noise and the fit's own uncertainty.
struct CrossValidation {
  double given = 0, fitted = 0;
  double from_s = 0;
};
CrossValidation crossValidate(const Whitened& whitened, const Comparison& comparison);

/// Returns the link that a number of a leg belongs to.
inline const Link& linkOf(const ManipulatorParameters& machine, const MachineNumber& number) {
  const Leg& leg = machine.legs[number.leg];
  return number.body == NumberBody::proximal ? leg.proximal : leg.distal;
}

/// A machine's number and its estimate from the log.
struct NumberEstimate {
  MachineNumber number;
  double before = 0;        ///< prior standard uncertainty
  MeasuredNumber measured;  ///< without an interval
};

/// Estimates the numbers of the likeliest machine that is physical. Masses are positive, some body can have the moments
/// of inertia, and friction resists. The prior is the scenario's numbers, within their tolerances if `by_tolerances`,
/// otherwise within their own size.
std::vector<NumberEstimate> estimateNumbers(const SquareRoot& model, const Comparison& comparison,
                                            const ManipulatorParameters& machine, const NumberTolerances& tolerances,
                                            bool by_tolerances);

}  // namespace ursula::identification

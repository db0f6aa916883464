#pragma once

#include <string>
#include <vector>

#include "studies/identify/noise.h"

namespace ursula::identification {

/// A linear model without its rows. It satisfies ‖rows · x − y‖² = ‖R x − z‖² + rest, with noise of deviation 1 in
/// every row.
struct SquareRoot {
  Eigen::MatrixXd R;
  Eigen::VectorXd z;
  double rest = 0;
  Eigen::Index rows = 0;
  /// A possible z of a right model, because columns and residual share noise of the motion. As large as chance makes it
  /// unless noise dominates a column.
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
  EffortNoise noise;          ///< the noise that this is in units of
};
/// Noise of a motor grows to its residual if that is more than chance.
Whitened whiten(const Comparison& comparison, EffortNoise noise);

/// Sets what columns and residual share. `noisy` is the comparison with the draw's noise in its motion.
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

/// Root mean squares of efforts on rows that were not fitted, divided by what is expected: 1 if the model holds. One is
/// the given model's, by the noise; the other is that of the fit to the first 70 % of the time, by noise and the fit's
/// own uncertainty.
struct CrossValidation {
  double given = 0, fitted = 0;
  double from_s = 0;
};
CrossValidation crossValidate(const Whitened& whitened, const Comparison& comparison);

/// Returns the link that a number of a leg belongs to.
inline const Link& linkOf(const ManipulatorParameters& machine, const MachineNumber& number) {
  const Leg& leg = machine.legs[number.leg];
  return number.body == "proximal" ? leg.proximal : leg.distal;
}

/// A machine's number and its estimate from the log.
struct NumberEstimate {
  MachineNumber number;
  double nominal = 0, value = 0;
  double tolerance = -1;    ///< the scenario's tolerance; negative for none
  double before = 0;        ///< prior standard uncertainty
  double deviation = 0;     ///< posterior standard uncertainty
  bool identified = false;  ///< whether the uncertainty is below a tenth of its own size
};

/// Estimates the likeliest machine that is physical. Masses are positive, some body can have the moments of inertia,
/// and friction resists. The prior is the scenario's numbers, within their tolerances if `by_tolerances`, otherwise
/// within their own size.
struct PhysicalEstimate {
  std::vector<NumberEstimate> numbers;
  ManipulatorParameters machine;
  Vector6d offsets = Vector6d::Zero();
};
PhysicalEstimate estimateMachine(const SquareRoot& model, const Comparison& comparison,
                                 const ManipulatorParameters& machine, const NumberTolerances& tolerances,
                                 bool by_tolerances);

}  // namespace ursula::identification

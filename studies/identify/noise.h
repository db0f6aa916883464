#pragma once

#include <Eigen/Cholesky>

#include "studies/identify/comparison.h"

namespace ursula::identification {

/// Covariance of efforts by noise of the samples of efforts and motion, after the low passes. Instants are correlated
/// within blocks, and blocks are independent of each other.
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

/// Returns the motion's likeliest noise, given the efforts' noise of all kinds times its inverse covariance: an instant
/// of the motion in each row; value, rate and acceleration of all channels. Its size is at most about its deviation.
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

}  // namespace ursula::identification

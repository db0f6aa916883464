#pragma once

#include <Eigen/Core>
#include <vector>

#include "studies/identify/measured_log.h"

namespace ursula::identification {

/// A zero-phase low pass of finite length and its first two derivatives: a sinc under a Gaussian window. One smoothing
/// for the value and both rates, so that what holds between unfiltered signals holds between filtered ones.
struct Kernel {
  /// For rows `step` s apart, at the instant of a row plus `shift` s. Half of the power passes at `cut`, Hz.
  Kernel(double cut, double step, double shift = 0);

  /// By `weights` at the rows `centers` of `x`, each at least `half` rows from its ends.
  static Eigen::MatrixXd apply(const Eigen::VectorXd& weights, const Eigen::MatrixXd& x,
                               const std::vector<Eigen::Index>& centers);
  /// Rows on either side that a kernel needs.
  static int halfLength(double cut, double step);

  int half;
  Eigen::VectorXd value, rate, acceleration;  ///< weights of rows −half … half
};

/// Deviation of white noise on a signal that is smooth over seven rows: by sixth differences, their blocks' median.
double whiteNoise(const Eigen::VectorXd& signal);

/// The step in which a signal's values come; 0 where they do not.
double quantum(const Eigen::VectorXd& signal);

/// Rows in which a signal rests at its largest or smallest value longer than it does anywhere else.
std::vector<Eigen::Index> saturatedRows(const Eigen::VectorXd& signal);

/// Up to where a motion has its acceleration: the frequency, Hz, below which all but 0.1 % of its power above the noise
/// is, the largest over the channels.
double motionBandwidth(const MeasuredLog& log);

/// One-sided power spectral density, unit²/Hz, at k / (2 (size − 1) step) Hz; Hann windows, half overlapping.
Eigen::VectorXd powerSpectrum(const Eigen::VectorXd& signal, double step, int most_size = 512);

/// A log of one motion again and again as one period of it, and what its channels scatter by.
struct Periods {
  int count = 1;                               ///< 1: not periodic
  Eigen::Index rows = 0;                       ///< of a period
  Eigen::VectorXd motion_noise, effort_noise;  ///< deviation of a single row; empty where there is one period
};

/// Finds the period; where there are two or more, `log` becomes their average.
Periods averagePeriods(MeasuredLog& log);

}  // namespace ursula::identification

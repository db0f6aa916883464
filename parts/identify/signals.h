#pragma once

#include <Eigen/Core>
#include <vector>

#include "parts/identify/measured_log.h"

namespace ursula::identification {

/// Value, rate and acceleration of a log's motion: six driven coordinates, or p and q.
struct MeasuredState {
  Eigen::VectorXd value, rate, acceleration;
};

/// A zero-phase low pass of finite length with its first two derivatives: a sinc under a Gaussian window. Value and
/// both rates have the same smoothing. Relations between unfiltered signals therefore hold between filtered ones.
struct Kernel {
  /// Serves rows `step` s apart, at a row's instant plus `shift` s. Half of the amplitude passes at `cut`, Hz.
  Kernel(double cut, double step, double shift = 0);

  /// Applies `weights` at the rows `centers` of `x`, each at least `half` rows from its ends.
  static Eigen::MatrixXd apply(const Eigen::VectorXd& weights, const Eigen::MatrixXd& x,
                               const std::vector<Eigen::Index>& centers);
  /// Returns the largest relative error of a signal well below the cut-off, because the window ends. The integral of
  /// the kernel beyond w deviations is at most 2 exp(−w²/2) / (π w²).
  static double passError();
  /// Returns the rows that a kernel needs on either side.
  static int halfLength(double cut, double step);

  int half;
  Eigen::VectorXd value, rate, acceleration;  ///< weights for rows −half … half
};

/// Returns the deviation of white noise on a signal that is smooth over seven rows. It is the median over blocks of
/// sixth differences, without those that a `filled` row enters.
double whiteNoise(const Eigen::VectorXd& signal, const std::vector<bool>& filled = {});

/// Returns the variance of each column.
Eigen::VectorXd variances(const Eigen::MatrixXd& channels);

/// Returns the quantisation step of a signal's values; 0 if there is none.
double quantum(const Eigen::VectorXd& signal);

/// Returns rows in which a signal stays at its largest or smallest value longer than at any other value.
std::vector<Eigen::Index> saturatedRows(const Eigen::VectorXd& signal);

/// Frequencies of a motion, Hz; the largest of all channels counts.
struct Bandwidth {
  double most = 0;  ///< below it is all but 0.1 % of the acceleration's power above the noise
  double end = 0;   ///< the acceleration falls below its noise here
};
Bandwidth motionBandwidth(const MeasuredLog& log);

/// One period of equally spaced rows as a finite Fourier series, a channel in each column.
class FourierSeries {
 public:
  FourierSeries() = default;
  /// Takes coefficients, a channel in each row and a harmonic in each column; the first cosine is the mean. harmonics()
  /// is 0.
  FourierSeries(double frequency, Eigen::MatrixXd cosines, Eigen::MatrixXd sines)
      : frequency_(frequency), cosines_(std::move(cosines)), sines_(std::move(sines)) {}
  /// Fits the rows. `noise` has the deviation of each channel's white noise. harmonics() is one more than the last
  /// harmonic above the noise. The search goes at least up to `least` Hz, if the rows allow that.
  FourierSeries(const Eigen::MatrixXd& rows, double step, const Eigen::VectorXd& noise, double least);

  int harmonics() const { return harmonics_; }
  /// Returns the number of all harmonics that the search found, those in the noise included.
  int known() const { return static_cast<int>(cosines_.cols()) - 1; }
  double frequency() const { return frequency_; }
  /// Returns the sum of the first `harmonics` <= known() harmonics.
  MeasuredState at(double t, int harmonics) const;

 private:
  double frequency_ = 0;  ///< Hz
  int harmonics_ = 0;
  Eigen::MatrixXd cosines_, sines_;
};

/// Returns the one-sided power spectral density by half-overlapping Hann windows, unit²/Hz. Entry k of n is at k / (2
/// (n − 1) step) Hz.
Eigen::VectorXd powerSpectrum(const Eigen::VectorXd& signal, double step, int most_size = 512);

/// The standard deviation of white noise on each channel of a log's rows.
struct SampleNoise {
  Eigen::VectorXd motion, efforts;
};

/// The number of periods of a log that repeats one motion, 1 for another, and the noise of its average.
struct Periods {
  int count = 1;
  SampleNoise noise;
};

/// Finds the period. If there are two or more, `log` becomes their average, whose noise is that of their scatter.
Periods averagePeriods(MeasuredLog& log);

}  // namespace ursula::identification

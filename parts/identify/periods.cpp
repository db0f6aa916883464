#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/FFT>

#include "parts/identify/signals.h"

namespace ursula::identification {
namespace {

/// Returns the motion's channels that move, without their means, in units of their deviations.
Eigen::MatrixXd moving(const Eigen::MatrixXd& motion) {
  const Eigen::VectorXd variance = variances(motion);
  std::vector<Eigen::Index> channels;
  for (Eigen::Index k = 0; k < motion.cols(); ++k)
    if (variance(k) > 0) channels.push_back(k);
  const Eigen::MatrixXd x = motion(Eigen::all, channels);
  return (x.rowwise() - x.colwise().mean()) * variance(channels).cwiseSqrt().cwiseInverse().asDiagonal();
}

/// Returns the mismatch of such channels and themselves `lag` rows later, for every lag: 0 is equal, 1 unrelated.
Eigen::VectorXd mismatches(const Eigen::MatrixXd& channels) {
  const Eigen::Index rows = channels.rows();
  Eigen::Index size = 16;
  while (size < 2 * rows) size *= 2;
  Eigen::FFT<double> fft;
  Eigen::VectorXd out =
      Eigen::VectorXd::Zero(rows / 2 + 2);  // with a neighbour of half the rows: two periods are enough
  for (Eigen::Index k = 0; k < channels.cols(); ++k) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(size), correlation(size);
    x.head(rows) = channels.col(k);
    Eigen::VectorXcd transform(size);
    fft.fwd(transform, x);
    transform = transform.cwiseAbs2().cast<std::complex<double>>().eval();
    fft.inv(correlation, transform);
    double energy = 2 * x.squaredNorm();
    for (Eigen::Index lag = 0; lag < out.size(); ++lag) {
      out(lag) += std::max(0.0, energy - 2 * correlation(lag)) / (2 * static_cast<double>(rows - lag));
      energy -= x(lag) * x(lag) + x(rows - 1 - lag) * x(rows - 1 - lag);
    }
  }
  return out / static_cast<double>(channels.cols());
}

double mismatchAt(const Eigen::MatrixXd& channels, Eigen::Index lag) {
  const Eigen::Index rows = channels.rows() - lag;
  return (channels.bottomRows(rows) - channels.topRows(rows)).squaredNorm() /
         (2.0 * static_cast<double>(rows * channels.cols()));
}

/// Returns the rows of one period; 0 if there are fewer than two periods.
Eigen::Index periodOf(const MeasuredLog& log) {
  if (std::find(log.missing.begin(), log.missing.end(), true) != log.missing.end()) return 0;
  const Eigen::MatrixXd channels = moving(log.motion);
  if (channels.cols() == 0) return 0;
  const Eigen::VectorXd unlike = mismatches(channels);
  double noise = 0;
  for (Eigen::Index k = 0; k < channels.cols(); ++k)
    noise += std::pow(whiteNoise(channels.col(k)), 2) / static_cast<double>(log.motion.cols());
  const double same = 2 * noise + 1e-6;
  bool has_left = false;
  for (Eigen::Index lag = 1; lag + 1 < unlike.size(); ++lag) {
    has_left = has_left || unlike(lag) > 0.1;
    if (!has_left || unlike(lag) > 10 * same || unlike(lag) > unlike(lag - 1) || unlike(lag) > unlike(lag + 1))
      continue;
    const Eigen::Index last = (log.rows() / lag - 1) * lag;  // periods drift apart if they are not whole rows
    if (mismatchAt(channels, lag) <= same && mismatchAt(channels, last) <= same) return lag;
  }
  return 0;
}

/// Returns the mean over the periods, and sets its standard deviation.
Eigen::MatrixXd averaged(const Eigen::MatrixXd& x, Eigen::Index rows, int count, Eigen::VectorXd& deviation) {
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(rows, x.cols());
  for (int i = 0; i < count; ++i) mean += x.middleRows(i * rows, rows) / count;
  deviation = Eigen::VectorXd::Zero(x.cols());
  for (int i = 0; i < count; ++i)
    deviation += (x.middleRows(i * rows, rows) - mean).colwise().squaredNorm().transpose();
  deviation = (deviation / (static_cast<double>(rows) * (count - 1))).cwiseSqrt();
  deviation *= 1 / std::sqrt(static_cast<double>(count));
  return mean;
}

}  // namespace

Periods averagePeriods(MeasuredLog& log) {
  Periods out;
  SampleNoise& noise = out.noise;
  const Eigen::Index rows = periodOf(log);
  if (rows == 0) {
    noise = {Eigen::VectorXd(log.motion.cols()), Eigen::VectorXd(motor_count)};
    for (Eigen::Index k = 0; k < log.motion.cols(); ++k) noise.motion(k) = whiteNoise(log.motion.col(k), log.filled);
    for (Eigen::Index k = 0; k < motor_count; ++k) noise.efforts(k) = whiteNoise(log.efforts.col(k), log.filled);
    return out;
  }
  out.count = static_cast<int>(log.rows() / rows);
  Eigen::VectorXd unused;
  log.motion = averaged(log.motion, rows, out.count, noise.motion);
  log.efforts = averaged(log.efforts, rows, out.count, noise.efforts);
  if (log.load.cols() > 0) log.load = averaged(log.load, rows, out.count, unused);
  log.missing.assign(rows, false);
  log.filled.clear();
  return out;
}

}  // namespace ursula::identification

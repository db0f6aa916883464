#include "parts/identify/signals.h"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/FFT>

#include "base/scalar.h"

namespace ursula::identification {
namespace {

/// roll_off is the Gaussian window's deviation over frequency, in cut-off frequencies. window_end is where it ends over
/// time, in deviations.
constexpr double roll_off = 0.2, window_end = 5.5;

/// Averages 2 `by` + 1 neighbours, of which about a third is independent. A single peak of the noise then does not
/// count as a signal.
Eigen::VectorXd smoothed(const Eigen::VectorXd& x, Eigen::Index by) {
  Eigen::VectorXd out(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const Eigen::Index first = std::max<Eigen::Index>(0, i - by), end = std::min(x.size(), i + by + 1);
    out(i) = x.segment(first, end - first).mean();
  }
  return out;
}

Eigen::VectorXd hannWindow(Eigen::Index rows) {
  Eigen::VectorXd out(rows);
  for (Eigen::Index k = 0; k < rows; ++k)
    out(k) = 0.5 - 0.5 * std::cos(2 * pi * (static_cast<double>(k) + 0.5) / static_cast<double>(rows));
  return out;
}

/// Returns the one-sided squares of the transform.
Eigen::VectorXd transformSquares(const Eigen::VectorXd& signal) {
  Eigen::FFT<double> fft;
  Eigen::VectorXcd transform(signal.size());
  fft.fwd(transform, signal);
  return transform.head(signal.size() / 2 + 1).cwiseAbs2();
}

/// Returns the spectrum of a whole signal, or of its first 65,536 values, under one window.
Eigen::VectorXd wholeSpectrum(const Eigen::VectorXd& signal, double step) {
  const Eigen::Index rows = std::min<Eigen::Index>(signal.size(), 1 << 16);
  Eigen::Index size = 16;
  while (size < rows) size *= 2;
  const Eigen::VectorXd window = hannWindow(rows);
  Eigen::VectorXd part = Eigen::VectorXd::Zero(size);
  part.head(rows) = signal.head(rows).cwiseProduct(window);
  return transformSquares(part) * (2 * step / window.squaredNorm());
}

/// Returns first rows and ends of the longest run without a missing row and of others at least a quarter as long.
std::vector<std::pair<Eigen::Index, Eigen::Index>> longRuns(const std::vector<bool>& missing) {
  std::vector<std::pair<Eigen::Index, Eigen::Index>> runs;
  const auto rows = static_cast<Eigen::Index>(missing.size());
  Eigen::Index longest = 0;
  for (Eigen::Index first = 0; first < rows;) {
    const bool lacks = missing[first];
    const auto end = std::find(missing.begin() + first, missing.end(), !lacks) - missing.begin();
    if (!lacks) runs.emplace_back(first, end), longest = std::max(longest, end - first);
    first = end;
  }
  const auto is_short = [longest](const auto& run) { return 4 * (run.second - run.first) < longest; };
  runs.erase(std::remove_if(runs.begin(), runs.end(), is_short), runs.end());
  return runs;
}

/// Returns the bandwidth of one channel over rows without a gap. Second differences stand for the acceleration; `floor`
/// is the spectrum of their white noise.
Bandwidth bandwidthOf(const Eigen::VectorXd& signal, double step, double noise) {
  const double nyquist = 0.5 / step;
  const Eigen::Index rows = signal.size() - 2;
  const Eigen::VectorXd second = signal.tail(rows) - 2 * signal.segment(1, rows) + signal.head(rows);
  const Eigen::VectorXd power = wholeSpectrum(second, step), wide = smoothed(power, 16), narrow = smoothed(power, 4);
  const auto frequency = [&](Eigen::Index i) {
    return nyquist * static_cast<double>(i) / static_cast<double>(power.size() - 1);
  };
  const auto floor = [&](Eigen::Index i) {
    return 2 * step * noise * noise * std::pow(2 * std::sin(0.5 * pi * frequency(i) / nyquist), 4);
  };
  double total = 0;
  std::vector<double> sums;
  for (Eigen::Index i = 0; i < power.size(); ++i) {
    total += wide(i) > 4 * floor(i) ? power(i) : 0;
    sums.push_back(total);
  }
  Eigen::Index at = std::lower_bound(sums.begin(), sums.end(), 0.999 * total) - sums.begin();
  const double most = frequency(at + 1);
  while (at + 1 < power.size() && narrow(at) > 5 * floor(at)) ++at;
  return {most, frequency(at + 1)};
}

double windowDeviation(double cut) { return 1 / (2 * pi * roll_off * cut); }

/// Returns sin(a u) / (π u) and its first two derivatives.
std::array<double, 3> sincOf(double a, double u) {
  const double x = a * u;
  if (std::abs(x) < 1e-2)
    return {a / pi * (1 - x * x / 6), a / pi * (-a * x / 3 + a * x * x * x / 30),
            a / pi * a * a * (-1.0 / 3 + x * x / 10)};
  const double s = std::sin(x), c = std::cos(x);
  return {s / (pi * u), (x * c - s) / (pi * u * u), (2 * s - 2 * x * c - x * x * s) / (pi * u * u * u)};
}

}  // namespace

double Kernel::passError() { return 2 * std::exp(-window_end * window_end / 2) / (pi * window_end * window_end); }

int Kernel::halfLength(double cut, double step) {
  return static_cast<int>(std::ceil(window_end * windowDeviation(cut) / step));
}

Kernel::Kernel(double cut, double step, double shift)
    : half(halfLength(cut, step) + static_cast<int>(std::ceil(std::abs(shift) / step))),
      value(2 * half + 1),
      rate(2 * half + 1),
      acceleration(2 * half + 1) {
  const double s2 = windowDeviation(cut) * windowDeviation(cut), a = 2 * pi * cut;
  for (int k = -half; k <= half; ++k) {
    const double u = shift - k * step, window = step * std::exp(-u * u / (2 * s2));
    const auto [f, f1, f2] = sincOf(a, u);
    value(k + half) = f * window;
    rate(k + half) = (f1 - f * u / s2) * window;
    acceleration(k + half) = (f2 - 2 * f1 * u / s2 + f * (u * u / s2 - 1) / s2) * window;
  }
  // The window is finite, but a parabola has its exact value at the row, rate and acceleration.
  const Eigen::VectorXd u = shift - step * Eigen::VectorXd::LinSpaced(2 * half + 1, -half, half).array();
  value /= value.sum();
  rate.array() -= rate.mean();
  rate /= -rate.dot(u);
  acceleration.array() -= acceleration.mean();
  acceleration *= 2 / acceleration.dot(u.cwiseAbs2());
}

Eigen::MatrixXd Kernel::apply(const Eigen::VectorXd& weights, const Eigen::MatrixXd& x,
                              const std::vector<Eigen::Index>& centers) {
  const Eigen::Index size = weights.size();
  Eigen::MatrixXd out(centers.size(), x.cols());
  for (Eigen::Index column = 0; column < x.cols(); ++column)
    for (std::size_t i = 0; i < centers.size(); ++i)
      out(i, column) = weights.dot(x.col(column).segment(centers[i] - size / 2, size));
  return out;
}

double whiteNoise(const Eigen::VectorXd& signal, const std::vector<bool>& filled) {
  constexpr Eigen::Index block = 64;
  // A median of squares is below their mean. A block has 64 / 3.17 independent ones, by their autocorrelation.
  const double median = std::pow(1 - 2 / (9 * 64 / 3.17), 3);
  std::vector<double> squares;
  for (Eigen::Index first = 0; first + 7 <= signal.size(); first += block) {
    double sum = 0;
    Eigen::Index count = 0;
    const Eigen::Index end = std::min(first + block, signal.size() - 6);
    for (Eigen::Index i = first; i < end; ++i) {
      const auto at = filled.begin() + (filled.empty() ? 0 : i);
      if (!filled.empty() && std::find(at, at + 7, true) != at + 7) continue;
      const double d = signal(i) - 6 * signal(i + 1) + 15 * signal(i + 2) - 20 * signal(i + 3) + 15 * signal(i + 4) -
                       6 * signal(i + 5) + signal(i + 6);
      sum += d * d;
      ++count;
    }
    if (count > 0) squares.push_back(sum / static_cast<double>(count));
  }
  if (squares.empty()) return 0;
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return std::sqrt(*middle / (924 * median));  // 924 is the sum of the squared binomials
}

Eigen::VectorXd variances(const Eigen::MatrixXd& channels) {
  return (channels.rowwise() - channels.colwise().mean()).cwiseAbs2().colwise().mean().transpose();
}

double quantum(const Eigen::VectorXd& signal) {
  const Eigen::Index rows = std::min<Eigen::Index>(signal.size(), 20'000);
  std::vector<double> steps;
  for (Eigen::Index i = 1; i < rows; ++i)
    if (const double step = std::abs(signal(i) - signal(i - 1)); step > 0) steps.push_back(step);
  if (steps.size() < 16) return 0;
  const double smallest = *std::min_element(steps.begin(), steps.end());
  const double size = signal.head(rows).cwiseAbs().maxCoeff();
  if (smallest < 1e-11 * size) return 0;
  const auto whole = std::count_if(steps.begin(), steps.end(), [&](double step) {
    return std::abs(std::remainder(step, smallest)) < 1e-3 * smallest + 1e-13 * size;
  });
  return static_cast<double>(whole) > 0.99 * static_cast<double>(steps.size()) ? smallest : 0;
}

std::vector<Eigen::Index> saturatedRows(const Eigen::VectorXd& signal) {
  const double high = signal.maxCoeff(), low = signal.minCoeff();
  if (high == low) return {};
  Eigen::Index longest_else = 1;
  std::vector<std::pair<Eigen::Index, Eigen::Index>> at_ends;
  for (Eigen::Index i = 0; i < signal.size();) {
    Eigen::Index end = i + 1;
    while (end < signal.size() && signal(end) == signal(i)) ++end;
    if (signal(i) == high || signal(i) == low)
      at_ends.emplace_back(i, end);
    else
      longest_else = std::max(longest_else, end - i);
    i = end;
  }
  std::vector<Eigen::Index> out;
  for (const auto& [first, end] : at_ends)
    if (end - first >= std::max<Eigen::Index>(5, 3 * longest_else))
      for (Eigen::Index i = first; i < end; ++i) out.push_back(i);
  return out;
}

Eigen::VectorXd powerSpectrum(const Eigen::VectorXd& signal, double step, int most_size) {
  int size = 16;
  while (2 * size <= most_size && 2 * size <= signal.size()) size *= 2;
  const Eigen::VectorXd window = hannWindow(size);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(size / 2 + 1);
  int count = 0;
  for (Eigen::Index first = 0; first + size <= signal.size(); first += size / 2, ++count) {
    const Eigen::ArrayXd part = signal.segment(first, size).array();
    out += transformSquares((part - part.mean()) * window.array());
  }
  return count == 0 ? out : Eigen::VectorXd(out * (2 * step / (count * window.squaredNorm())));
}

Bandwidth motionBandwidth(const MeasuredLog& log) {
  Bandwidth out;
  const Eigen::VectorXd deviations = variances(log.motion).cwiseSqrt();
  for (const auto& [first, end] : longRuns(log.missing))
    for (Eigen::Index k = 0; k < log.motion.cols(); ++k) {
      if (deviations(k) < 1e-2 * deviations.maxCoeff() || end - first < 64) continue;
      const Bandwidth found = bandwidthOf(log.motion.col(k).segment(first, end - first), log.step,
                                          whiteNoise(log.motion.col(k), log.filled));
      out = {std::max(out.most, found.most), std::max(out.end, found.end)};
    }
  return out;
}

FourierSeries::FourierSeries(const Eigen::MatrixXd& rows, double step, const Eigen::VectorXd& noise, double least)
    : frequency_(1 / (step * static_cast<double>(rows.rows()))), cosines_(rows.colwise().mean().transpose()) {
  // A harmonic counts if its power is `surely` times the noise's, or `hardly` times after one that counts. The search
  // ends `silent` harmonics beyond twice the last one that counts, or at `highest` of the rows' rate.
  constexpr double surely = 15, hardly = 3, highest = 0.18, rounding = 1e-11;
  constexpr int silent = 6, most = 1000;
  sines_ = Eigen::MatrixXd::Zero(rows.cols(), 1);
  const auto count = static_cast<double>(rows.rows());
  const Eigen::ArrayXd floor = noise.array().max(rounding * rows.cwiseAbs().maxCoeff()).max(1e-150).square();
  int last = 0;
  bool falls = true;
  for (int k = 1; k < std::min<double>(highest * count, most) && (k <= 2 * last + silent || k * frequency_ < least);
       ++k) {
    Eigen::VectorXd c(rows.rows()), s(rows.rows());
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      const double angle = 2 * pi * std::fmod(static_cast<double>(k) * static_cast<double>(i), count) / count;
      c(i) = 2 / count * std::cos(angle);
      s(i) = 2 / count * std::sin(angle);
    }
    cosines_.conservativeResize(Eigen::NoChange, k + 1);
    sines_.conservativeResize(Eigen::NoChange, k + 1);
    cosines_.col(k) = rows.transpose() * c;
    sines_.col(k) = rows.transpose() * s;
    const Eigen::ArrayXd power = cosines_.col(k).array().square() + sines_.col(k).array().square();
    const double over = (power * count / (4 * floor)).maxCoeff();
    falls = over > surely || (falls && over > hardly);
    if (falls) last = k;
  }
  harmonics_ = std::min(last + 1, known());
}

MeasuredState FourierSeries::at(double t, int harmonics) const {
  MeasuredState out{cosines_.col(0), Eigen::VectorXd::Zero(cosines_.rows()), Eigen::VectorXd::Zero(cosines_.rows())};
  for (int k = 1; k <= harmonics; ++k) {
    const double w = 2 * pi * frequency_ * k, c = std::cos(w * t), s = std::sin(w * t);
    const Eigen::VectorXd value = cosines_.col(k) * c + sines_.col(k) * s;
    out.value += value;
    out.rate += w * (sines_.col(k) * c - cosines_.col(k) * s);
    out.acceleration -= w * w * value;
  }
  return out;
}

}  // namespace ursula::identification

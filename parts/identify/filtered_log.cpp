#include "parts/identify/filtered_log.h"

#include <algorithm>
#include <cmath>

#include "base/scalar.h"

namespace ursula::identification {
namespace {

/// An open log may lose `end_share` of its rows at each end, where a kernel reaches `support` / cut-off. The efforts'
/// cut-off need not exceed `of_bandwidth` times the bandwidth, nor `beyond_end` times its end. No cut-off exceeds
/// `of_rate` of the rows' rate; a log is too slow if that is below `enough_of_bandwidth` times the bandwidth.
constexpr double end_share = 0.12, of_bandwidth = 4, beyond_end = 1.2, enough_of_bandwidth = 2.5, of_rate = 0.18,
                 support = 4.4;
/// The sharper low pass has this multiple of the motion's cut-off, and so shows what the motion's own low pass takes.
constexpr double sharper = 1.6, beyond = 1.7;  ///< little passes beyond this multiple of a cut-off
/// This many instants tell noise from the fit.
constexpr double wanted_instants = 100;
/// The motion's cut-off is this multiple of the efforts', so the motion keeps all that the efforts show.
constexpr double apart = 2.5;

/// Extends a period beyond its ends by the periods before and after it.
Eigen::MatrixXd carriedOn(const Eigen::MatrixXd& x, Eigen::Index by) {
  const Eigen::Index rows = x.rows();
  Eigen::MatrixXd out(rows + 2 * by, x.cols());
  for (Eigen::Index i = 0; i < out.rows(); ++i) out.row(i) = x.row(((i - by) % rows + rows) % rows);
  return out;
}

double gainOf(const Eigen::VectorXd& weights, double angle) {
  double out = 0;
  for (Eigen::Index j = 0; j < weights.size(); ++j)
    out += weights(j) * std::cos(angle * static_cast<double>(j - weights.size() / 2));
  return out;
}

double square(double x) { return x * x; }

void takeFrom(MeasuredState& state, const Eigen::RowVectorXd& noise) {
  const Eigen::Index channels = state.value.size();
  state.value -= noise.head(channels).transpose();
  state.rate -= noise.segment(channels, channels).transpose();
  state.acceleration -= noise.tail(channels).transpose();
}

/// Returns the number of harmonics of a period's series that stands for the sharper low pass.
int sharperHarmonics(const FilterPlan& plan) {
  return std::min(static_cast<int>(std::ceil(sharper * plan.series.harmonics())), plan.series.known());
}

}  // namespace

FilterPlan planFilters(const MeasuredLog& log, bool is_period, const SampleNoise& noise) {
  const double duration = log.step * static_cast<double>(log.rows()), most = of_rate / log.step;
  const Bandwidth bandwidth = motionBandwidth(log);
  FilterPlan out;
  out.is_period = is_period;
  out.noise = noise;
  out.bandwidth = bandwidth.most;
  const double shortest = is_period ? 0 : support / (end_share * duration),
               wanted = std::min(beyond_end * bandwidth.end, of_bandwidth * bandwidth.most);
  out.effort_cut = std::min(std::max({wanted, shortest, 0.5 * wanted_instants / duration}), most / apart);
  out.state_cut = apart * out.effort_cut;
  if (is_period) {
    out.series = FourierSeries(log.motion, log.step, noise.motion, bandwidth.most);
    out.state_cut = (out.series.harmonics() + 0.5) * out.series.frequency();
  }
  out.too_slow = most < enough_of_bandwidth * out.bandwidth;
  out.coarse = std::max<Eigen::Index>(
      1, static_cast<Eigen::Index>(std::min(0.125 / out.effort_cut, 0.3 / out.state_cut) / log.step));
  out.fine =
      std::max<Eigen::Index>(1, std::lround(0.5 / (out.effort_cut * log.step * static_cast<double>(out.coarse))));
  return out;
}

FilteredLog::FilteredLog(const MeasuredLog& log, const FilterPlan& plan, double reach)
    : log_(log),
      plan_(plan),
      first_(plan.state_cut, log.step),
      second_(plan.effort_cut, log.step * static_cast<double>(plan.coarse)),
      sharper_(std::min(sharper * plan.state_cut, of_rate / log.step), log.step) {
  if (plan.is_period) {
    before_ = first_.half + second_.half * plan.coarse + 1 + static_cast<Eigen::Index>(std::ceil(reach / log.step));
    log_.motion = carriedOn(log.motion, before_);
    log_.efforts = carriedOn(log.efforts, before_);
    if (log.load.cols() > 0) log_.load = carriedOn(log.load, before_);
    log_.missing.insert(log_.missing.begin(), before_, false);
    log_.missing.resize(log_.rows(), false);
  }
  placeCenters(reach);
  if (plan_.is_period) {
    for (Eigen::Index i = 0; i < size(); ++i)
      states_.push_back(plan_.series.at(time(i) - log_.start, plan_.series.harmonics()));
  } else {
    states_ = statesBy(first_, centers_);
  }
  if (log_.load.cols() > 0) load_ = Kernel::apply(first_.value, log_.load, centers_);
  taken_ = Eigen::MatrixXd::Zero(size(), 3 * log_.motion.cols());
  placeSettled();
}

void FilteredLog::takeOut(const Eigen::MatrixXd& noise) {
  for (Eigen::Index i = 0; i < size(); ++i) takeFrom(states_[i], noise.row(i) - taken_.row(i));
  taken_ = noise;
}

void FilteredLog::placeCenters(double reach) {
  const Eigen::Index rows = log_.rows(),
                     margin = first_.half + 1 + static_cast<Eigen::Index>(std::ceil(reach / log_.step));
  std::vector<Eigen::Index> lacking(rows + 1, 0);
  for (std::size_t i = 0; i < log_.missing.size(); ++i) lacking[i + 1] = lacking[i] + (log_.missing[i] ? 1 : 0);
  const auto whole = [&](Eigen::Index center) { return lacking[center + margin] == lacking[center - margin]; };
  const Eigen::Index all = (rows - 2 * margin) / plan_.coarse;
  const Eigen::Index parts = all > most_instants ? 16 : 1, length = std::min(all, most_instants) / parts;
  for (Eigen::Index part = 0; part < parts; ++part) {
    Eigen::Index last = -1;
    for (Eigen::Index k = 0; k < length; ++k) {
      const Eigen::Index center = margin + (part * (all / parts) + k) * plan_.coarse;
      if (!whole(center)) continue;
      if (last < 0 || center != last + plan_.coarse) segments_.push_back({size(), size()});
      centers_.push_back(center);
      segments_.back().end = size();
      last = center;
    }
  }
}

void FilteredLog::placeSettled() {
  for (const Segment& segment : segments_) {
    const auto begin = static_cast<Eigen::Index>(settled_.size());
    for (Eigen::Index i = segment.first + second_.half; i + second_.half < segment.end; i += plan_.fine)
      settled_.push_back(i);
    const auto end = static_cast<Eigen::Index>(settled_.size());
    if (end > begin) settled_segments_.push_back({begin, end});
  }
}

double FilteredLog::time(Eigen::Index i) const { return log_.time(static_cast<double>(centers_[i] - before_)); }

std::vector<MeasuredState> FilteredLog::statesBy(const Kernel& kernel, const std::vector<Eigen::Index>& rows) const {
  const Eigen::MatrixXd value = Kernel::apply(kernel.value, log_.motion, rows),
                        rate = Kernel::apply(kernel.rate, log_.motion, rows),
                        acceleration = Kernel::apply(kernel.acceleration, log_.motion, rows);
  std::vector<MeasuredState> out;
  for (Eigen::Index i = 0; i < value.rows(); ++i)
    out.push_back({value.row(i).transpose(), rate.row(i).transpose(), acceleration.row(i).transpose()});
  return out;
}

MeasuredState FilteredLog::sharperState(Eigen::Index i) const {
  MeasuredState out = plan_.is_period ? plan_.series.at(time(i) - log_.start, sharperHarmonics(plan_))
                                      : statesBy(sharper_, {centers_[i]}).front();
  takeFrom(out, taken_.row(i));
  return out;
}

Eigen::MatrixXd FilteredLog::sharperEfforts() const {
  if (plan_.is_period) return Eigen::MatrixXd::Zero(size(), motor_count);
  return Kernel::apply(sharper_.value, log_.efforts, centers_) - efforts(0);
}

Eigen::MatrixXd FilteredLog::efforts(double shift) const {
  return Kernel::apply(Kernel(plan_.state_cut, log_.step, shift).value, log_.efforts, centers_);
}

Eigen::MatrixXd FilteredLog::settledEfforts(double shift) const {
  if (!plan_.is_period) return lowPass(efforts(shift));
  std::vector<Eigen::Index> rows;
  for (const Eigen::Index i : settled_) rows.push_back(centers_[i]);
  return Kernel::apply(Kernel(plan_.effort_cut, log_.step, shift).value, log_.efforts, rows);
}

double FilteredLog::memory() const { return 2 * (first_.half * log_.step + second_.half * step()); }

Eigen::Matrix3d FilteredLog::Lines::covariance(double later) const {
  Eigen::Matrix3d out = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < omega.size(); ++k)
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        out(a, b) += weight[k] * std::pow(omega[k], a + b) * std::cos(omega[k] * later + (b - a) * 0.5 * pi);
  return out;
}

template <class Power>
FilteredLog::Lines FilteredLog::linesOf(double spacing, double end, const Power& power) const {
  Lines out;
  for (int k = 0; k * spacing < end; ++k) {
    const double omega = 2 * pi * k * spacing;
    out.omega.push_back(omega);
    out.weight.push_back((k == 0 ? 1 : 2) * log_.step * spacing * power(omega));
  }
  return out;
}

FilteredLog::Lines FilteredLog::effortLines() const {
  if (!plan_.is_period) return motionLines();
  const Kernel efforts(plan_.effort_cut, log_.step);
  return linesOf(0.5 / memory(), beyond * plan_.effort_cut,
                 [&](double omega) { return square(gainOf(efforts.value, omega * log_.step)); });
}

FilteredLog::Lines FilteredLog::motionLines(int second_passes) const {
  const double period = plan_.series.frequency();
  const auto second = [&](double omega) { return std::pow(gainOf(second_.value, omega * step()), second_passes); };
  if (plan_.is_period) return linesOf(period, plan_.state_cut, second);
  return linesOf(0.5 / memory(), beyond * plan_.state_cut,
                 [&](double omega) { return second(omega) * square(gainOf(first_.value, omega * log_.step)); });
}

FilteredLog::Lines FilteredLog::sharperLines() const {
  const double period = plan_.series.frequency();
  if (plan_.is_period)
    return linesOf(period, (sharperHarmonics(plan_) + 0.5) * period, [&](double omega) {
      return omega < 2 * pi * plan_.state_cut ? 0.0 : square(gainOf(second_.value, omega * step()));
    });
  return linesOf(0.5 / memory(), sharper * beyond * plan_.state_cut, [&](double omega) {
    return square(gainOf(second_.value, omega * step()) *
                  (gainOf(sharper_.value, omega * log_.step) - gainOf(first_.value, omega * log_.step)));
  });
}

Eigen::MatrixXd FilteredLog::lowPassBy(const Eigen::VectorXd& weights, const Eigen::MatrixXd& series) const {
  return Kernel::apply(weights, series, settled_);
}

}  // namespace ursula::identification

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "parts/identify/estimate.h"

namespace ursula::identification {
namespace {

/// So many instants are correlated with each other.
constexpr Eigen::Index longest_block = 160;
/// Least noise of efforts, as a share of them: what the ends of both low passes' windows leave out, 1.1e-8.
double leastNoise() { return 2 * Kernel::passError(); }

/// Adds a series with these lines to values, and its derivatives to rates and accelerations.
void addSeries(const FilteredLog::Lines& lines, const Eigen::VectorXd& t, double deviation, std::mt19937_64& dice,
               Eigen::Ref<Eigen::MatrixXd> value_rate_acceleration) {
  std::normal_distribution<double> normal(0, deviation);
  for (std::size_t k = 0; k < lines.omega.size(); ++k) {
    const double omega = lines.omega[k], size = std::sqrt(std::max(0.0, lines.weight[k]));
    const double a = size * normal(dice), b = size * normal(dice);
    const Eigen::ArrayXd c = (omega * t.array()).cos(), s = (omega * t.array()).sin();
    value_rate_acceleration.col(0).array() += a * c + b * s;
    if (value_rate_acceleration.cols() < 3) continue;
    value_rate_acceleration.col(1).array() += omega * (b * c - a * s);
    value_rate_acceleration.col(2).array() -= omega * omega * (a * c + b * s);
  }
}

}  // namespace

EffortNoise::EffortNoise(const FilteredLog& filtered, const Comparison& comparison) {
  const FilterPlan& plan = filtered.plan();
  const double spacing = filtered.step() * static_cast<double>(plan.fine);
  const FilteredLog::Lines efforts = filtered.effortLines(), motion = filtered.motionLines();
  memory_.resize(longest_block);
  for (Eigen::Index lag = 0; lag < longest_block; ++lag) {
    const double later = static_cast<double>(lag) * spacing;
    const bool is_near = later < filtered.memory();
    memory_(lag) = is_near ? efforts.covariance(later)(0, 0) : 0;
    by_motion_.push_back(is_near || plan.is_period ? motion.covariance(later)
                                                   : Eigen::Matrix3d(Eigen::Matrix3d::Zero()));
  }
  const double gain = memory_(0);
  memory_ /= gain;
  for (const Segment& segment : comparison.segments) {
    const Eigen::Index all = segment.end - segment.first, parts = (all + longest_block - 1) / longest_block;
    for (Eigen::Index part = 0; part < parts; ++part) {
      const Eigen::Index first = segment.first + all * part / parts, end = segment.first + all * (part + 1) / parts;
      blocks_.push_back({first, end - first, {}, {}});
      fill(blocks_.back(), comparison, plan.noise.motion);
    }
  }
  variances_ = Eigen::MatrixXd::Zero(comparison.model.rows(), motor_count);
  Vector6d samples;
  for (int k = 0; k < motor_count; ++k)
    samples(k) = plan.noise.efforts(k) * plan.noise.efforts(k) * gain +
                 leastNoise() * leastNoise() * comparison.model.col(k).cwiseAbs2().mean() + 1e-200;
  add(samples + comparison.numerical.cwiseAbs2());
}

/// Adds noise of the motion with these deviations of its channels.
void EffortNoise::fill(Block& block, const Comparison& comparison, const Eigen::VectorXd& motion) const {
  block.covariance = Eigen::MatrixXd::Zero(6 * block.count, 6 * block.count);
  const Eigen::Index channels = motion.size();
  for (Eigen::Index i = 0; i < block.count; ++i)
    for (Eigen::Index j = i; j < block.count; ++j) {
      const Eigen::Matrix3d& between = by_motion_[j - i];
      if (between.isZero(0)) continue;
      const Eigen::MatrixXd &here = comparison.slopes[block.first + i], &there = comparison.slopes[block.first + j];
      Matrix6d sum = Matrix6d::Zero();
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          sum += between(a, b) * here.middleCols(a * channels, channels) * motion.cwiseAbs2().asDiagonal() *
                 there.middleCols(b * channels, channels).transpose();
      block.covariance.block<6, 6>(6 * i, 6 * j) = sum;
      block.covariance.block<6, 6>(6 * j, 6 * i) = sum.transpose();
    }
}

void EffortNoise::add(const Vector6d& more) {
  for (Block& block : blocks_) {
    for (Eigen::Index i = 0; i < block.count; ++i)
      for (Eigen::Index j = 0; j < block.count; ++j)
        block.covariance.block<6, 6>(6 * i, 6 * j).diagonal() += more * memory_(std::abs(j - i));
    for (Eigen::Index i = 0; i < block.count; ++i)
      variances_.row(block.first + i) = block.covariance.diagonal().segment<6>(6 * i).transpose();
    block.factors.compute(block.covariance);
  }
}

Eigen::MatrixXd EffortNoise::whitened(const Eigen::MatrixXd& rows) const {
  Eigen::MatrixXd out = rows;
  for (const Block& block : blocks_)
    out.middleRows(6 * block.first, 6 * block.count) =
        block.factors.matrixL().solve(rows.middleRows(6 * block.first, 6 * block.count));
  return out;
}

Eigen::VectorXd EffortNoise::weighed(const Eigen::VectorXd& column) const {
  Eigen::VectorXd out = column;
  for (const Block& block : blocks_) block.factors.solveInPlace(out.segment(6 * block.first, 6 * block.count));
  return out;
}

Eigen::MatrixXd likelyNoiseOfMotion(const FilteredLog& filtered, const Comparison& comparison,
                                    const Eigen::VectorXd& weighed) {
  const Eigen::VectorXd variances = filtered.plan().noise.motion.cwiseAbs2().replicate(3, 1);
  const Eigen::Index channels = variances.size() / 3;
  const FilteredLog::Lines lines = filtered.motionLines(1);
  std::map<long, Eigen::Matrix3d> between;  // by steps later
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(filtered.size(), 3 * channels);
  Eigen::Index first = 0;
  for (std::size_t row = 0; row < comparison.kept.size(); ++row) {
    const double reach = filtered.plan().is_period ? 1e300 : filtered.memory(), t = comparison.t(row);
    const Eigen::VectorXd pull =
        -variances.cwiseProduct(comparison.slopes[row].transpose() * weighed.segment<6>(6 * row));
    while (t - filtered.time(first) > reach) ++first;
    for (Eigen::Index i = first; i < out.rows() && filtered.time(i) - t < reach; ++i) {
      const double later = t - filtered.time(i);
      const auto [at, is_new] = between.try_emplace(std::lround(later / filtered.step()));
      if (is_new) at->second = lines.covariance(later);
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          out.row(i).segment(a * channels, channels) +=
              at->second(a, b) * pull.segment(b * channels, channels).transpose();
    }
  }
  return out;
}

NoiseDraw drawNoise(const FilteredLog& filtered, const Comparison& comparison) {
  const SampleNoise& noise = filtered.plan().noise;
  const Eigen::Index channels = noise.motion.size(), all = filtered.size();
  Eigen::VectorXd t(all);
  for (Eigen::Index i = 0; i < all; ++i) t(i) = filtered.time(i);
  std::mt19937_64 dice(1);
  NoiseDraw out{Eigen::MatrixXd::Zero(all, 3 * channels), Eigen::VectorXd(6 * comparison.t.size())};
  for (Eigen::Index c = 0; c < channels; ++c) {
    Eigen::MatrixXd series = Eigen::MatrixXd::Zero(all, 3);
    addSeries(filtered.motionLines(0), t, noise.motion(c), dice, series);
    for (int a = 0; a < 3; ++a) out.motion.col(a * channels + c) = series.col(a);
  }
  Eigen::MatrixXd efforts = Eigen::MatrixXd::Zero(comparison.t.size(), motor_count);
  for (int k = 0; k < motor_count; ++k)
    addSeries(filtered.effortLines(), comparison.t, noise.efforts(k), dice, efforts.col(k));
  const Eigen::MatrixXd passed = filtered.lowPass(out.motion)(comparison.kept, Eigen::all);
  for (Eigen::Index i = 0; i < passed.rows(); ++i)
    out.efforts.segment<6>(6 * i) = efforts.row(i).transpose() - comparison.slopes[i] * passed.row(i).transpose();
  return out;
}

}  // namespace ursula::identification

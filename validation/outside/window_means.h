#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "model/instants.h"

namespace ursula {

using EffortList = std::vector<Eigen::VectorXd>;

/// Means over windows with the weight (1 − x²)³. It falls to zero smoothly, so that integrated by parts an acceleration
/// becomes a position.
class WindowMeans {
 public:
  WindowMeans(std::vector<double> t, double half) : t_(std::move(t)), half_(half) {}

  Eigen::VectorXd at(double centre, const EffortList& values) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(values.front().size());
    double weights = 0;
    const auto from = std::lower_bound(t_.begin(), t_.end(), centre - half_) - t_.begin();
    for (std::size_t k = from; k < t_.size() && t_[k] < centre + half_; ++k) {
      const double x = (t_[k] - centre) / half_, falling = 1 - x * x;
      const double between = (t_[std::min(k + 1, t_.size() - 1)] - t_[k > 0 ? k - 1 : 0]) / 2;
      const double weight = falling * falling * falling * between;
      sum += weight * values[k];
      weights += weight;
    }
    return sum / weights;
  }

  /// Centres whose windows are within the motion, away from its ends, where a spline is less exact; no more than rows.
  std::vector<double> centres(std::size_t rows) const {
    constexpr std::size_t most_centres = 301;
    const double first = t_.front() + 1.5 * half_, last = t_.back() - 1.5 * half_;
    std::vector<double> out = equallySpaced(last - first, static_cast<int>(std::min(most_centres, rows)));
    for (double& t : out) t += first;
    return out;
  }

 private:
  std::vector<double> t_;
  double half_;
};

}  // namespace ursula

#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/page/page_data.h"
#include "validation/verdict/result.h"

namespace ursula::report {

/// Writes x, y, z of all instants in order; a constant point is written once.
template <class Vectors>
nlohmann::ordered_json track(const Vectors& points) {
  const bool still = std::all_of(points.begin(), points.end(), [&](const auto& point) { return point == points[0]; });
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const auto& point : points) {
    for (Eigen::Index k = 0; k < point.size(); ++k) out.push_back(screenNumber(point(k)));
    if (still) break;
  }
  return out;
}

/// Columns of the time series at the picture's instants.
class AtInstants {
 public:
  AtInstants(const TimeSeries& series, const std::vector<double>& instants) : series_(series) {
    const std::vector<double>& t = *series.find("t_s");
    for (const double at : instants)
      rows_.push_back(static_cast<std::size_t>(std::lower_bound(t.begin(), t.end() - 1, at) - t.begin()));
  }

  /// Returns nothing if a column is missing.
  std::vector<Eigen::VectorXd> vectors(const std::vector<std::string>& columns) const {
    std::vector<Eigen::VectorXd> out(rows_.size(), Eigen::VectorXd(columns.size()));
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const std::vector<double>* values = series_.find(columns[k]);
      if (values == nullptr) return {};
      for (std::size_t i = 0; i < rows_.size(); ++i) out[i](static_cast<Eigen::Index>(k)) = (*values)[rows_[i]];
    }
    return out;
  }

 private:
  const TimeSeries& series_;
  std::vector<std::size_t> rows_;
};

}  // namespace ursula::report

#include "studies/sweep_report/sweep_outputs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ursula {
namespace {

constexpr std::size_t most_errors = 3;

bool isError(const WorstPoint& point) { return point.verdict == "error"; }

bool isWorse(const WorstPoint& a, const WorstPoint& b) {
  const auto failed = [](const WorstPoint& p) { return p.verdict == "fail"; };
  const auto score = [](const WorstPoint& p) {
    return std::isnan(p.score) ? -std::numeric_limits<double>::infinity() : p.score;
  };
  if (failed(a) != failed(b)) return failed(a);
  if (score(a) != score(b)) return score(a) > score(b);
  return a.id < b.id;
}

}  // namespace

bool WorstPoints::takes(const WorstPoint& point) const {
  if (!isError(point)) return others_.size() < most_worst || isWorse(point, others_.back());
  return errors_.size() < most_errors && std::none_of(errors_.begin(), errors_.end(), [&point](const WorstPoint& each) {
           return each.error == point.error;
         });
}

void WorstPoints::add(WorstPoint point) {
  if (!takes(point)) return;
  if (isError(point)) {
    errors_.push_back(std::move(point));
    return;
  }
  others_.insert(std::upper_bound(others_.begin(), others_.end(), point, isWorse), std::move(point));
  if (others_.size() > most_worst) others_.pop_back();
}

std::vector<WorstPoint> WorstPoints::worst() const {
  std::vector<WorstPoint> out = errors_;
  out.insert(out.end(), others_.begin(), others_.end());
  if (out.size() > most_worst) out.resize(most_worst);
  return out;
}

}  // namespace ursula

#include "validation/subject/asked_instants.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ursula {

std::vector<double> goldenInstants(double duration, int count) {
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  std::vector<double> out;
  out.reserve(count);
  for (int k = 1; k <= count; ++k) out.push_back(duration * std::fmod(k * ratio, 1.0));
  return out;
}

std::vector<double> curvedInstants(const std::vector<Answered>& in_order, std::size_t count) {
  std::vector<std::pair<double, double>> curved;  // second difference, middle
  for (std::size_t k = 1; k + 1 < in_order.size(); ++k) {
    const Answered &a = in_order[k - 1], &b = in_order[k], &c = in_order[k + 1];
    const double share = (b.t - a.t) / (c.t - a.t);
    const double bend =
        (b.torques - (1 - share) * a.torques - share * c.torques).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    curved.emplace_back(std::isnan(bend) ? std::numeric_limits<double>::infinity() : bend, (b.t + c.t) / 2);
  }
  count = std::min(count, curved.size());
  std::nth_element(curved.begin(), curved.begin() + static_cast<std::ptrdiff_t>(count), curved.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<double> out;
  for (std::size_t k = 0; k < count; ++k) out.push_back(curved[k].second);
  return out;
}

void sortByTime(std::vector<Answered>& answers) {
  std::stable_sort(answers.begin(), answers.end(), [](const Answered& a, const Answered& b) { return a.t < b.t; });
}

InterpolatedAnswers::InterpolatedAnswers(History right, std::vector<Answered> answers) : right_(std::move(right)) {
  sortByTime(answers);
  for (const Answered& answer : answers) {
    const Answered off{answer.t, answer.torques - right_(answer.t)};
    if (!off_.empty() && off_.back().t == off.t)
      off_.back() = off;
    else
      off_.push_back(off);
  }
}

Vector6d InterpolatedAnswers::operator()(double t) const {
  const auto after =
      std::upper_bound(off_.begin(), off_.end(), t, [](double at, const Answered& each) { return at < each.t; });
  if (off_.empty()) return right_(t);
  if (after == off_.begin()) return right_(t) + after->torques;
  const Answered& before = *std::prev(after);
  if (after == off_.end()) return right_(t) + before.torques;
  const double share = (t - before.t) / (after->t - before.t);
  return right_(t) + (1 - share) * before.torques + share * after->torques;
}

}  // namespace ursula

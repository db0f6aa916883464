#include "parts/causes/fits.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace ursula {
namespace {

using Rows = std::vector<Vector6d>;

constexpr std::size_t few_instants = 20, most_instants = 200;  // for the choice, for the fit
constexpr std::size_t likely_causes = 64, best_causes = 12;
constexpr double difference_step = 1e-5;
constexpr double least_cosine = 1e-6, rounding = 1e-16;
constexpr double may_be_rounding = 2;  ///< limits: one for the given torques, one for the cause's

/// One cause on some instants.
class Fit {
 public:
  Fit(const Cause& cause, const TorqueResidual& data) : cause_(cause), data_(data) {
    if (!cause.fitted) start(0);
  }

  /// The cosine between the residual and the cause's effect, of a small x or of a start; 0 if there is no effect. The
  /// likeliest start becomes x.
  double likeness() {
    if (!cause_.fitted) return explained();
    double best = 0, where = 0;
    for (const double each : cause_.starts) {
      start(each);
      const double like = each == 0 ? likenessOfSlope() : explained();
      if (like > best) best = like, where = each;
    }
    start(where);
    return best;
  }

  double likenessOfSlope() const {
    const Rows slope = slopeAtRight();
    const double size = norm(slope);
    if (!(size * difference_step > 1e-12 * norm(data_.exact))) return 0;
    return std::abs(dot(slope, data_.residual)) / (size * data_.norm());
  }

  /// Takes at most `steps` Gauss–Newton steps, which may be halved.
  void improve(int steps) {
    if (!cause_.fitted) return;
    for (int k = 0; k < steps && step(); ++k) {
    }
  }

  void start(double at) { start(at, remaining(at)); }

  double x() const { return x_; }
  double unexplained() const { return unexplained_; }
  double explained() const { return std::sqrt(1 - std::min(1.0, unexplained_ * unexplained_)); }

  Hypothesis hypothesis() {
    const double deviation = cause_.fitted ? uncertainty() : 0;
    Hypothesis out{cause_.words(x_, deviation), unexplained_, cause_.fitted ? 1 : 0};
    out.beyond = beyond(left_);
    if (cause_.named) out.named = cause_.named(x_, deviation);
    if (cause_.fitted)
      out.says = [words = cause_.words, x = x_, deviation](double wider) { return words(x, wider * deviation); };
    if (cause_.is_possible) out.is_possible = cause_.is_possible(x_);
    return out;
  }

 private:
  void start(double at, Rows left) {
    x_ = at;
    left_ = std::move(left);
    unexplained_ = norm(left_) / data_.norm();
  }

  /// The remainder in multiples of its limits, which are wider where the cause's torques round more.
  double beyond(const Rows& left) const {
    const double as_of_right_ones = data_.beyond(left) / data_.growth();
    if (!cause_.rounding) return as_of_right_ones;
    TorqueResidual wider = data_;
    for (std::size_t k = 0; k < left.size(); ++k)
      wider.limit[k] = wider.limit[k].cwiseMax(cause_.rounding(data_.motions[k]));
    return std::min(as_of_right_ones, wider.beyond(left));
  }

  /// Returns nullopt if the cause has no torques.
  std::optional<Rows> torquesAt(double at) const {
    return unlessRefused([&] { return cause_.torques(at, data_.motions); });
  }

  Rows remaining(double at) const {
    const std::optional<Rows> torques = torquesAt(at);
    Rows out(data_.exact.size(), Vector6d::Constant(HUGE_VAL));
    for (std::size_t k = 0; torques && k < out.size(); ++k) out[k] = data_.found(k) - (*torques)[k];
    return out;
  }

  /// The slope at 0 as a choice needs it: a forward difference, because the right efforts are known.
  Rows slopeAtRight() const {
    if (cause_.slope) return cause_.slope(data_.motions);
    const std::optional<Rows> above = torquesAt(difference_step);
    if (!above) return slopeAt(0);
    Rows out(data_.exact.size());
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = ((*above)[k] - data_.exact[k]) / difference_step;
    return out;
  }

  /// The exact slope at 0 if the cause knows it, otherwise central differences. They are one-sided if a parameter
  /// cannot decrease.
  Rows slopeAt(double at) const {
    if (at == 0 && cause_.slope) return cause_.slope(data_.motions);
    std::optional<Rows> above = torquesAt(at + difference_step), below = torquesAt(at - difference_step);
    const double width = above && below ? 2 * difference_step : difference_step;
    if (!above) above = torquesAt(at);
    if (!below) below = torquesAt(at);
    Rows out(data_.exact.size(), Vector6d::Zero());
    for (std::size_t k = 0; above && below && k < out.size(); ++k) out[k] = ((*above)[k] - (*below)[k]) / width;
    return out;
  }

  /// Takes one step; returns false if nothing improves any more. A step whose promise to first order is nothing, or
  /// below the rounding of the efforts, is not tried.
  bool step() {
    const Rows slope = slopeAt(x_);
    const double size = norm(slope), toward = dot(slope, left_) / size, left = norm(left_);
    if (!(std::abs(toward) > least_cosine * left) || !(std::abs(toward) > rounding * norm(data_.exact))) return false;
    double dx = toward / size;
    for (int halvings = 0; halvings < 8; ++halvings, dx /= 2) {
      Rows there = remaining(x_ + dx);
      if (!(norm(there) < left)) continue;
      start(x_ + dx, std::move(there));
      return std::abs(dx) > 1e-14;
    }
    return false;
  }

  /// Two standard deviations of x from the remainder, or from the file's precision (uniform within its limits) if that
  /// is larger. A remainder with a pattern is another error, of which x may have taken as large a part.
  double uncertainty() const {
    const Rows slope = slopeAt(x_);
    const double squares = dot(left_, left_);
    if (beyond(left_) > may_be_rounding && hasPattern(left_)) return 2 * std::sqrt(squares / dot(slope, slope));
    double precision = 0;
    for (const Vector6d& row : data_.limit) precision += row.squaredNorm() / 3;
    const double numbers = 6 * static_cast<double>(left_.size());
    const double variance = std::max(squares / std::max(1.0, numbers - 1), precision / numbers);
    return 2 * std::sqrt(variance / dot(slope, slope));
  }

  /// Whether successive remainders along the motion are alike.
  bool hasPattern(const Rows& left) const {
    double along = 0, all = 0;
    for (std::size_t k = 0; k + 1 < data_.commanded; ++k) {
      along += left[k].dot(left[k + 1]);
      all += left[k].squaredNorm();
    }
    return along > 0.3 * all;
  }

  const Cause& cause_;
  const TorqueResidual& data_;
  double x_ = 0, unexplained_ = 1;
  Rows left_;  ///< at x
};

struct Candidate {
  std::size_t place;  ///< index among the causes
  double merit, x;
};

/// Keeps the best by `merit`, in the order of the causes.
void keepBest(std::vector<Candidate>& candidates, std::size_t most) {
  if (candidates.size() > most) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.merit > b.merit; });
    candidates.resize(most);
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.place < b.place; });
}

}  // namespace

std::vector<Hypothesis> fitCauses(const std::vector<Cause>& causes, const TorqueResidual& data) {
  const TorqueResidual few = data.picked(few_instants), all = data.picked(most_instants);
  std::vector<Candidate> candidates;
  if (!(few.norm() > 0)) return {};
  for (std::size_t i = 0; i < causes.size(); ++i) {
    Fit fit(causes[i], few);
    const double likeness = fit.likeness();
    if (likeness > 0.2) candidates.push_back({i, likeness, fit.x()});
  }
  keepBest(candidates, likely_causes);
  for (Candidate& candidate : candidates) {
    Fit fit(causes[candidate.place], few);
    fit.start(candidate.x);
    fit.improve(8);
    candidate = {candidate.place, -fit.unexplained(), fit.x()};
  }
  keepBest(candidates, best_causes);
  std::vector<Hypothesis> out;
  for (const Candidate& candidate : candidates) {
    Fit fit(causes[candidate.place], all);
    fit.start(candidate.x);
    fit.improve(3);
    Fit whole(causes[candidate.place], data);  // a claim must hold at every instant
    whole.start(fit.x());
    if (std::isfinite(whole.unexplained())) out.push_back(whole.hypothesis());
  }
  return out;
}

}  // namespace ursula

#include "validation/causes/fits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/subject/subject.h"

namespace ursula {
namespace {

/// Torques of another time, τ(t + dt), within the motion.
class Shift {
 public:
  Shift(const Scenario& scenario, const TorqueResidual& data)
      : trajectory_(*scenario.trajectory), noc_(nocSubject(*scenario.manipulator, scenario.load)), data_(data) {}

  struct Fit {
    double unexplained = 1, slope = 0, beyond = 0;
    bool covers = false;  ///< covers most of the samples
  };

  /// `slope` is the Gauss–Newton step of dt, s.
  Fit at(double dt) const {
    const double duration = trajectory_.duration(), step = 1e-6 * duration;
    double left = 0, all = 0, along = 0, rate = 0, beyond = 0;
    std::size_t used = 0;
    for (std::size_t k = 0; k < data_.exact.size(); ++k) {
      const double t = data_.motions[k].t + dt;
      if (!(t - step >= 0 && t + step <= duration)) continue;
      const Vector6d found = data_.found(k), shifted = torques(t);
      const Vector6d slope = (torques(t + step) - torques(t - step)) / (2 * step);
      left += (found - shifted).squaredNorm();
      beyond = std::max(beyond, (found - shifted).cwiseAbs().cwiseQuotient(data_.limit[k]).maxCoeff());
      all += data_.residual[k].squaredNorm();
      along += slope.dot(found - shifted);
      rate += slope.squaredNorm();
      ++used;
    }
    Fit fit;
    fit.covers = 4 * used >= 3 * data_.exact.size() && used >= 2 && all > 0 && rate > 0;
    if (fit.covers) fit = {std::sqrt(left / all), along / rate, beyond, true};
    return fit;
  }

 private:
  Vector6d torques(double t) const { return noc_.torques(trajectory_.at(t)); }

  const Trajectory& trajectory_;
  Subject noc_;
  const TorqueResidual& data_;
};

/// ", 2 samples" if the shift is a whole number of them.
std::string inSamples(const TorqueResidual& data, double shift) {
  const std::size_t rows = data.motions.size();
  const double step = (data.motions.back().t - data.motions.front().t) / static_cast<double>(rows - 1);
  const double samples = std::round(shift / step);
  if (samples < 1 || std::abs(shift / step - samples) > 1e-3) return "";
  return fmt::format(", {} sample{}", samples, samples > 1 ? "s" : "");
}

}  // namespace

std::optional<Hypothesis> timeShift(const Scenario& scenario, const TorqueResidual& data) {
  const double duration = scenario.trajectory->duration();
  const Shift shift(scenario, data);
  double best = 0, least = 1e300;
  for (int k = -20; k <= 20; ++k) {  // the steps below then start near the right shift
    const double dt = k * 0.01 * duration;
    const Shift::Fit fit = shift.at(dt);
    if (fit.covers && fit.unexplained < least) best = dt, least = fit.unexplained;
  }
  for (int k = 0; k < 8; ++k) {
    const Shift::Fit fit = shift.at(best);
    if (!fit.covers) return std::nullopt;
    best += fit.slope;
  }
  const Shift::Fit fit = shift.at(best);
  if (!fit.covers) return std::nullopt;
  Hypothesis out{fmt::format("a time shift: the torques of {:.6g} ms {}{}", 1000 * std::abs(best),
                             best < 0 ? "before (late)" : "after (early)", inSamples(data, std::abs(best))),
                 fit.unexplained, 1};
  out.beyond = fit.beyond;
  out.named = NamedCause{CauseKind::delay, "", "all", "", "s", 0, -best};
  return out;
}

}  // namespace ursula

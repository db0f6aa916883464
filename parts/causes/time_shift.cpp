#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "parts/causes/fits.h"
#include "parts/causes/tried_causes.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

/// Torques of another time, τ(t + dt), within the motion.
struct Shift {
  double unexplained, step;  ///< `step` is the Gauss–Newton step of dt, s
  double beyond;
};

/// Returns nullopt unless it covers most of the samples.
std::optional<Shift> shiftBy(double dt, const Trajectory& trajectory, const Subject& noc, const TorqueResidual& data) {
  const double duration = trajectory.duration(), step = 1e-6 * duration;
  const auto torques = [&](double t) { return noc.torques(trajectory.at(t)); };
  double left = 0, all = 0, along = 0, rate = 0, beyond = 0;
  std::size_t used = 0;
  for (std::size_t k = 0; k < data.exact.size(); ++k) {
    const double t = data.motions[k].t + dt;
    if (!(t - step >= 0 && t + step <= duration)) continue;
    const Vector6d off = data.found(k) - torques(t);
    const Vector6d slope = (torques(t + step) - torques(t - step)) / (2 * step);
    left += off.squaredNorm();
    beyond = std::max(beyond, off.cwiseAbs().cwiseQuotient(data.limit[k]).maxCoeff());
    all += data.residual[k].squaredNorm();
    along += slope.dot(off);
    rate += slope.squaredNorm();
    ++used;
  }
  const bool covers = 4 * used >= 3 * data.exact.size() && used >= 2 && all > 0 && rate > 0;
  if (!covers) return std::nullopt;
  return Shift{std::sqrt(left / all), along / rate, beyond};
}

/// ", 2 samples" if the shift is a whole number of them.
std::string inSamples(const TorqueResidual& data, double shift) {
  const std::size_t rows = data.motions.size();
  const double step = (data.motions.back().t - data.motions.front().t) / static_cast<double>(rows - 1);
  const double samples = std::round(shift / step);
  if (samples < 1 || std::abs(shift / step - samples) > 1e-3) return "";
  return fmt::format(", {} sample{}", samples, samples > 1 ? "s" : "");
}

}  // namespace

void addDelay(TriedCauses& out) {
  Cause cause;
  cause.reading = [&path = *out.scenario.trajectory](Motion<double>& motion, double x) {
    const double t = motion.t - x;
    if (!(t >= 0 && t <= path.duration())) throw std::invalid_argument("the motion has no such instant");
    motion = path.at(t);
  };
  cause.solver = [read = cause.reading](const Scenario& of, double x) {
    return [noc = nocSubject(*of.manipulator, of.load), read, x](Motion<double> motion) {
      read(motion, x);
      return noc.torques(motion);
    };
  };
  cause.named = [](double x, double) { return NamedCause{CauseKind::delay, "", "all", "", "s", 0, x}; };
  out.push(cause);
}

std::optional<Hypothesis> timeShift(const Scenario& scenario, const TorqueResidual& data) {
  const Subject noc = nocSubject(*scenario.manipulator, scenario.load);
  const auto at = [&](double dt) { return shiftBy(dt, *scenario.trajectory, noc, data); };
  double best = 0, least = 1e300;
  for (int k = -20; k <= 20; ++k) {  // the steps below then start near the right shift
    const double dt = k * 0.01 * scenario.trajectory->duration();
    const std::optional<Shift> shift = at(dt);
    if (shift && shift->unexplained < least) best = dt, least = shift->unexplained;
  }
  std::optional<Shift> shift = at(best);
  for (int k = 0; shift && k < 8; ++k) {
    best += shift->step;
    shift = at(best);
  }
  if (!shift) return std::nullopt;
  Hypothesis out{fmt::format("a time shift: the torques of {:.6g} ms {}{}", 1000 * std::abs(best),
                             best < 0 ? "before (late)" : "after (early)", inSamples(data, std::abs(best))),
                 shift->unexplained, 1};
  out.beyond = shift->beyond;
  out.named = NamedCause{CauseKind::delay, "", "all", "", "s", 0, -best};
  return out;
}

}  // namespace ursula

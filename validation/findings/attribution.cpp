#include "validation/findings/attribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <stdexcept>

#include "base/deadline.h"
#include "base/start_threads.h"

namespace ursula {
namespace {

/// Additional changes of frame; each costs a whole replay.
constexpr unsigned frame_changes = 3;

/// The window whose replay reached its end with the largest error.
const WindowedReplay* worstWindow(const std::vector<WindowedReplay>& windows) {
  const WindowedReplay* worst = nullptr;
  double largest = -1;
  for (const WindowedReplay& each : windows) {
    if (each.replay.steps.size() < 2) continue;
    const double error = each.replay.steps.back().position_error.norm();
    if (error > largest) worst = &each, largest = error;
  }
  return worst;
}

Vector3d endOf(const Replay& replay) {
  return replay.steps.empty() ? Vector3d::Constant(std::nan("")) : replay.steps.back().position_error;
}

/// Number of plotted instants in a window.
constexpr int drawn = 60;

std::vector<double> drawnInstants(const WindowedReplay& window) {
  const double start = window.window.start(), end = window.replay.steps.back().t;
  std::vector<double> out;
  for (int k = 0; k <= drawn; ++k) out.push_back(k == drawn ? end : start + (end - start) * k / drawn);
  return out;
}

/// Errors of P at the end of a replay and at the plotted instants; in m and B.
struct Track {
  Vector3d end;
  std::vector<Vector3d> along;

  Track(const Replay& replay, const std::vector<double>& instants, const FrameChange& from = {}) {
    const auto back = [&from](const Vector3d& error) -> Vector3d {
      return from.turn.transpose() * error * from.units.length;
    };
    end = back(endOf(replay));
    for (const double t : instants) {
      const double there = t / from.units.time;
      const bool reached = !replay.steps.empty() && there <= replay.steps.back().t * (1 + 1e-12);
      along.push_back(reached ? back(interpolated(replay, there).position_error)
                              : Vector3d::Constant(std::nan("")).eval());
    }
  }
};

/// The window's replay in `frame_change`, with the gaps projected away.
Track projected(const Scenario& scenario, const ReplayPlan& plan, const WindowedReplay& window,
                const FrameChange& frame_change, std::mutex& asking) {
  const Scenario there = frame_change.of(scenario);
  const Units& units = frame_change.units;
  ReplaySettings settings = settingsOf(scenario, plan, window.window, 1);
  settings.start /= units.time;
  settings.end = window.replay.steps.back().t / units.time;
  settings.project = true;
  const SimbodyLoop::TorqueHistory torques = [&](double t) {
    const std::lock_guard<std::mutex> one_at_a_time(asking);  // the subject may not allow concurrent calls
    return frame_change.of(plan.torques(t * units.time));
  };
  if (plan.foresee)
    settings.foresee = [&](std::vector<double> instants) {
      const std::lock_guard<std::mutex> one_at_a_time(asking);
      for (double& t : instants) t *= units.time;
      plan.foresee(instants);
    };
  return Track(replay(there, torques, settings), drawnInstants(window), frame_change);
}

/// The torques' errors at the samples as accelerations of the platform, [p̈; L ω̇], linear between the samples.
class Residual {
 public:
  explicit Residual(const std::vector<PointwiseSample>& samples) : samples_(samples) {}

  Vector6d operator()(double t) const {
    const auto after = std::lower_bound(samples_.begin(), samples_.end(), t,
                                        [](const PointwiseSample& each, double x) { return each.motion.t < x; });
    if (after == samples_.begin()) return of(*after);
    if (after == samples_.end()) return of(samples_.back());
    const PointwiseSample &a = *(after - 1), &b = *after;
    const double s = (t - a.motion.t) / (b.motion.t - a.motion.t);
    return (1 - s) * of(a) + s * of(b);
  }

 private:
  static Vector6d of(const PointwiseSample& sample) {
    Vector6d out;
    out << sample.acceleration_error.tail<3>(), sample.conditioning.length * sample.acceleration_error.head<3>();
    return out;
  }
  const std::vector<PointwiseSample>& samples_;
};

void addModel(const std::vector<PointwiseSample>& samples, const WindowedReplay& window,
              const Amplification& amplification, ErrorBudget& budget) {
  const Residual residual(samples);
  const double end = window.replay.steps.back().t;
  const double length = amplification.length();
  budget.model.error = amplification.carried(window.window.start(), end, residual).head<3>();
  // The rounding of each residual in the worst direction, and the effects that are nonlinear in the error.
  budget.model_rounding = amplification.carriedBound(
      window.window.start(), end, [&samples](double t) { return SampledLimit(samples)(t) / rounding_safety; });
  const double size = budget.model.error.norm();
  budget.model.uncertainty = budget.model_rounding + size * std::min(1.0, 100 * size / length);
}

/// err(100 tolerance) − err(tolerance), divided by 99 if the error is proportional to the tolerance, as step control
/// achieves. If it follows the square root, the divisor is 9.
ErrorShare integrationShare(const Vector3d& fine, const Vector3d& coarse) {
  const Vector3d change = coarse - fine;
  return {change / (coarser - 1), change.norm() / (std::sqrt(coarser) - 1)};
}

Track coarse(const Scenario& scenario, const ReplayPlan& plan, const WindowedReplay& window) {
  ReplaySettings settings = settingsOf(scenario, plan, window.window, coarser);
  settings.end = window.replay.steps.back().t;
  settings.project = true;
  return Track(replay(scenario, plan.torques, settings), drawnInstants(window));
}

/// The replays behind the contributions: the judged one, the projected ones (as judged, then in other changes of
/// frame), and one with a coarser tolerance.
struct Tracks {
  Track judged, plain;
  std::vector<Track> turned;
  Track coarse;
};

std::vector<ErrorsAt> sharesAlong(const Tracks& tracks, const std::vector<PointwiseSample>& samples,
                                  const WindowedReplay& window, const Amplification& amplification) {
  const std::vector<double> instants = drawnInstants(window);
  const Residual residual(samples);
  const double scale = positionScale(samples);
  std::vector<ErrorsAt> out;
  for (std::size_t k = 0; k < instants.size(); ++k) {
    const Vector3d observed = tracks.judged.along[k], plain = tracks.plain.along[k];
    Vector3d mean = Vector3d::Zero();
    for (const Track& each : tracks.turned) mean += each.along[k] / frame_changes;
    const Vector3d integration = integrationShare(plain, tracks.coarse.along[k]).error;
    const Vector3d model = amplification.carried(window.window.start(), instants[k], residual).head<3>();
    out.push_back({instants[k], observed.norm(), (plain - mean).norm(), integration.norm(), (observed - plain).norm(),
                   model.norm(), (mean - integration - model).norm(), replayLimit(window, scale, instants[k])});
  }
  return out;
}

ErrorSource dominantOf(const ErrorBudget& budget) {
  // If torques are right to rounding, their residuals are rounding too, and no model error.
  const double model = budget.model.error.norm();
  const std::pair<ErrorSource, double> shares[] = {{ErrorSource::model, model > budget.model_rounding ? model : 0},
                                                   {ErrorSource::integration, budget.integration.error.norm()},
                                                   {ErrorSource::rounding, budget.rounding.error.norm()},
                                                   {ErrorSource::closure, budget.closure.error.norm()},
                                                   {ErrorSource::unexplained, budget.unexplained().norm()}};
  return std::max_element(std::begin(shares), std::end(shares),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

}  // namespace

Vector3d ErrorBudget::unexplained() const {
  return observed - model.error - integration.error - rounding.error - closure.error;
}

double ErrorBudget::uncertainty() const {
  return model.uncertainty + integration.uncertainty + rounding.uncertainty + closure.uncertainty;
}

ErrorBudget attribute(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                      const std::vector<WindowedReplay>& windows, const Amplification& amplification,
                      const ReplayPlan& plan) {
  ErrorBudget budget;
  const WindowedReplay* window = worstWindow(windows);
  if (window == nullptr) return budget;
  budget.measured = true;
  budget.t = window->replay.steps.back().t;
  budget.observed = endOf(window->replay);
  budget.amplification = window->window.from_start.back();

  std::vector<FrameChange> from = {FrameChange(*scenario.manipulator)};
  for (unsigned k = 0; k < frame_changes; ++k)
    from.push_back(randomFrameChange(k + 101, amplification.length(), *scenario.manipulator));
  std::mutex asking;
  std::vector<std::optional<Track>> seen(from.size());
  inParallel(static_cast<int>(from.size()), static_cast<int>(from.size()), [&](int k) {
    const auto index = static_cast<std::size_t>(k);
    seen[index] = projected(scenario, plan, *window, from[index], asking);
  });
  std::vector<Track> turned;
  for (unsigned k = 1; k <= frame_changes; ++k) turned.push_back(*seen[k]);
  const Tracks tracks{Track(window->replay, drawnInstants(*window)), *seen[0], turned, coarse(scenario, plan, *window)};
  Vector3d mean = Vector3d::Zero();
  for (const Track& each : tracks.turned) mean += each.end / frame_changes;
  double spread = 0;
  for (const auto& each : seen) spread = std::max(spread, (each->end - mean).norm());
  budget.closure.error = budget.observed - tracks.plain.end;
  budget.rounding = {tracks.plain.end - mean,
                     spread};  // the uncertainty covers the mean and the judged replay relative to it
  budget.closure.uncertainty = spread;
  budget.integration = integrationShare(tracks.plain.end, tracks.coarse.end);
  budget.along = sharesAlong(tracks, samples, *window, amplification);
  addModel(samples, *window, amplification, budget);
  budget.dominant = dominantOf(budget);
  return budget;
}

ErrorBudget attributeInTime(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                            const std::vector<WindowedReplay>& windows, const Amplification* amplification,
                            const ReplayPlan& plan) {
  if (windows.empty() || amplification == nullptr) return {};
  try {
    return attribute(scenario, samples, windows, *amplification, plan);
  } catch (const OutOfTime&) {
    return {};
  }
}

}  // namespace ursula

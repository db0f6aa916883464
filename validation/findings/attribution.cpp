#include "validation/findings/attribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <stdexcept>

#include "base/deadline.h"
#include "base/start_threads.h"
#include "validation/limits/moved_inputs.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

/// Changes of the machine's numbers by one rounding; each costs a whole replay.
constexpr unsigned moves = 3;

/// The window whose replay reached its end with the largest error.
const WindowedReplay* worstWindow(const std::vector<WindowedReplay>& windows) {
  const WindowedReplay* worst = nullptr;
  double largest = -1;
  for (const WindowedReplay& each : windows) {
    if (each.replay.steps.size() < 2) continue;
    const double error = each.replay.steps.back().position_error.norm();
    if (exceeds(error, largest)) worst = &each, largest = error;
  }
  return worst;
}

/// Number of plotted instants in a window.
constexpr int drawn = 60;

std::vector<double> drawnInstants(const WindowedReplay& window) {
  const double start = window.window.start(), end = window.replay.steps.back().t;
  std::vector<double> out;
  for (int k = 0; k <= drawn; ++k) out.push_back(k == drawn ? end : start + (end - start) * k / drawn);
  return out;
}

/// Errors of P at the plotted instants, and at last at a replay's own end; in m and B.
using Track = std::vector<Vector3d>;

Track trackOf(const Replay& replay, const std::vector<double>& instants) {
  const Vector3d none = Vector3d::Constant(std::nan(""));
  Track out;
  for (const double t : instants) {
    const bool reached = !replay.steps.empty() && t <= replay.steps.back().t * (1 + 1e-12);
    out.push_back(reached ? interpolated(replay, t).position_error : none);
  }
  out.push_back(replay.steps.empty() ? none : replay.steps.back().position_error);
  return out;
}

/// The window's replay with the gaps projected away.
Track projected(const Scenario& scenario, const ReplayPlan& plan, const WindowedReplay& window, std::mutex& asking) {
  ReplaySettings settings = settingsOf(scenario, plan, window.window, 1);
  settings.end = window.replay.steps.back().t;
  settings.project = true;
  const SimbodyLoop::TorqueHistory torques = [&](double t) {
    const std::lock_guard<std::mutex> one_at_a_time(asking);  // the subject may not allow concurrent calls
    return plan.torques(t);
  };
  if (plan.foresee)
    settings.foresee = [&](const std::vector<double>& instants) {
      const std::lock_guard<std::mutex> one_at_a_time(asking);
      plan.foresee(instants);
    };
  return trackOf(replay(scenario, torques, settings), drawnInstants(window));
}

/// The torques' errors at the samples as accelerations of the platform, [p̈; L ω̇], linear between the samples.
class Residual {
 public:
  explicit Residual(const std::vector<PointwiseSample>& samples) : samples_(samples) {}

  Vector6d operator()(double t) const {
    const std::size_t after = indexFrom(samples_, t);
    if (after == 0 || samples_[after].motion.t < t) return of(samples_[after]);
    const PointwiseSample &a = samples_[after - 1], &b = samples_[after];
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
  const double length = amplification.length();
  // The rounding of each residual in the worst direction, and the effects that are nonlinear in the error.
  budget.model_rounding = amplification.carriedBound(
      window.window.start(), budget.t, [&samples](double t) { return SampledLimit(samples)(t) / rounding_safety; });
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
  return trackOf(replay(scenario, plan.torques, settings), drawnInstants(window));
}

/// The replays behind the contributions: the judged one, the projected ones (as judged, then with changed inputs), and
/// one with a coarser tolerance.
struct Tracks {
  Track judged;
  std::vector<Track> projected;
  Track coarse;

  /// Over the changes of the inputs.
  Vector3d mean(std::size_t k) const {
    Vector3d out = Vector3d::Zero();
    for (std::size_t i = 1; i < projected.size(); ++i) out += projected[i][k] / moves;
    return out;
  }

  /// The contributions at entry k, where the residuals carry `model`.
  ErrorBudget at(std::size_t k, const Vector3d& model) const {
    const Vector3d &plain = projected.front()[k], middle = mean(k);
    double spread = 0;
    for (const Track& each : projected) spread = std::max(spread, (each[k] - middle).norm());
    ErrorBudget out;
    out.observed = judged[k];
    out.model.error = model;
    out.integration = integrationShare(plain, coarse[k]);
    out.rounding = {plain - middle, spread};  // the uncertainty covers the mean and the judged replay relative to it
    out.closure = {judged[k] - plain, spread};
    return out;
  }
};

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

/// `at(k, t)` gives the contributions at entry k.
template <class F>
std::array<std::vector<double>, 8> curveOf(const Tracks& tracks, const std::vector<double>& instants, F&& at,
                                           const WindowedReplay& window, double scale) {
  std::array<std::vector<double>, 8> out;
  for (std::size_t k = 0; k < instants.size(); ++k) {
    const ErrorBudget there = at(k, instants[k]);
    const Vector3d sizes[] = {there.observed,          there.rounding.error,
                              there.integration.error, there.closure.error,
                              there.model.error,       tracks.mean(k) - there.integration.error - there.model.error};
    out.front().push_back(there.t);
    for (std::size_t i = 0; i < std::size(sizes); ++i) out[1 + i].push_back(sizes[i].norm());
    out.back().push_back(replayLimit(window, scale, there.t));
  }
  return out;
}

ErrorBudget attributed(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                       const WindowedReplay& window, const Amplification& amplification, const ReplayPlan& plan,
                       int threads) {
  std::mutex asking;
  std::vector<Track> seen(1 + moves);
  inParallel(threads, 1 + static_cast<int>(moves), [&](int k) {
    const auto seed = static_cast<unsigned>(k);
    seen[seed] = projected(k == 0 ? scenario : moved(scenario, seed), plan, window, asking);
  });
  const std::vector<double> instants = drawnInstants(window);
  const Tracks tracks{trackOf(window.replay, instants), seen, coarse(scenario, plan, window)};
  const Residual residual(samples);
  const auto at = [&](std::size_t k, double t) {
    ErrorBudget out = tracks.at(k, amplification.carried(window.window.start(), t, residual).head<3>());
    out.t = t;
    if (out.integration.error.isZero(0))  // equal replays say nothing
      out.integration.uncertainty = measuredError(window, t, &IntegrationError::At::position);
    return out;
  };
  ErrorBudget budget = at(instants.size(), instants.back());
  budget.measured = true;
  budget.amplification = window.window.from_start.back();
  budget.along = curveOf(tracks, instants, at, window, positionScale(samples));
  addModel(samples, window, amplification, budget);
  budget.dominant = dominantOf(budget);
  return budget;
}

}  // namespace

Vector3d ErrorBudget::unexplained() const {
  return observed - model.error - integration.error - rounding.error - closure.error;
}

double ErrorBudget::uncertainty() const {
  return model.uncertainty + integration.uncertainty + rounding.uncertainty + closure.uncertainty;
}

ErrorBudget attribute(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                      const std::vector<WindowedReplay>& windows, const Amplification* amplification,
                      const ReplayPlan& plan, int threads) {
  const WindowedReplay* window = worstWindow(windows);
  if (window == nullptr || amplification == nullptr) return {};
  try {
    return attributed(scenario, samples, *window, *amplification, plan, threads);
  } catch (const OutOfTime&) {
    return {};
  }
}

}  // namespace ursula

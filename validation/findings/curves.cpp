#include "validation/findings/findings.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "validation/replay/windows.h"

namespace ursula {
namespace {

TimeSeries curve(const std::vector<std::pair<std::string, std::vector<double>>>& columns) {
  TimeSeries series;
  for (const auto& [name, values] : columns) series.add(name, values);
  return series;
}

bool reachesEnd(const WindowedReplay& window) {
  return window.window.end() - window.replay.steps.back().t <= 1e-12 * window.window.end();
}

TimeSeries replayAndLimit(const std::vector<WindowedReplay>& windows, double position_scale) {
  std::vector<double> t, error, limit;
  for (const WindowedReplay& window : windows)
    for (const ReplayStep& step : window.replay.steps) {
      t.push_back(step.t);
      error.push_back(step.position_error.norm());
      limit.push_back(replayLimit(window, position_scale, step.t));
      if (&step != &window.replay.steps.back() || reachesEnd(window)) continue;
      t.push_back(window.window.end());  // nothing was computed after this
      error.push_back(std::nan(""));
      limit.push_back(std::nan(""));
    }
  return curve({{"t_s", t}, {"position error (m)", error}, {"derived limit (m)", limit}});
}

TimeSeries growth(const std::vector<WindowedReplay>& windows) {
  std::vector<double> t, from_state, from_velocity;
  for (const WindowedReplay& window : windows) {
    t.insert(t.end(), window.window.t.begin(), window.window.t.end());
    from_state.insert(from_state.end(), window.window.from_start.begin(), window.window.from_start.end());
    from_velocity.insert(from_velocity.end(), window.window.growth.begin(), window.window.growth.end());
  }
  return curve({{"t_s", t}, {"of the state (1)", from_state}, {"of the velocity (s)", from_velocity}});
}

TimeSeries distances(const std::vector<PointwiseSample>& samples) {
  std::vector<double> t, singular, edge;
  for (const PointwiseSample& sample : samples) {
    t.push_back(sample.motion.t);
    singular.push_back(1 / sample.conditioning.kappa_B);
    edge.push_back(sample.conditioning.smallest_sine);
  }
  // Telescopic legs have no bend, so their sine is always 1.
  const bool bends = std::any_of(edge.begin(), edge.end(), [](double sine) { return sine < 1; });
  if (!bends) return curve({{"t_s", t}, {"1/κ(B): 0 in a singular pose", singular}});
  return curve({{"t_s", t},
                {"1/κ(B): 0 in a singular pose", singular},
                {"sine of the bend: 0 in a stretched or folded leg", edge}});
}

void addEvents(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
               ValidationResult& result) {
  for (const WindowedReplay& window : windows) {
    if (&window != &windows.front()) result.events.push_back({window.window.start(), "the replay starts again"});
    const Replay& replay = window.replay;
    if (!replay.gave_up.empty()) result.events.push_back({replay.stopped_at, "the replay stopped"});
    if (replay.left_path) result.events.push_back({replay.steps.back().t, "the replay left the path"});
  }
  if (samples.empty()) return;
  const auto singular = std::max_element(samples.begin(), samples.end(), [](const auto& a, const auto& b) {
    return a.conditioning.kappa_B < b.conditioning.kappa_B;
  });
  const auto edge = std::min_element(samples.begin(), samples.end(), [](const auto& a, const auto& b) {
    return a.conditioning.smallest_sine < b.conditioning.smallest_sine;
  });
  result.events.push_back({singular->motion.t, "nearest to a singular pose"});
  if (edge->conditioning.smallest_sine < 1)
    result.events.push_back({edge->motion.t, "a leg is nearest to stretched or folded"});
}

}  // namespace

void addCurves(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
               ValidationResult& result) {
  addEvents(samples, windows, result);
  if (!windows.empty()) {
    result.curves.emplace_back("Replay against its derived limit", replayAndLimit(windows, positionScale(samples)));
    result.curves.emplace_back("Growth of a deviation at the start of its window", growth(windows));
  }
  result.curves.emplace_back("Distance to singular poses and to the workspace's edge", distances(samples));
}

TimeSeries workPrecision(const Ladder& ladder) {
  TimeSeries series;
  std::vector<double> evaluations, distances;
  for (const Rung& rung : ladder.rungs) {
    evaluations.push_back(static_cast<double>(rung.evaluations));
    distances.push_back(rung.distance);
  }
  series.add("evaluations", std::move(evaluations));
  series.add("rkf78_error_m", std::move(distances));
  return series;
}

}  // namespace ursula

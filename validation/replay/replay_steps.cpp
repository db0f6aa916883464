// Finds errors at a replay's steps and between them.

#include <algorithm>
#include <cmath>

#include "validation/replay/replay.h"

namespace ursula {

ReplayStep interpolated(const Replay& replay, double t) {
  const std::vector<ReplayStep>& steps = replay.steps;
  const auto after =
      std::lower_bound(steps.begin(), steps.end(), t, [](const ReplayStep& step, double at) { return step.t < at; });
  if (after == steps.begin()) return steps.front();
  if (after == steps.end()) return steps.back();
  const ReplayStep &a = *(after - 1), &b = *after;
  const double h = b.t - a.t, s = (t - a.t) / h;
  const auto hermite = [h, s](const Vector3d& y0, const Vector3d& r0, const Vector3d& y1, const Vector3d& r1) {
    return Vector3d((1 + 2 * s) * (1 - s) * (1 - s) * y0 + s * (1 - s) * (1 - s) * h * r0 + s * s * (3 - 2 * s) * y1 -
                    s * s * (1 - s) * h * r1);
  };
  const auto linear = [s](double y0, double y1) { return (1 - s) * y0 + s * y1; };
  ReplayStep out;
  out.t = t;
  out.position_error = hermite(a.position_error, a.velocity_error, b.position_error, b.velocity_error);
  out.rotation_error = hermite(a.rotation_error, a.spin_error, b.rotation_error, b.spin_error);
  out.velocity_error = (1 - s) * a.velocity_error + s * b.velocity_error;
  out.spin_error = (1 - s) * a.spin_error + s * b.spin_error;
  out.closure.position = linear(a.closure.position, b.closure.position);
  out.closure.velocity = linear(a.closure.velocity, b.closure.velocity);
  out.energy_error = linear(a.energy_error, b.energy_error);
  return out;
}

}  // namespace ursula

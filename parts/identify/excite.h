#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "model/scenario.h"

namespace ursula {

/// Limits of a motion that shows a machine's numbers. A zero selects the value from the scenario's own motion.
struct ExciteOptions {
  double period = 0;     ///< s; default: the motion's duration, at least 4 s
  int harmonics = 5;     ///< harmonics of the finite Fourier series of each of the pose's six coordinates
  int samples = 0;       ///< rows of the file; default: 20 for each period of the highest harmonic
  double speed = 0;      ///< limit of a driven coordinate, rad/s or m/s; default: 1.5 times the scenario's
  double effort = 0;     ///< limit of an effort, N·m or N; default: 1.5 times the scenario's
  double reach = 0;      ///< limit of P's distance from the middle, m; default: a tenth of the machine's length
  double turn = 0.3;     ///< limit of the rotation from the middle about any axis, rad
  double condition = 0;  ///< limit of B's condition number; default: three times the scenario's
  double margin = 0.1;   ///< least |sin| of a leg; it is 0 if the leg is stretched or folded
  int tries = 600;       ///< tries of the search
  std::uint64_t seed = 1;
  std::function<void(double share, const std::string& what)> progress = {};
};

struct Excitation {
  std::string csv;         ///< `t_s`, `p_{x,y,z}_m`, `q_{w,x,y,z}` over one period; the last row repeats the first
  Eigen::Index shown = 0;  ///< combinations of numbers that the motion shows
  double condition = 0;    ///< condition number of the regressor in these, with columns of plausible sizes
  double scenario_condition = 0;            ///< the same for the scenario's own motion; infinite if it shows fewer
  double speed = 0, effort = 0, kappa = 0;  ///< largest values along the motion
};

/// Returns a periodic motion about the middle of the scenario's that shows as many of the machine's numbers as
/// possible. A random search maximises the determinant of its regressor. Throws UnmadeExcitation if not even a small
/// motion keeps to the limits.
Excitation excite(const Scenario& scenario, const ExciteOptions& options);

struct UnmadeExcitation : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace ursula

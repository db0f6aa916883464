#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "model/scenario.h"

namespace ursula {

/// What a motion that shows a machine's numbers has to keep to. A zero is taken from the scenario's own motion.
struct ExciteOptions {
  double period = 0;     ///< s; by default the motion's duration, and at least 4 s
  int harmonics = 5;     ///< of the finite Fourier series of each of the pose's six coordinates
  int samples = 0;       ///< rows of the file; by default 20 for each period of the highest harmonic
  double speed = 0;      ///< of a driven coordinate, rad/s or m/s; by default one and a half times the scenario's
  double effort = 0;     ///< N·m or N; by default one and a half times the scenario's
  double reach = 0;      ///< of P from the middle of the motion, m; by default a tenth of the machine's length
  double turn = 0.3;     ///< about any axis, rad
  double condition = 0;  ///< of B; by default three times the scenario's
  double margin = 0.1;   ///< least |sin| of a leg that is nearly stretched or folded
  int tries = 600;       ///< of the search
  std::uint64_t seed = 1;
  std::function<void(double share, const std::string& what)> progress = {};
};

struct Excitation {
  std::string csv;         ///< `t_s`, `p_{x,y,z}_m`, `q_{w,x,y,z}` over one period, its first row again as the last
  Eigen::Index shown = 0;  ///< combinations of numbers that the motion shows
  double condition = 0;    ///< of the regressor in them, columns of plausible sizes
  double scenario_condition = 0;            ///< of the scenario's own motion in the same; infinite where it shows fewer
  double speed = 0, effort = 0, kappa = 0;  ///< the largest along it
};

/// A periodic motion about the middle of the scenario's that shows as much as it can of the machine's numbers: the
/// determinant of its regressor is the largest that a random search finds. Throws UnmadeExcitation where not even a
/// small motion keeps to the limits.
Excitation excite(const Scenario& scenario, const ExciteOptions& options);

struct UnmadeExcitation : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace ursula

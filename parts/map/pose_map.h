#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "report/files/blocks.h"

namespace ursula {

/// Thrown for an impossible grid; says what was given and what was expected.
struct GridError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One coordinate of the platform's pose, as one value or `count` equally spaced ones. It is a position of P in B, m,
/// or an angle, degrees: Q = R_z(yaw) R_y(pitch) R_x(roll).
struct GridAxis {
  double from = 0, to = 0;
  int count = 1;
  bool given = false;

  bool varies() const { return count > 1; }
  double value(int k) const { return varies() ? from + (to - from) * k / (count - 1) : from; }
};

constexpr std::size_t grid_axes = 6;
constexpr std::array<const char*, grid_axes> grid_axis_names = {"x", "y", "z", "roll", "pitch", "yaw"};

/// Parses "FROM,TO,COUNT", or one value. Throws GridError with the axis.
GridAxis gridAxis(const std::string& name, const std::string& text);

/// Poses at rest; the first varying axis varies fastest. Missing coordinates are those of the trajectory's pose at
/// `instant`. If no axis varies, the missing positions vary around the path of P.
class PoseGrid {
 public:
  /// Throws GridError unless two or three axes vary, for more than 100 million poses, and for an instant outside the
  /// motion.
  PoseGrid(const Scenario& scenario, const std::array<GridAxis, grid_axes>& axes, double instant);

  std::size_t size() const { return size_; }
  /// Returns the coordinates of pose k in m and degrees.
  std::array<double, grid_axes> at(std::size_t k) const;
  Motion<double> pose(std::size_t k) const;
  /// Returns the coordinates of any pose, in m and degrees.
  static std::array<double, grid_axes> coordinatesOf(const Motion<double>& pose);
  const GridAxis& axis(std::size_t which) const { return axes_[which]; }
  /// Returns the indices of the varying axes, the fastest first.
  const std::vector<std::size_t>& varying() const { return varying_; }

 private:
  std::array<GridAxis, grid_axes> axes_;
  Motion<double> rest_;  ///< the trajectory's pose
  bool turns_ = false;   ///< whether an angle was given
  std::vector<std::size_t> varying_;
  std::size_t size_ = 1;
};

/// The plotted values of each pose, in the grid's order; NaN if missing.
struct DrawnMap {
  bool kept = true;                          ///< whether the values below are kept
  std::size_t reached = 0;                   ///< poses that all legs can take
  std::vector<float> kappa, margin, effort;  ///< NaN kappa means out of reach
  std::string effort_unit;                   ///< "N·m", or "N"
};

/// One row per pose of `grid`: position of P, m; roll, pitch, yaw, rad; `reach`, 1 if all legs can take the pose, else
/// 0. `kappa_B` is the condition number of B of (23) with moments over the machine's length; `sine_i` is each leg's
/// margin (LegMargins::sine), `sine_min` the smallest; telescopic legs have `stroke_min_m`, the smallest distance from
/// an end of a stroke. `tau_max` is the largest effort that holds the pose at rest, under gravity and the scenario's
/// load, by BatchDynamics. It is NaN if reach is 0 or the pose is singular. Fills `drawn`.
BlockTable mapBlocks(const Scenario& scenario, const PoseGrid& grid, DrawnMap& drawn);

/// Whether every leg is telescopic, so that its stroke and no angle limits it.
bool isTelescopic(const Scenario& scenario);

/// The largest number of poses for mapPicture.
constexpr std::size_t most_drawn = 1'000'000;

/// Returns SVG heat maps of κ, of what limits the legs (stroke or sine) and of effort over the first two axes, with the
/// commanded path. Each of at most six values of the third axis
/// has a row. Poses out of reach are grey.
std::string mapPicture(const Scenario& scenario, const PoseGrid& grid, const DrawnMap& drawn);

}  // namespace ursula

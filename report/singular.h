#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "report/picture.h"

namespace ursula::report {

/// Where a machine is weakest at one instant, from the picture's points and axes alone.
struct WeakDirections {
  /// [ω; v of P] of the platform that the motors, held, resist least: rotations times the machine's size, m. Norm 1; of
  /// the sign that is nearer to the instant before. At a singular pose of the second kind nothing resists it.
  Eigen::Matrix<double, 6, 1> yielding;
  std::size_t leg = 0;  ///< that is nearest to where its motor no longer moves B
  Vector3d lost;        ///< unit vector: along it that leg's motor hardly moves B
};

/// At each instant of `picture`. None where a leg is not held by two turning joints beside its turning motor, or where
/// a leg is stretched so that no direction can be told.
std::optional<std::vector<WeakDirections>> weakDirections(const Picture& picture);

}  // namespace ursula::report

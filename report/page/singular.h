#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "report/page/picture.h"

namespace ursula::report {

/// The weakest directions of a machine at one instant, from the picture's points and axes only.
struct WeakDirections {
  /// The platform's [ω; v of P] that the locked motors resist least, with rotations times the machine's size, m. It has
  /// norm 1 and the sign nearer to the previous instant. At a singular pose of the second kind they do not resist it at
  /// all.
  Eigen::Matrix<double, 6, 1> yielding;
  std::size_t leg = 0;  ///< index of the leg nearest to losing its motor's effect on B
  Vector3d lost;        ///< unit vector along which that leg's motor hardly moves B
};

/// Evaluates each instant of `picture`. Returns nullopt unless each leg has two passive rotating joints beside its
/// rotating motor, or if a stretched leg leaves a direction undetermined.
std::optional<std::vector<WeakDirections>> weakDirections(const Picture& picture);

}  // namespace ursula::report

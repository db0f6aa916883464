#pragma once

#include <Eigen/Core>
#include <vector>

namespace ursula {

/// Takes out of the motions Z, speeds × k, those that only spin a body, by its twist's Jacobian [angular; linear] at
/// the mass centre, 6 × speeds. Returns the lines of these spins, unit vectors. A body that also moves in Z has none.
std::vector<Eigen::Vector3d> takeSpins(const Eigen::MatrixXd& jacobian, Eigen::MatrixXd& Z);

}  // namespace ursula

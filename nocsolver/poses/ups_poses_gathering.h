#pragma once

#include <complex>

#include "nocsolver/poses/ups_poses_roots.h"

// Solutions told apart, and counted. Internal to nocsolver/ups_poses*.

namespace ursula::ups {

using ComplexPose = Placed<std::complex<double>>;
using ComplexCoordinates = Eigen::Matrix<std::complex<double>, coordinate_count, 1>;

/// Of unit length.
ComplexCoordinates coordinates(const ComplexPose& pose);

/// The pose with these coordinates, or nearly so.
ComplexPose poseAt(const ComplexCoordinates& x);

/// Newton with the least step, for a pose that may be singular: true where it ends in a solution.
bool settle(const Legs& legs, ComplexPose& pose);

/// The pose, a solution, is on a curve of them: a step along it, however long, leads to another.
bool isFree(const Legs& legs, const ComplexPose& pose);

/// Gathers solutions as they are found.
class Gathering {
 public:
  explicit Gathering(const Legs& legs) : legs_(legs) {}

  /// An eigenvector of unit length; `weight`: 1 for a real one, 2 for one of a pair.
  void addEigenvector(const ComplexCoordinates& x, int weight);

  /// The end of a path, a solution.
  void addEnd(const ComplexPose& pose);

  void addInfinite(int weight) { roots_.at_infinity += weight; }

  Roots count();

 private:
  bool addReal(const ComplexPose& pose, const ComplexPose& from, int weight);
  void insert(const ComplexPose& pose, bool real, int weight);

  const Legs& legs_;
  Roots roots_;
};

}  // namespace ursula::ups

#pragma once

#include <complex>

#include "nocsolver/poses/ups_poses_roots.h"

// Separates and counts solutions. Internal to nocsolver/ups_poses*.

namespace ursula::ups {

using ComplexPose = Placed<std::complex<double>>;
using ComplexCoordinates = Eigen::Matrix<std::complex<double>, coordinate_count, 1>;

/// The pose's coordinates, of unit length.
ComplexCoordinates coordinates(const ComplexPose& pose);

/// The pose with these coordinates, approximately.
ComplexPose poseAt(const ComplexCoordinates& x);

/// Newton's method with the least step, for a pose that may be singular; true if it ends in a solution.
bool polishPose(const Legs& legs, ComplexPose& pose);

/// Whether the solution `pose` lies on a curve of solutions: a long step along it leads to another.
bool isFree(const Legs& legs, const ComplexPose& pose);

/// Collects solutions as they are found.
class RootCollector {
 public:
  explicit RootCollector(const Legs& legs) : legs_(legs) {}

  /// Adds an eigenvector of unit length; `weight` is 1 for a real one, 2 for one of a pair.
  void addEigenvector(const ComplexCoordinates& x, int weight);

  /// Adds the end of a path, which is a solution.
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

#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "nocsolver/poses/ups_poses_ring.h"

// All solutions of six legs in the complex numbers, polished and counted. Internal to nocsolver/ups_poses*.

namespace ursula::ups {

/// A pose, over the real or the complex numbers.
template <class Scalar>
struct Placed {
  Eigen::Matrix<Scalar, 4, 1> q;  ///< [w, x, y, z], qᵀq = 1
  Eigen::Matrix<Scalar, 3, 1> p;
};

/// A solution; of a conjugate pair the first of both.
struct Root {
  Placed<std::complex<double>> at;
  bool real = false;     ///< then its pose is real
  int multiplicity = 1;  ///< how many solutions cannot be told from this one in the arithmetic
};

struct Roots {
  std::vector<Root> list;
  int counted = 0;      ///< with multiplicities and conjugates
  int at_infinity = 0;  ///< solutions that are no poses, not even complex ones
  double pivot = 0;     ///< the smallest pivot ratio of the best chart: 0 where solutions are not finitely many
  bool free = false;    ///< there is a curve of poses

  int all() const { return counted + at_infinity; }
  bool complete() const { return all() == solution_count; }
};

/// At this ratio of pivots rounding in the ring leaves a quarter of the digits, and double roots are as wide as what is
/// taken for one root: as for the quadrics of DirectKinematics.
double smallestPivot();

/// By the ring. Tries charts until 40 solutions are counted, or until it is clear that they are not finitely many.
Roots findRoots(const Legs& legs);

/// By paths from the solutions of a machine near by, for one that has infinitely many at infinity, and to see whether
/// they are there alone.
Roots trackRoots(const Legs& legs);

}  // namespace ursula::ups

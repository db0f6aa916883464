#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "nocsolver/poses/ups_poses_ring.h"

// All complex solutions of six legs, polished and counted. Internal to nocsolver/ups_poses*.

namespace ursula::ups {

/// A pose, over the real or the complex numbers.
template <class Scalar>
struct Placed {
  Eigen::Matrix<Scalar, 4, 1> q;  ///< [w, x, y, z], qᵀq = 1
  Eigen::Matrix<Scalar, 3, 1> p;
};

/// A solution; it stands for both of a conjugate pair.
struct Root {
  Placed<std::complex<double>> at;
  bool real = false;     ///< whether its pose is real
  int multiplicity = 1;  ///< number of solutions that rounding merges into this one
};

struct Roots {
  std::vector<Root> list;
  int counted = 0;      ///< with multiplicities and conjugates
  int at_infinity = 0;  ///< solutions that are no poses, not even complex ones
  double pivot = 0;     ///< smallest pivot ratio of the best chart: 0 if solutions are infinitely many
  bool free = false;    ///< whether there is a curve of poses

  int all() const { return counted + at_infinity; }
  bool complete() const { return all() == solution_count; }
};

/// At this ratio of pivots, rounding in the ring leaves a quarter of the digits. Double roots then spread over the
/// radius of one cluster, as for the quadrics of DirectKinematics.
double smallestPivot();

/// Uses the ring. Tries charts until 40 solutions are counted, or until they are clearly infinitely many.
Roots findRoots(const Legs& legs);

/// Follows paths from the solutions of a nearby machine. It serves machines with infinitely many solutions at infinity,
/// and shows whether all but finitely many are there.
Roots trackRoots(const Legs& legs);

}  // namespace ursula::ups

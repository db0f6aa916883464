#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include "base/scalar.h"

// The poses of six legs of given lengths form a linear section of the motion group's compactification. This header has
// the section and its ring. Internal to nocsolver/ups_poses*.

namespace ursula::ups {

constexpr int solution_count = 40;    ///< degree of the compactification: number of solutions of every finite section
constexpr int coordinate_count = 17;  ///< h, Q row by row, Qᵀp, p, pᵀp: homogeneous, h = 1 for a pose
constexpr int section_count = 11;     ///< dimension of the coordinates that satisfy six legs
constexpr int chart_count = 8;

/// The first index of each kind of coordinate.
constexpr int at_h = 0, at_Q = 1, at_u = 10, at_p = 13, at_r = 16;

using Coordinates = Eigen::Matrix<double, coordinate_count, 1>;
using Section = Eigen::Matrix<double, coordinate_count, section_count>;  // orthonormal columns

/// Six legs, in a unit of length in which their numbers are about 1.
template <class Scalar>
struct LegsOver {
  std::array<Eigen::Matrix<Scalar, 3, 1>, 6> a, b;
  Eigen::Matrix<Scalar, 6, 1> d;
};
using Legs = LegsOver<double>;

struct LegSection {
  Section N;         ///< N z are all coordinates that satisfy the six legs
  double pivot = 0;  ///< ratio of smallest to largest pivot of the six equations
};

LegSection legSection(const Legs& legs);

/// Multiplication by a generic linear form in the section's ring, dimension 40.
struct Multiplication {
  Eigen::MatrixXd M;  ///< 40 × 40; right eigenvectors begin with 1, y₁…y₁₀ of a solution; empty if a pivot is 0
  Section map;        ///< coordinates = map [1; y]
  double pivot = 0;   ///< smallest ratio of pivots; 0 if the section is infinite or meets the chart's infinity
};

/// Computes it in chart `index` of `chart_count`. Allocates.
Multiplication multiplication(const Section& section, int index);

// All complex solutions of six legs, polished and counted. Internal to nocsolver/ups_poses*.

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

/// Returns the ratio of pivots at which rounding in the ring leaves a quarter of the digits. Double roots then spread
/// over the radius of one cluster, as for the quadrics of DirectKinematics.
double smallestPivot();

/// Finds the roots by the ring. It tries charts until 40 solutions are counted, or until they are clearly infinitely
/// many.
Roots findRoots(const Legs& legs);

/// Finds the roots along paths from the solutions of a nearby machine. It serves machines with infinitely many
/// solutions at infinity, and shows whether all but finitely many are there.
Roots trackRoots(const Legs& legs);

// Newton's method on |p + Qb − a|² = d², over the real or the complex numbers. Internal to nocsolver/ups_poses*.

template <class Scalar>
using Vec3 = Eigen::Matrix<Scalar, 3, 1>;
template <class Scalar>
using Vec6 = Eigen::Matrix<Scalar, 6, 1>;
template <class Scalar>
using Mat3 = Eigen::Matrix<Scalar, 3, 3>;

/// product() is xᵀy and crossed() is x × y, both without conjugation. Eigen's own functions conjugate.
template <class X, class Y>
typename X::Scalar product(const X& x, const Y& y) {
  return (x.transpose() * y).value();
}
template <class Scalar>
Vec3<Scalar> crossed(const Vec3<Scalar>& x, const Vec3<Scalar>& y) {
  return {x(1) * y(2) - x(2) * y(1), x(2) * y(0) - x(0) * y(2), x(0) * y(1) - x(1) * y(0)};
}

/// Returns Q of a quaternion with qᵀq = 1.
template <class Scalar>
Mat3<Scalar> rotation(const Eigen::Matrix<Scalar, 4, 1>& q) {
  const Scalar w = q(0), x = q(1), y = q(2), z = q(3), two = 2;
  Mat3<Scalar> Q;
  Q << w * w + x * x - y * y - z * z, two * (x * y - w * z), two * (x * z + w * y),  //
      two * (x * y + w * z), w * w - x * x + y * y - z * z, two * (y * z - w * x),   //
      two * (x * z - w * y), two * (y * z + w * x), w * w - x * x - y * y + z * z;
  return Q;
}

/// The six equations at a pose.
template <class Scalar>
struct Equations {
  Vec6<Scalar> f;                 ///< vᵀv − d², v = p + Qb − a
  Eigen::Matrix<Scalar, 6, 6> J;  ///< derivatives by a rotation about the axes of B, then by p
  double rounding = 0;            ///< error bound of f: some 16 roundings of its largest terms
  double curvature = 0;           ///< bound of |½ f''| for a unit step
  bool solved() const { return f.cwiseAbs().maxCoeff() <= rounding; }
};

template <class Scalar, class LegScalar>
Equations<Scalar> equations(const LegsOver<LegScalar>& legs, const Placed<Scalar>& at) {
  Equations<Scalar> out;
  const Mat3<Scalar> Q = rotation<Scalar>(at.q);
  double largest = 0;
  for (int k = 0; k < 6; ++k) {
    const Vec3<Scalar> Qb = Q * legs.b[k].template cast<Scalar>(), v = at.p + Qb - legs.a[k].template cast<Scalar>();
    out.f(k) = product(v, v) - Scalar(legs.d(k) * legs.d(k));
    out.J.row(k) << 2.0 * crossed<Scalar>(Qb, v).transpose(), 2.0 * v.transpose();
    const double terms = at.p.norm() + Q.norm() * legs.b[k].norm() + legs.a[k].norm() + std::abs(legs.d(k));
    largest = std::max(largest, terms * terms);
    out.curvature = std::max(out.curvature, (1 + Qb.norm()) * (1 + Qb.norm()) + v.norm() * Qb.norm());
  }
  out.rounding = 16 * Eigen::NumTraits<double>::epsilon() * largest;
  return out;
}

/// Returns the pose after a step, which rotates it and then translates it.
template <class Scalar>
Placed<Scalar> displaced(const Placed<Scalar>& from, const Vec6<Scalar>& step) {
  const Vec3<Scalar> half = step.template head<3>() / 2.0, v = from.q.template tail<3>();
  Placed<Scalar> to = from;
  to.q(0) -= product(half, v);
  to.q.template tail<3>() += from.q(0) * half + crossed<Scalar>(half, v);
  to.q /= std::sqrt(product(to.q, to.q));
  to.p += step.template tail<3>();
  return to;
}

/// Applies Newton's method until f no longer falls, and keeps the best pose. Returns whether it is a solution.
template <class Scalar>
bool polish(const Legs& legs, Placed<Scalar>& pose) {
  constexpr int steps = 12, patience = 3;
  Equations<Scalar> now = equations<Scalar>(legs, pose);
  double best = now.f.norm();
  bool solved = now.solved();
  Placed<Scalar> next = pose;
  for (int i = 0, worse = 0; i < steps && worse < patience && best > 0; ++i) {
    next = displaced<Scalar>(next, -now.J.partialPivLu().solve(now.f));
    now = equations<Scalar>(legs, next);
    const double value = now.f.norm();
    if (!(value < best)) {
      if (solved) break;
      ++worse;
      continue;
    }
    worse = 0;
    best = value;
    pose = next;
    solved = now.solved();
  }
  return solved;
}

// Separates and counts solutions. Internal to nocsolver/ups_poses*.

using ComplexPose = Placed<std::complex<double>>;
using ComplexCoordinates = Eigen::Matrix<std::complex<double>, coordinate_count, 1>;

/// Returns the pose's coordinates, of unit length.
ComplexCoordinates coordinates(const ComplexPose& pose);

/// Returns the pose with these coordinates, approximately.
ComplexPose poseAt(const ComplexCoordinates& x);

/// Applies Newton's method with the least step, for a pose that may be singular. Returns whether it ends in a solution.
bool polishPose(const Legs& legs, ComplexPose& pose);

/// Returns whether the solution `pose` lies on a curve of solutions: a long step along it leads to another.
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

#include "parts/poses/ups_poses_parts.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <optional>

// Eigenvectors give each solution to some digits; Newton's method gives the rest. Solutions that rounding cannot
// separate count as one multiple solution: their midpoint solves the six equations within rounding. A nearly real
// complex pair is the same case turned by 90°.

namespace ursula::ups {
namespace {

using Complex = std::complex<double>;
using RealPose = Placed<double>;

constexpr double eps = Eigen::NumTraits<double>::epsilon();
/// Solutions whose unit coordinates are farther apart are never merged. A solution farther from an eigenvector does not
/// belong to it.
const double cluster_radius = std::pow(eps, 1.0 / 8);
/// |h| of unit coordinates at infinity is 0, up to the spread of a fourfold solution. A real pose has at least 1/(2 +
/// ‖p‖²), so it never counts as one at infinity.
const double little_h = std::pow(eps, 1.0 / 4);
/// Singular values below this fraction of the largest belong to a double solution.
const double flat = std::sqrt(eps);

/// Returns the distance of unit vectors, up to a factor of modulus one.
double distance(const ComplexCoordinates& x, const ComplexCoordinates& y) { return (y - x * x.dot(y)).norm(); }

ComplexPose complexOf(const RealPose& pose) { return {pose.q.cast<Complex>(), pose.p.cast<Complex>()}; }

/// Returns nullopt unless the pose is nearly real.
std::optional<RealPose> realPart(const ComplexPose& pose) {
  if (!(pose.q.imag().norm() + pose.p.imag().norm() <= cluster_radius * (1 + pose.p.norm()))) return std::nullopt;
  return RealPose{pose.q.real().normalized(), pose.p.real()};
}

template <class Scalar>
Placed<Scalar> middle(const Placed<Scalar>& a, const Placed<Scalar>& b) {
  const double sign = std::real(a.q.dot(b.q)) < 0 ? -1 : 1;
  Placed<Scalar> out{a.q + sign * b.q, (a.p + b.p) / 2.0};
  out.q /= std::sqrt(product(out.q, out.q));
  return out;
}

template <class Scalar>
using Svd = Eigen::JacobiSVD<Eigen::Matrix<Scalar, 6, 6>>;

template <class Scalar>
Svd<Scalar> decomposed(const Equations<Scalar>& at) {
  return Svd<Scalar>(at.J, Eigen::ComputeFullU | Eigen::ComputeFullV);
}

/// Returns Newton's step in the `rank` directions in which the equations change most.
template <class Scalar>
Vec6<Scalar> leastStep(const Equations<Scalar>& at, const Svd<Scalar>& svd, int rank) {
  Vec6<Scalar> step = Vec6<Scalar>::Zero();
  for (int k = 0; k < rank; ++k)
    step -= svd.matrixV().col(k) * (svd.matrixU().col(k).dot(at.f) / svd.singularValues()(k));
  return step;
}

/// Returns the pose, or the pose moved in the well-determined directions, if that is a solution.
template <class Scalar>
std::optional<Placed<Scalar>> rootAt(const Legs& legs, const Placed<Scalar>& pose) {
  const Equations<Scalar> at = equations<Scalar>(legs, pose);
  if (at.solved()) return pose;
  if (!at.f.allFinite()) return std::nullopt;
  const Placed<Scalar> moved = displaced<Scalar>(pose, leastStep<Scalar>(at, decomposed<Scalar>(at), 5));
  if (equations<Scalar>(legs, moved).solved()) return moved;
  return std::nullopt;
}

/// In the flattest direction the equations are σ t + κ t². Between two solutions, σ/κ apart, they stay below `rounding`
/// if σ²/4κ does.
template <class Scalar>
bool isMultiple(const Legs& legs, const Placed<Scalar>& pose) {
  const Equations<Scalar> at = equations<Scalar>(legs, pose);
  const double sigma = decomposed<Scalar>(at).singularValues()(5);
  return sigma * sigma <= 4 * std::sqrt(6.0) * at.curvature * at.rounding;
}

/// Returns whether the equations' rounding moves the pose by less than 1/64 of its coordinates. Near infinity every
/// distant pose solves them.
bool isDetermined(const Legs& legs, const ComplexPose& pose) {
  Equations<Complex> at = equations<Complex>(legs, pose);
  at.J.rightCols<3>() *= 1 + pose.p.norm();
  return at.rounding <= decomposed<Complex>(at).singularValues()(5) / 64;
}

}  // namespace

ComplexCoordinates coordinates(const ComplexPose& pose) {
  const Mat3<Complex> Q = rotation<Complex>(pose.q);
  ComplexCoordinates x;
  x << 1, Q.row(0).transpose(), Q.row(1).transpose(), Q.row(2).transpose(), Q.transpose() * pose.p, pose.p,
      product(pose.p, pose.p);
  return x.normalized();
}

/// 4 q qᵀ is linear in h = qᵀq and Q; its largest column gives q.
ComplexPose poseAt(const ComplexCoordinates& x) {
  const Mat3<Complex> Q = Eigen::Map<const Eigen::Matrix<Complex, 3, 3, Eigen::RowMajor>>(x.data() + at_Q) / x(at_h);
  Eigen::Matrix4cd K;
  K(0, 0) = 1.0 + Q.trace();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    K(0, i + 1) = K(i + 1, 0) = Q(k, j) - Q(j, k);
    K(i + 1, i + 1) = 1.0 + 2.0 * Q(i, i) - Q.trace();
    K(i + 1, j + 1) = K(j + 1, i + 1) = Q(i, j) + Q(j, i);
  }
  Eigen::Index largest = 0;
  K.diagonal().cwiseAbs().maxCoeff(&largest);
  ComplexPose pose{K.col(largest), x.segment<3>(at_p) / x(at_h)};
  pose.q /= std::sqrt(product(pose.q, pose.q));
  return pose;
}

/// Skips directions in which the equations change by less than ε^½ of the largest change. Near a double solution each
/// step halves the distance.
bool polishPose(const Legs& legs, ComplexPose& pose) {
  for (int i = 0; i < 30; ++i) {
    const Equations<Complex> at = equations<Complex>(legs, pose);
    if (at.solved()) return true;
    if (!at.f.allFinite()) return false;
    const Svd<Complex> svd = decomposed<Complex>(at);
    const auto& sigma = svd.singularValues();
    const auto rank = (sigma.array() > flat * sigma(0)).count();
    pose = displaced<Complex>(pose, leastStep<Complex>(at, svd, static_cast<int>(rank)));
  }
  return equations<Complex>(legs, pose).solved();
}

/// Takes a step of ε^⅛, the largest spread of a multiple solution.
bool isFree(const Legs& legs, const ComplexPose& pose) {
  const Svd<Complex> svd = decomposed<Complex>(equations<Complex>(legs, pose));
  if (!(svd.singularValues()(5) <= 16 * flat * svd.singularValues()(0))) return false;
  ComplexPose moved = displaced<Complex>(pose, cluster_radius * svd.matrixV().col(5));
  const ComplexCoordinates x = coordinates(pose);
  const double away = distance(coordinates(moved), x);
  return polishPose(legs, moved) && distance(coordinates(moved), x) > away / 2;
}

void RootCollector::addEigenvector(const ComplexCoordinates& x, int weight) {
  const bool far = !(std::abs(x(at_h)) > little_h);
  if (far && !(std::abs(x(at_h)) > eps)) return addInfinite(weight);
  const ComplexPose from = poseAt(x);
  ComplexPose pose = from;
  const bool found = polish<Complex>(legs_, pose) && distance(coordinates(pose), x) <= cluster_radius;
  if (far && !(found && isDetermined(legs_, pose))) return addInfinite(weight);
  if (!found) return;
  if (!addReal(pose, from, weight) && weight == 2) insert(pose, false, weight);
}

void RootCollector::addEnd(const ComplexPose& pose) {
  if (!addReal(pose, pose, 1)) insert(pose, false, 1);
}

/// Returns false if no real pose is near enough.
bool RootCollector::addReal(const ComplexPose& pose, const ComplexPose& from, int weight) {
  const std::optional<RealPose> part = realPart(pose);
  if (!part) return false;
  const std::optional<RealPose> real = rootAt<double>(legs_, *part);
  if (!real) return false;
  if (weight == 1 || isMultiple<double>(legs_, *real)) {
    insert(complexOf(*real), true, weight);
    return true;
  }
  insert(complexOf(*real), true, 1);  // the pair is two real solutions, on either side of the start
  if (const std::optional<RealPose> between = realPart(from)) {
    const double sign = between->q.dot(real->q) < 0 ? -1 : 1;
    RealPose other{(2 * sign * between->q - real->q).normalized(), 2 * between->p - real->p};
    if (polish<double>(legs_, other)) insert(complexOf(other), true, 1);
  }
  return true;
}

void RootCollector::insert(const ComplexPose& pose, bool real, int weight) {
  const ComplexPose conjugate{pose.q.conjugate(), pose.p.conjugate()};
  for (Root& root : roots_.list) {
    if (root.real != real) continue;
    const ComplexCoordinates x = coordinates(root.at);
    for (const ComplexPose& candidate : {pose, conjugate}) {
      if (!(distance(x, coordinates(candidate)) <= cluster_radius)) continue;
      if (!rootAt<Complex>(legs_, middle<Complex>(root.at, candidate))) continue;
      root.multiplicity += weight;
      return;
    }
  }
  roots_.list.push_back({pose, real, weight});
}

Roots RootCollector::count() {
  roots_.counted = 0;
  for (Root& root : roots_.list) {
    const int conjugates = root.real ? 1 : 2;
    const bool multiple = root.multiplicity > conjugates && isMultiple<Complex>(legs_, root.at);
    root.multiplicity = multiple ? root.multiplicity / conjugates : 1;  // else it was found twice
    roots_.counted += root.multiplicity * conjugates;
  }
  return roots_;
}

}  // namespace ursula::ups

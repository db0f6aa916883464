#include "parts/poses/direct_kinematics_parts.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

// Eigenvectors give each root to some digits; Newton's method gives the rest. Roots that rounding cannot separate count
// as one multiple root. The quadrics alone decide: at the midpoint of two such roots they are 0 within rounding (f(m) =
// −¼ dᵀS d for roots d apart). A nearly real complex pair is the same case turned by 90°.

namespace ursula::direct {
namespace {

using Complex = std::complex<double>;
using ComplexQ = Eigen::Vector4cd;

constexpr double eps = Eigen::NumTraits<double>::epsilon();
constexpr int newton_steps = 12;
/// Roots farther apart than ε^(1/8), the error bound of an eightfold root, are never merged.
const double cluster_radius = std::pow(eps, 1.0 / 8);

template <class Scalar>
using Q4 = Eigen::Matrix<Scalar, 4, 1>;

template <class Scalar>
Q4<Scalar> newtonStep(const ThreeQuadrics& quadrics, const Q4<Scalar>& q) {
  Eigen::Matrix<Scalar, 4, 4> J;
  Q4<Scalar> f;
  for (int k = 0; k < 3; ++k) {
    const Q4<Scalar> Sq = quadrics.S[k] * q;
    J.row(k) = 2 * Sq.transpose();
    f(k) = Sq.cwiseProduct(q).sum();
  }
  J.row(3) = q.adjoint();  // the step is perpendicular to q
  f(3) = 0;
  return -J.partialPivLu().solve(f);
}

/// Applies Newton's method at unit length until the residual no longer falls; keeps the best q. Returns whether it is a
/// root.
template <class Scalar>
bool polish(const ThreeQuadrics& quadrics, double rounding, Q4<Scalar>& q) {
  double best = residual<Scalar>(quadrics, q);
  Q4<Scalar> next = q;
  int worse = 0;
  for (int i = 0; i < newton_steps && best > 8 * eps && worse < 3; ++i) {
    next = (next + newtonStep<Scalar>(quadrics, next)).normalized();
    const double value = residual<Scalar>(quadrics, next);
    worse = value < best ? 0 : worse + 1;
    if (worse == 0) {
      best = value;
      q = next;
    } else if (best <= rounding) {
      break;
    }
  }
  return best <= rounding;
}

/// Chooses the phase with the smallest imaginary part, which is then perpendicular to the real part.
ComplexQ turnedReal(const ComplexQ& q) {
  const Complex square = (q.transpose() * q).value();
  return q * std::polar(1.0, -std::arg(square) / 2);
}

/// Returns the distance √(1 − |pᴴq|²) of unit vectors without cancellation.
double distance(const ComplexQ& p, const ComplexQ& q) { return (q - p * p.dot(q)).norm(); }

/// The quadrics along the direction n in which they change least: uᵀf(q + t n) = f + σ t + κ t².
struct Flattest {
  ComplexQ n, correction;  // correction: Newton's step in the other two directions
  Complex f, kappa;
  double sigma = 0;
};

Flattest flattest(const ThreeQuadrics& quadrics, const ComplexQ& q) {
  Eigen::Matrix<Complex, 3, 4> J;
  Eigen::Vector3cd f, curvature;
  for (int k = 0; k < 3; ++k) {
    const ComplexQ Sq = quadrics.S[k] * q;
    J.row(k) = 2 * Sq.transpose();
    f(k) = (q.transpose() * Sq).value();
  }
  const Eigen::JacobiSVD<Eigen::Matrix<Complex, 3, 4>> svd(J, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Flattest out;
  out.n = svd.matrixV().col(2);
  out.sigma = svd.singularValues()(2);
  for (int k = 0; k < 3; ++k) curvature(k) = (out.n.transpose() * quadrics.S[k] * out.n).value();
  const Eigen::Vector3cd u = svd.matrixU().col(2);
  out.f = u.dot(f);
  out.kappa = u.dot(curvature);
  out.correction.setZero();
  for (int k = 0; k < 2; ++k)
    out.correction -= svd.matrixV().col(k) * (svd.matrixU().col(k).dot(f) / svd.singularValues()(k));
  return out;
}

/// Between two roots σ/κ apart the quadrics stay below `rounding` if σ²/4κ does; |κ| ≤ √3 as the Sₖ have unit norm.
bool isMultiple(const ThreeQuadrics& quadrics, double rounding, const ComplexQ& q) {
  const double sigma = flattest(quadrics, q).sigma;
  return sigma * sigma <= 4 * std::sqrt(3.0) * rounding;
}

/// Returns m, or m moved in the well-determined directions, if that is a root.
std::optional<ComplexQ> rootAt(const ThreeQuadrics& quadrics, double rounding, const ComplexQ& m) {
  if (residual<Complex>(quadrics, m) <= rounding) return m;
  const ComplexQ moved = (m + flattest(quadrics, m).correction).normalized();
  if (residual<Complex>(quadrics, moved) <= rounding) return moved;
  return std::nullopt;
}

/// Collects the roots of one chart.
class RootCollector {
 public:
  RootCollector(const ThreeQuadrics& quadrics, double rounding) : quadrics_(quadrics), rounding_(rounding) {}

  /// Adds a real eigenvector. If Newton's method finds no real root, a complex pair is near.
  void addReal(Q4<double> q) {
    if (polish<double>(quadrics_, rounding_, q)) {
      insert(q.cast<Complex>(), true, 1);
      return;
    }
    const ComplexQ at = q.cast<Complex>();
    const Flattest flat = flattest(quadrics_, at);
    const Complex t =
        (-flat.sigma + std::sqrt(Complex(flat.sigma * flat.sigma - 4.0 * flat.kappa * flat.f))) / (2.0 * flat.kappa);
    ComplexQ root = (at + t * flat.n + flat.correction).normalized();
    if (polish<Complex>(quadrics_, rounding_, root)) addPolished(root, 1, at);
  }

  /// Adds one eigenvector of a complex pair.
  void addPair(ComplexQ q) {
    const ComplexQ from = turnedReal(q);
    if (polish<Complex>(quadrics_, rounding_, q)) addPolished(q, 2, from);
  }

  Roots count() {
    roots_.counted = 0;
    for (int i = 0; i < roots_.size; ++i) {
      Root& root = roots_.list[i];
      const int conjugates = root.real ? 1 : 2;
      const bool multiple = root.multiplicity > conjugates && isMultiple(quadrics_, rounding_, root.q);
      root.multiplicity = multiple ? root.multiplicity / conjugates : 1;  // else it was found twice
      roots_.counted += root.multiplicity * conjugates;
    }
    return roots_;
  }

 private:
  /// `weight` is the number of eigenvalues that led there.
  void addPolished(const ComplexQ& polished, int weight, const ComplexQ& from) {
    const ComplexQ q = turnedReal(polished);
    if (q.imag().norm() <= cluster_radius) {
      const std::optional<ComplexQ> real = rootAt(quadrics_, rounding_, q.real().normalized().cast<Complex>());
      if (real && (weight == 1 || isMultiple(quadrics_, rounding_, *real))) {
        insert(*real, true, weight);
        return;
      }
      if (real) {  // the pair is two real roots, on either side of the start
        insert(*real, true, 1);
        const double side = from.real().dot(real->real()) < 0 ? -1 : 1;
        Q4<double> other = (2 * side * from.real() - real->real()).normalized();
        if (polish<double>(quadrics_, rounding_, other)) insert(other.cast<Complex>(), true, 1);
        return;
      }
    }
    insert(q, false, weight);
  }

  void insert(const ComplexQ& q, bool real, int weight) {
    for (int i = 0; i < roots_.size; ++i) {
      Root& root = roots_.list[i];
      if (root.real != real) continue;
      for (const ComplexQ& candidate : {q, ComplexQ(q.conjugate())}) {
        if (!(distance(root.q, candidate) <= cluster_radius)) continue;
        const Complex phase = candidate.dot(root.q);
        const std::optional<ComplexQ> middle =
            rootAt(quadrics_, rounding_, (root.q + candidate * (phase / std::abs(phase))).normalized());
        if (!middle) continue;
        root.multiplicity += weight;
        return;
      }
    }
    if (roots_.size == root_count) return;
    roots_.list[roots_.size++] = {q, real, weight};
  }

  const ThreeQuadrics& quadrics_;
  double rounding_;
  Roots roots_;
};

Roots rootsInChart(const ThreeQuadrics& quadrics, double rounding, int index) {
  RootCollector collector(quadrics, rounding);
  const MultiplicationMatrix multiplication = multiplicationMatrix(quadrics, index);
  Roots none;
  none.pivot = multiplication.pivot;
  if (!(multiplication.pivot > eps) || !multiplication.M.allFinite()) return none;
  const Eigen::EigenSolver<Matrix8d> solver(multiplication.M);
  if (solver.info() != Eigen::Success) return none;
  const Eigen::Matrix<double, 4, root_count> V = chart(index) * solver.pseudoEigenvectors().topRows<4>();
  for (int i = 0; i < root_count; ++i) {
    const double imaginary = solver.eigenvalues()(i).imag();
    if (imaginary == 0) {
      collector.addReal(V.col(i).normalized());
    } else if (i + 1 < root_count) {
      ComplexQ q = V.col(i).cast<Complex>() + Complex(0, 1) * V.col(i + 1).cast<Complex>();
      collector.addPair(q.normalized());
      ++i;
    }
  }
  Roots roots = collector.count();
  roots.pivot = multiplication.pivot;
  return roots;
}

}  // namespace

/// A chart that keeps half of the digits is good enough; otherwise the next may be better.
Roots findRoots(const ThreeQuadrics& quadrics, double rounding) {
  const double good_pivot = std::sqrt(eps);
  Roots best;
  for (int index = 0; index < chart_count; ++index) {
    const Roots roots = rootsInChart(quadrics, rounding, index);
    const double pivot = std::max(best.pivot, roots.pivot);
    if (roots.counted > best.counted || (roots.counted == best.counted && roots.pivot > best.pivot)) best = roots;
    best.pivot = pivot;
    if (best.counted == root_count && roots.pivot > good_pivot) break;
  }
  return best;
}

}  // namespace ursula::direct

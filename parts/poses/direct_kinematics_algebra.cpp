#include "parts/poses/direct_kinematics_parts.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

// Three generic quadrics in affine x, y, z define a ring of dimension 8 = 1 + 3 + 3 + 1. Its basis has 1, x, y, z,
// three of the six monomials of degree two and one of the ten of degree three; the pivots select them:
//   the quadrics themselves express three monomials of degree two by the others;                           (a)
//   x, y, z times the quadrics express nine monomials of degree three by the tenth, c, and lower ones;     (b)
//   x c, y c, z c follow, because each monomial of degree four arises from different products of degree
//   three: xⱼ (xₖ n) = xₖ (xⱼ n) for each n of degree two.                                                (c)

namespace ursula::direct {
namespace {

using Element = Eigen::Matrix<double, 1, root_count>;  // of the ring, in the basis 1, x, y, z, three quadratic, c
constexpr int quadratic_count = 6, cubic_count = 10, lower_count = 7;

/// xx, xy, xz, yy, yz, zz
constexpr int quadratic[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
/// xⱼ times one of these: xxx, xxy, xxz, xyy, xyz, xzz, yyy, yyz, yzz, zzz
constexpr int cubic[3][quadratic_count] = {{0, 1, 2, 3, 4, 5}, {1, 3, 4, 6, 7, 8}, {2, 4, 5, 7, 8, 9}};

struct Ring {
  Eigen::Matrix<double, quadratic_count, root_count> second;  // monomials of degree two
  Eigen::Matrix<double, cubic_count, root_count> third;       // of degree three
  std::array<int, 3> basis;                                   // the monomials of degree two in the basis
  double pivot = 1;
};

/// Reduces A by Gauss–Jordan with complete pivoting in the first `columns` columns. Row r then has 1 in column
/// pivots[r] and 0 in the other pivots'. Returns the ratio of smallest to largest pivot.
template <int rows, int columns, class Matrix>
double reduce(Matrix& A, std::array<int, rows>& pivots) {
  double smallest = 0, largest = 0;
  for (int step = 0; step < rows; ++step) {
    int row = step, column = 0;
    double best = -1;
    for (int j = 0; j < columns; ++j)
      for (int i = step; i < rows; ++i)
        if (std::abs(A(i, j)) > best) best = std::abs(A(row = i, column = j));
    if (!(best > 0)) return 0;
    smallest = step == 0 ? best : std::min(smallest, best);
    largest = std::max(largest, best);
    A.row(step).swap(A.row(row));
    pivots[step] = column;
    A.row(step) /= A(step, column);
    for (int i = 0; i < rows; ++i)
      if (i != step) A.row(i) -= A(i, column) * A.row(step);
  }
  return smallest / largest;
}

/// Returns the columns below `columns` that are no pivots.
template <int columns, std::size_t rows>
std::array<int, columns - static_cast<int>(rows)> others(const std::array<int, rows>& pivots) {
  std::array<int, columns - static_cast<int>(rows)> free{};
  std::size_t count = 0;
  for (int j = 0; j < columns; ++j)
    if (std::find(pivots.begin(), pivots.end(), j) == pivots.end() && count < free.size()) free[count++] = j;
  return free;
}

using QuadraticRows = Eigen::Matrix<double, 3, quadratic_count + 4, Eigen::RowMajor>;  // xx…zz, x, y, z, 1

QuadraticRows quadraticRows(const ThreeQuadrics& quadrics, const Eigen::Matrix4d& H) {
  QuadraticRows rows;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Matrix4d S = H.transpose() * quadrics.S[k] * H;
    rows.row(k) << S(1, 1), 2 * S(1, 2), 2 * S(1, 3), S(2, 2), 2 * S(2, 3), S(3, 3), 2 * S(0, 1), 2 * S(0, 2),
        2 * S(0, 3), S(0, 0);
  }
  return rows;
}

/// (a)
void reduceSecond(QuadraticRows& rows, std::array<int, 3>& pivots, Ring& ring) {
  ring.pivot = reduce<3, quadratic_count>(rows, pivots);
  if (!(ring.pivot > 0)) return;
  ring.basis = others<quadratic_count>(pivots);
  ring.second.setZero();
  for (int b = 0; b < 3; ++b) ring.second(ring.basis[b], 4 + b) = 1;
  for (int k = 0; k < 3; ++k) {
    const int p = pivots[k];
    ring.second(p, 0) = -rows(k, 9);
    for (int j = 0; j < 3; ++j) ring.second(p, 1 + j) = -rows(k, 6 + j);
    for (int b = 0; b < 3; ++b) ring.second(p, 4 + b) = -rows(k, ring.basis[b]);
  }
}

/// (b)
void reduceThird(const QuadraticRows& rows, Ring& ring) {
  Eigen::Matrix<double, 9, cubic_count + lower_count, Eigen::RowMajor> A;
  A.setZero();
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j) {
      auto row = A.row(3 * k + j);
      for (int n = 0; n < quadratic_count; ++n) row(cubic[j][n]) = rows(k, n);
      for (int i = 0; i < 3; ++i)
        row.tail<lower_count>() += rows(k, 6 + i) * ring.second.row(quadratic[j][i]).head<lower_count>();
      row(cubic_count + 1 + j) += rows(k, 9);
    }
  std::array<int, 9> pivots{};
  ring.pivot = std::min(ring.pivot, reduce<9, cubic_count>(A, pivots));
  if (!(ring.pivot > 0)) return;
  const int c = others<cubic_count>(pivots)[0];
  ring.third.row(c) = Element::Unit(lower_count);
  for (int i = 0; i < 9; ++i) ring.third.row(pivots[i]) << -A.row(i).tail<lower_count>(), -A(i, c);
}

/// Returns xⱼ times all monomials of degree three, without xⱼ c.
Eigen::Matrix<double, cubic_count, root_count> timesThird(const Ring& ring, int j) {
  Eigen::Matrix<double, lower_count, root_count> products;
  products.row(0) = Element::Unit(1 + j);
  for (int i = 0; i < 3; ++i) {
    products.row(1 + i) = ring.second.row(quadratic[j][i]);
    products.row(4 + i) = ring.third.row(cubic[j][ring.basis[i]]);
  }
  return ring.third.leftCols<lower_count>() * products;
}

/// Solves (c) by least squares over all 18 products; returns x c. Singular if a root lies in the plane at infinity.
Element timesC(Ring& ring) {
  const std::array<Eigen::Matrix<double, cubic_count, root_count>, 3> lower = {timesThird(ring, 0), timesThird(ring, 1),
                                                                               timesThird(ring, 2)};
  const auto c = ring.third.col(lower_count);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, root_count> right = Eigen::Matrix<double, 3, root_count>::Zero();
  for (int j = 0; j < 3; ++j)
    for (int k = j + 1; k < 3; ++k)
      for (int n = 0; n < quadratic_count; ++n) {
        const int m_j = cubic[j][n], m_k = cubic[k][n];  // xⱼ m_k = xₖ m_j
        const Element difference = lower[k].row(m_j) - lower[j].row(m_k);
        normal(j, j) += c(m_k) * c(m_k);
        normal(k, k) += c(m_j) * c(m_j);
        normal(j, k) -= c(m_k) * c(m_j);
        right.row(j) += c(m_k) * difference;
        right.row(k) -= c(m_j) * difference;
      }
  normal.triangularView<Eigen::StrictlyLower>() = normal.transpose();
  const Eigen::Matrix3d inverse = normal.inverse();
  const double ratio = 3 / (normal.norm() * inverse.norm());            // at most 1
  ring.pivot = ratio <= ring.pivot ? ratio : ring.pivot * (ratio > 0);  // 0 if that is NaN
  return inverse.row(0) * right;
}

/// Returns the matrix of multiplication by the unit quaternion [w, x, y, z] from the left (sign = 1) or right (−1).
Eigen::Matrix4d isoclinic(Eigen::Vector4d q, double sign) {
  q.normalize();
  Eigen::Matrix4d L;
  L << q(0), -q(1), -q(2), -q(3),             //
      q(1), q(0), -sign * q(3), sign * q(2),  //
      q(2), sign * q(3), q(0), -sign * q(1),  //
      q(3), -sign * q(2), sign * q(1), q(0);
  return L;
}

std::array<Eigen::Matrix4d, chart_count> makeCharts() {
  std::array<Eigen::Matrix4d, chart_count> charts;
  const Eigen::Matrix4d left = isoclinic({0.6180339887, 0.7548776662, 0.2451223338, -0.5698402910}, 1);
  const Eigen::Matrix4d right = isoclinic({0.8191725134, -0.3819660113, 0.6710436067, 0.5497004779}, -1);
  Eigen::Matrix4d H = left * right;
  for (Eigen::Matrix4d& next : charts) {
    next = H;
    H = left * H * right;
  }
  return charts;
}

}  // namespace

const Eigen::Matrix4d& chart(int index) {
  static const std::array<Eigen::Matrix4d, chart_count> charts = makeCharts();
  return charts[index];
}

MultiplicationMatrix multiplicationMatrix(const ThreeQuadrics& quadrics, int index) {
  MultiplicationMatrix out;
  Ring ring;
  std::array<int, 3> pivots{};
  QuadraticRows rows = quadraticRows(quadrics, chart(index));
  reduceSecond(rows, pivots, ring);
  if (ring.pivot > 0) reduceThird(rows, ring);
  if (!(ring.pivot > 0)) return out;
  out.M.row(0) = Element::Unit(1);
  for (int i = 0; i < 3; ++i) {
    out.M.row(1 + i) = ring.second.row(quadratic[0][i]);
    out.M.row(4 + i) = ring.third.row(cubic[0][ring.basis[i]]);
  }
  out.M.row(7) = timesC(ring);
  out.pivot = ring.pivot;
  return out;
}

}  // namespace ursula::direct

#include "parts/poses/ups_poses_parts.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

// For a leg of length d between a in B and b in M, an equation linear in h, Q, u = Qᵀp, p and r = pᵀp holds:
//   r + 2 bᵀu − 2 aᵀp − 2 aᵀQb + (|a|² + |b|² − d²) h = 0.                                                  (a)
// The rigid motions form a variety of dimension 6 and degree 40 in these 17 homogeneous coordinates (Gallet, Nawratil
// and Schicho, "Bond theory for pentapods and hexapods", J. Geom. 106, 2015). 37 quadrics vanish on it:
//   QQᵀ = QᵀQ = h²1, adj Q = hQᵀ, Qu = hp, Qᵀp = hu, uᵀu = pᵀp = rh, qᵢ × p = Σⱼₖ εᵢⱼₖ uⱼ qₖ,  qᵢ: column i of Q.  (b)
// Six legs and a chart's plane at infinity reduce it to a ring of dimension 40 = 1 + 10 + 18 + 10 + 1, found degree by
// degree. The quadrics leave 18 of the 55 monomials of degree two. Of their 180 products with yⱼ, 10 stay free, because
// each monomial of degree three arises from two products; likewise in the next degree. (c) Each step is a QR of
// relations E w + K l = 0 between the products w and the known part l. Then w = V l + (null space) c, where c are the
// basis of the new degree. (d)

namespace ursula::ups {
namespace {

constexpr int variable_count = 10, quadric_count = 37, monomial_count = 55;
/// Dimensions of the ring up to each degree.
constexpr int up_to_0 = 1, up_to_1 = 11, up_to_2 = 29, up_to_3 = 39, up_to_4 = 40;

/// Σ value · coordinate(i) coordinate(j)
struct Term {
  int i, j;
  double value;
};
using Quadric = std::vector<Term>;

int q(int i, int j) { return at_Q + 3 * i + j; }

/// Adds the products of the rows with each other (transposed: of the columns), minus h² on the diagonal.
void addOrthogonality(std::vector<Quadric>& all, bool transposed) {
  const auto at = [&](int i, int j) { return transposed ? q(j, i) : q(i, j); };
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      Quadric quadric;
      for (int k = 0; k < 3; ++k) quadric.push_back({at(i, k), at(j, k), 1});
      if (i == j) quadric.push_back({at_h, at_h, -1});
      // Both traces are the sum of all squares, so one is redundant.
      if (!(transposed && i == 2 && j == 2)) all.push_back(quadric);
    }
}

/// Adds each cofactor (i, j), and each column i crossed with p.
void addCrosses(std::vector<Quadric>& all) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      all.push_back({{q(i1, j1), q(i2, j2), 1}, {q(i1, j2), q(i2, j1), -1}, {at_h, q(i, j), -1}});
      all.push_back(
          {{q(j1, i), at_p + j2, 1}, {q(j2, i), at_p + j1, -1}, {at_u + i1, q(j, i2), -1}, {at_u + i2, q(j, i1), 1}});
    }
}

/// (b)
std::vector<Quadric> motionQuadrics() {
  std::vector<Quadric> all;
  addOrthogonality(all, false);
  addOrthogonality(all, true);
  addCrosses(all);
  Quadric u2 = {{at_r, at_h, -1}}, p2 = u2;
  for (int i = 0; i < 3; ++i) {
    Quadric u = {{at_h, at_u + i, -1}}, p = {{at_h, at_p + i, -1}};
    for (int j = 0; j < 3; ++j) {
      p.push_back({q(i, j), at_u + j, 1});
      u.push_back({q(j, i), at_p + j, 1});
    }
    u2.push_back({at_u + i, at_u + i, 1});
    p2.push_back({at_p + i, at_p + i, 1});
    all.push_back(u);
    all.push_back(p);
  }
  all.push_back(u2);
  all.push_back(p2);
  return all;
}

/// Returns the index of the monomial of degree two; a and b may be in any order.
int pair(int a, int b) {
  if (a > b) std::swap(a, b);
  return a * variable_count - a * (a - 1) / 2 + b - a;
}

/// Returns a fixed generic rotation for each chart.
Eigen::Matrix<double, section_count, section_count> chart(int index) {
  std::uint64_t state = 0x9e3779b97f4a7c15u * static_cast<std::uint64_t>(index + 1);
  Eigen::Matrix<double, section_count, section_count> A;
  for (int i = 0; i < section_count; ++i)
    for (int j = 0; j < section_count; ++j) {
      double sum = -6;  // a sum of twelve uniform numbers is nearly normal
      for (int k = 0; k < 12; ++k) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        sum += static_cast<double>(state >> 33) / 2147483648.0;
      }
      A(i, j) = sum;
    }
  return A.householderQr().householderQ();
}

template <class Qr>
double pivotRatio(const Qr& qr, int rank) {
  const auto R = qr.matrixQR().diagonal().cwiseAbs();
  return R(0) > 0 ? R(rank - 1) / R(0) : 0;
}

/// The ring, degree by degree: row k of by[j] is yⱼ times element k of the basis, as far as known.
class Ring {
 public:
  explicit Ring(const Section& map) {
    for (auto& by_j : by_) by_j.setZero(up_to_4, up_to_4);
    for (int j = 0; j < variable_count; ++j) by_[j](0, up_to_0 + j) = 1;
    addSecond(map);
    addProducts(up_to_1, up_to_2, up_to_3);
    addProducts(up_to_2, up_to_3, up_to_4);
    addProducts(up_to_3, up_to_4, up_to_4);
  }

  const Eigen::MatrixXd& by(int j) const { return by_[j]; }
  double pivot() const { return pivot_; }

 private:
  void addSecond(const Section& map);
  void addProducts(int from, int to, int next);
  Eigen::MatrixXd relations(int below, int from, int to) const;

  std::array<Eigen::MatrixXd, variable_count> by_;
  double pivot_ = 1;
};

/// (b) in monomials of degree two, then y and 1. The monomials √2 yₐy_b and yₐ² rotate with y.
Eigen::MatrixXd quadricRows(const Section& map) {
  static const std::vector<Quadric> quadrics = motionQuadrics();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(quadric_count, monomial_count + up_to_1);
  for (int k = 0; k < quadric_count; ++k) {
    Eigen::Matrix<double, section_count, section_count> S = Eigen::Matrix<double, section_count, section_count>::Zero();
    for (const Term& term : quadrics[k]) S += term.value * map.row(term.i).transpose() * map.row(term.j);
    rows(k, monomial_count) = S(0, 0);
    for (int a = 0; a < variable_count; ++a) {
      rows(k, monomial_count + 1 + a) = S(0, a + 1) + S(a + 1, 0);
      rows(k, pair(a, a)) = S(a + 1, a + 1);
      for (int b = a + 1; b < variable_count; ++b)
        rows(k, pair(a, b)) = (S(a + 1, b + 1) + S(b + 1, a + 1)) / std::sqrt(2.0);
    }
  }
  return rows;
}

/// Solves (d) for E w + K l = 0 with `free` dimensions left: w = [V, null space] [l; c].
Eigen::MatrixXd solveRelations(const Eigen::MatrixXd& E, const Eigen::MatrixXd& K, int free, double& pivot) {
  const Eigen::Index size = E.cols(), rank = size - free;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(E.transpose());
  const double ratio = pivotRatio(qr, static_cast<int>(rank));
  pivot = ratio <= pivot ? ratio : pivot * (ratio > 0);  // 0 if that is NaN
  const Eigen::MatrixXd chosen = (qr.colsPermutation().transpose() * K).topRows(rank);
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(size, K.cols() + free);
  w.topLeftCorner(rank, K.cols()) =
      -qr.matrixQR().topLeftCorner(rank, rank).triangularView<Eigen::Upper>().transpose().solve(chosen);
  w.bottomRightCorner(free, free).setIdentity();
  w.applyOnTheLeft(qr.householderQ());
  return w;
}

void Ring::addSecond(const Section& map) {
  const Eigen::MatrixXd rows = quadricRows(map);
  const Eigen::MatrixXd second = solveRelations(rows.leftCols<monomial_count>(), rows.rightCols<up_to_1>(),
                                                monomial_count - quadric_count, pivot_);
  for (int a = 0; a < variable_count; ++a)
    for (int b = 0; b < variable_count; ++b)
      by_[a].row(up_to_0 + b).head<up_to_2>() = second.row(pair(a, b)) / (a == b ? 1 : std::sqrt(2.0));
}

/// Returns yᵢ(yⱼ f) − yⱼ(yᵢ f) for all j < i and basis elements f in [below, from). The columns are coefficients of the
/// products of basis elements in [from, to) with y₁…y₁₀, then of the basis.
Eigen::MatrixXd Ring::relations(int below, int from, int to) const {
  const int degree = to - from, lower = from - below, products = variable_count * degree;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(variable_count * (variable_count - 1) / 2 * lower, products + to);
  int at = 0;
  for (int i = 0; i < variable_count; ++i)
    for (int j = 0; j < i; ++j, at += lower) {
      const auto f_i = by(i).block(below, 0, lower, to), f_j = by(j).block(below, 0, lower, to);
      rows.block(at, degree * i, lower, degree) += f_j.rightCols(degree);
      rows.block(at, degree * j, lower, degree) -= f_i.rightCols(degree);
      rows.block(at, products, lower, to) =
          f_j.leftCols(from) * by(i).topLeftCorner(from, to) - f_i.leftCols(from) * by(j).topLeftCorner(from, to);
    }
  return rows;
}

/// (c): yⱼ times the basis elements in [from, to), which gives the elements in [to, next).
void Ring::addProducts(int from, int to, int next) {
  const int below = from == up_to_1 ? up_to_0 : from == up_to_2 ? up_to_1 : up_to_2;
  const int degree = to - from, products = variable_count * degree;
  const Eigen::MatrixXd rows = relations(below, from, to);
  const Eigen::MatrixXd w = solveRelations(rows.leftCols(products), rows.rightCols(to), next - to, pivot_);
  for (int j = 0; j < variable_count; ++j) by_[j].block(from, 0, degree, next) = w.middleRows(degree * j, degree);
}

}  // namespace

/// (a)
LegSection legSection(const Legs& legs) {
  Eigen::Matrix<double, coordinate_count, 6> rows;
  for (int k = 0; k < 6; ++k) {
    const Vector3d &a = legs.a[k], &b = legs.b[k];
    rows(at_h, k) = a.squaredNorm() + b.squaredNorm() - legs.d(k) * legs.d(k);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) rows(q(i, j), k) = -2 * a(i) * b(j);
      rows(at_u + i, k) = 2 * b(i);
      rows(at_p + i, k) = -2 * a(i);
    }
    rows(at_r, k) = 1;
  }
  rows.colwise().normalize();
  const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, coordinate_count, 6>> qr(rows);
  const Eigen::Matrix<double, coordinate_count, coordinate_count> all = qr.householderQ();
  return {all.rightCols<section_count>(), pivotRatio(qr, 6)};
}

Multiplication multiplication(const Section& section, int index) {
  Multiplication out;
  out.map = section * chart(index);
  const Ring ring(out.map);
  out.pivot = ring.pivot();
  if (out.pivot > 0) out.M = ring.by(0);
  return out;
}

}  // namespace ursula::ups

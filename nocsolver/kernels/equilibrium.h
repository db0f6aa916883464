#pragma once

// The platform's equilibrium G μ = w, columns of G [Qb × k; k] of the motors' rows, with G⁻¹ besides: tangents of μ are
// G⁻¹ times those of w − G μ at a given μ. Internal; included as leg_slopes.h is.
//
// As in plane_dynamics.h, moments are over a length of the machine, and columns over a size of their rows. Gauss–Jordan
// with partial pivoting (Golub, Van Loan, Matrix Computations, 4th ed., 2013, sect. 3.4): the pivots are those of
// solve6.h.

#include "nocsolver/kernels/leg_slopes.h"

namespace ursula::kernel {

template <class Isa>
class Equilibrium {
 public:
  explicit Equilibrium(double length) : per_length_(1 / length) {
    for (int row = 0; row < 6; ++row) rows_[row][unit + row] = scaleOf(row);
  }

  void setRow(int motor, const Vector3<Value<Isa>>& Qb, const Vector3<Value<Isa>>& k) {
    size_[motor] = 1 / (std::abs(k.x().v) + std::abs(k.y().v) + std::abs(k.z().v));
    const Vector3<Value<Isa>> moment = Qb.cross(k);
    for (int row = 0; row < 3; ++row) {
      rows_[row][motor] = size_[motor] * per_length_ * moment(row).v;
      rows_[3 + row][motor] = size_[motor] * k(row).v;
    }
  }
  void setWrench(const Vector6<Value<Isa>>& w) {
    for (int row = 0; row < 6; ++row) rows_[row][right] = scaleOf(row) * w(row).v;
  }

  /// The smallest pivot over the largest.
  double solve() {
    double least = 0, most = 0;
    for (int k = 0; k < 6; ++k) {
      int largest = k;
      for (int row = k + 1; row < 6; ++row)
        if (std::abs(rows_[order_[row]][k]) > std::abs(rows_[order_[largest]][k])) largest = row;
      const int at = order_[largest];
      order_[largest] = order_[k];
      order_[k] = at;
      const double size = std::abs(rows_[at][k]);
      least = k == 0 || size < least ? size : least;
      most = k == 0 || size > most ? size : most;
      const Row pivot = (1 / rows_[at][k]) * Row::load(rows_[at]);
      pivot.store(rows_[at]);
      for (int row = 0; row < 6; ++row) {
        if (row == at) continue;
        double* other = rows_[row];
        (Row::load(other) - other[k] * pivot).store(other);
      }
    }
    return least / most;
  }

  double mu(int motor) const { return size_[motor] * rows_[order_[motor]][right]; }
  /// Of G⁻¹.
  double inverse(int motor, int row) const { return size_[motor] * rows_[order_[motor]][unit + row]; }

 private:
  using Row = Tangents<Isa, 16>;
  static constexpr int right = 6, unit = 7;
  double scaleOf(int row) const { return row < 3 ? per_length_ : 1; }

  double per_length_, size_[6];
  int order_[6] = {0, 1, 2, 3, 4, 5};
  double rows_[6][16] = {};
};

}  // namespace ursula::kernel

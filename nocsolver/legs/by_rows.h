#pragma once

// Rates and accelerations of a leg's coordinates from its rows of A q̇ = B t_P (22) and their rates. Internal.

#include "nocsolver/legs/plane.h"

namespace ursula::legs {

/// A q̇ = n · v_B, and its derivative A q̈ + Ȧ q̇ = n · a_B + ṅ · v_B.
struct ByRows {
  template <class S>
  static Vector3<S> rates(const LegModel<S>&, const LegState<S>& at, const Vector3<S>& v_B) {
    Vector3<S> out;
    for (int j = 0; j < 3; ++j) {
      const JacobianRow<S>& row = at.row[j];
      out(j) = row.n.dot(v_B) / row.A;
    }
    return out;
  }

  /// The frame moves as `at` does; `rate`, `v_B`, `a_B` may be those of a column of T. Needs the rows' rates.
  template <class S>
  static Vector3<S> accelerations(const LegModel<S>&, const LegState<S>& at, const Vector3<S>& rate,
                                  const Vector3<S>& v_B, const Vector3<S>& a_B) {
    Vector3<S> out;
    for (int j = 0; j < 3; ++j) {
      const JacobianRow<S>& row = at.row[j];
      const S bias = row.n_dot.dot(v_B) - row.A_dot * rate(j);
      out(j) = (row.n.dot(a_B) + bias) / row.A;
    }
    return out;
  }
};

}  // namespace ursula::legs

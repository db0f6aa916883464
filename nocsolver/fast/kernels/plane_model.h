#pragma once

// A leg as the kernels of its plane take it. Internal.

#include "nocsolver/legs/leg_model.h"

namespace ursula::kernel {

template <class S>
struct PlaneModel : LegModel<S> {
  Vector3<S> lift;          ///< −g along F̂
  Matrix3<S> J_1, J_2;      ///< about the links' first ends
  S first_1, first_2;       ///< masses times the distances of their centres
  S per_l, per_s, per_sum;  ///< 1/l, 1/s, 1/(l + s)
  bool rubs, rubs_dry;      ///< has friction, has some that is not viscous
  bool principal;           ///< the links' frames are principal axes
};

}  // namespace ursula::kernel

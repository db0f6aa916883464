#pragma once

// A leg in the form that the kernels of its plane use. Internal.

#include "nocsolver/legs/leg_model.h"

namespace ursula::kernel {

template <class S>
struct PlaneModel : LegModel<S> {
  Vector3<S> lift;          ///< −g along F̂
  Matrix3<S> J_1, J_2;      ///< about the links' first ends
  S first_1, first_2;       ///< masses times the distances of their centres
  S per_l, per_s, per_sum;  ///< 1/l, 1/s, 1/(l + s)
  bool rubs, rubs_dry;      ///< has friction; has Coulomb friction
  bool principal;           ///< the links' frames are principal axes
};

}  // namespace ursula::kernel

#pragma once

// A leg as the kernels of its plane take it. Internal.

#include "nocsolver/chain_state.h"

namespace ursula::kernel {

template <class S>
struct PlaneModel : ChainModel<S> {
  Vector3<S> lift;          ///< −g along F̂
  S per_l, per_s, per_sum;  ///< 1/l, 1/s, 1/(l + s)
  bool rubs, rubs_dry;      ///< has friction, has some that is not viscous
  bool principal;           ///< both links' inertias are about principal axes
};

}  // namespace ursula::kernel

#pragma once

// The requirements on a leg's displacement, in every lane of a pack. Internal; leg_kernels.h handles one pose at a
// time.

#include "parts/fast/fast_dynamics.h"
#include "parts/fast/kernels/pack.h"

namespace ursula::kernel {

// The bounds are constants, because sources for an instruction set may define no function of doubles.
// legs/requirements.h computes the same from the scalar's eps.
constexpr double root_eps = 0x1p-26;      ///< √eps: a smaller sine or lever has no correct digit left
constexpr double least_pivots = 0x1p-48;  ///< 16 eps: least ratio of the smallest to the largest pivot of Bᵀ

/// Keeps the first fault of each lane.
template <class Isa>
class BatchGuard {
 public:
  using P = Pack<Isa>;
  using Mask = typename P::Mask;

  void reach(const P& inside, const P&, const P&) { require(inside >= P(0.0), PoseFault::out_of_reach); }
  void stroke(const P& d, const P& least, const P& most) {
    require((d > least) & (d < most), PoseFault::end_of_stroke);
  }
  void offAxis(const P& r, const P& size) { require(r > root_eps * size, PoseFault::point_on_axis); }
  void regular(const P& sine, const char*) { require(abs(sine) > P(root_eps), PoseFault::stretched_leg); }
  void regularB(const P& pivots) { require(pivots > P(least_pivots), PoseFault::singular_jacobian); }
  /// A PoseFault as a number, 0 if there is none.
  const P& faults() const { return faults_; }
  bool anyFault() const { return xsimd::any(faults_ > P(0.0)); }

 private:
  void require(const Mask& holds, PoseFault fault) {
    if (!xsimd::all(holds))
      faults_ = select(holds | (faults_ > P(0.0)), faults_, P(static_cast<double>(fault)));  // rare
  }
  P faults_ = P(0.0);
};

}  // namespace ursula::kernel

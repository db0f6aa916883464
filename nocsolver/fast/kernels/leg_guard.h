#pragma once

// The requirements on a leg's displacement. Internal. Here a pose is refused by an error; in a batch its lane is
// flagged (batch_guard.h).

#include "nocsolver/legs/requirements.h"

namespace ursula::kernel {

template <class S>
struct LegGuard {
  int leg;
  S t;

  /// `inside` must not be negative; `square` is the square of the distance that the message compares with `bound`.
  void reach(const S& inside, const S& square, const S& bound) const {
    using std::abs;
    using std::sqrt;
    if (!(inside >= S(0))) legs::requireReach(false, leg, t, S(sqrt(square)), S(abs(bound)));
  }
  void stroke(const S& d, const S& least, const S& most) const {
    legs::requireStroke(d > least, leg, t, d, least);
    legs::requireStroke(d < most, leg, t, d, most);
  }
  void offAxis(const S& r, const S& size) const { legs::requireOffAxis(r, size, leg, t); }
  void regular(const S& sine, const char* what) const {
    using std::abs;
    legs::requireRegular(S(abs(sine)), what, leg, t);
  }
};

}  // namespace ursula::kernel

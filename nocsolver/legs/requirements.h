#pragma once

// The requirements on a pose, and the errors that refuse it. Internal.

#include <Eigen/Core>
#include <cmath>

#include "nocsolver/errors.h"

namespace ursula::legs {

template <class S>
void requireReach(bool reaches, int index, const S& t, const S& distance, const S& bound) {
  if (!reaches)
    throw OutOfReach("is out of reach", index, static_cast<double>(t), static_cast<double>(distance),
                     static_cast<double>(bound), " m");
}

template <class S>
void requireStroke(bool within, int index, const S& t, const S& d, const S& bound) {
  if (!within)
    throw OutOfStroke("is at the end of its stroke", index, static_cast<double>(t), static_cast<double>(d),
                      static_cast<double>(bound), " m");
}

/// Below √eps the direction of r consists of rounding errors.
template <class S>
void requireOffAxis(const S& r, const S& size, int index, const S& t) {
  using std::sqrt;
  const S bound = sqrt(Eigen::NumTraits<S>::epsilon()) * size;
  if (!(r > bound))
    throw PointOnAxis("has B on its axis", index, static_cast<double>(t), static_cast<double>(r),
                      static_cast<double>(bound), " m");
}

/// Below √eps the sine has no correct digit left.
template <class S>
void requireRegular(const S& sine, const char* what, int index, const S& t) {
  using std::sqrt;
  const S bound = sqrt(Eigen::NumTraits<S>::epsilon());
  if (!(sine > bound))
    throw StretchedLeg(what, index, static_cast<double>(t), static_cast<double>(sine), static_cast<double>(bound), "");
}

/// `ratio` is the smallest over the largest pivot of Bᵀ, with moment rows divided by a length of the machine. Throws
/// SingularJacobian.
template <class S>
void requireRegularB(const S& ratio, const S& t) {
  const S bound = S(16) * Eigen::NumTraits<S>::epsilon();
  if (!(ratio > bound))
    throw SingularJacobian("B is singular, its smallest pivot over its largest", -1, static_cast<double>(t),
                           static_cast<double>(ratio), static_cast<double>(bound), "");
}

}  // namespace ursula::legs

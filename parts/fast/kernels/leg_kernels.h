#pragma once

// The requirements on a leg's displacement. Internal. Here a pose is refused by an error; in a batch its lane is
// flagged (batch_guard.h).
// The fast kernels of all kinds of legs, each in its file, and their common parts. Internal. A kind has
//   rowOfMap    the non-zero components of the rows of its map
//   place       displacement and map, from AB
//   setRates    rates and accelerations of the coordinates, from B's motion in the axes of the leg's plane
//   linkForces  the links' loads on the coordinates; `base` is −g along x, u, z of the plane
//   offLinks    what mass centres off the links' lines add
//   massMatrix  the partial derivatives of linkForces by the accelerations, in closed form
// legs/ works with angles and noc/ with T: they are the independent references, and tests compare all to rounding.

#include "nocsolver/legs/requirements.h"
#include "parts/fast/kernels/pus_kernel.h"
#include "parts/fast/kernels/rus_kernel.h"
#include "parts/fast/kernels/ups_kernel.h"
#include "parts/fast/kernels/urs_kernel.h"

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

/// (a) of off_line.h.
template <class Kind, class S>
Vector3<S> offLineForces(Kind kind, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  Vector3<S> Q = Vector3<S>::Zero();
  for (const OffLink<S>& link : offLinks<S>(kind, model, base, leg)) {
    const Vector3<S> a_o = link.omega_dot.cross(link.o) + link.omega.cross(link.omega.cross(link.o));
    const Vector3<S> f = link.mass * a_o, n = link.o.cross(Vector3<S>(link.mass * link.b + f));
    Q += link.V.transpose() * f + link.W.transpose() * n;
  }
  return Q;
}

/// (b) of off_line.h.
template <class Kind, class S>
Matrix3<S> offLineMass(Kind kind, const PlaneModel<S>& model, const PlaneLeg<S>& leg) {
  Matrix3<S> M = Matrix3<S>::Zero();
  for (const OffLink<S>& link : offLinks<S>(kind, model, Vector3<S>::Zero(), leg)) {
    Matrix3<S> U;
    for (int j = 0; j < 3; ++j) U.col(j) = Vector3<S>(link.W.col(j)).cross(link.o);
    const Matrix3<S> VU = link.V.transpose() * U;
    M += link.mass * (VU + VU.transpose() + U.transpose() * U);
  }
  return M;
}

}  // namespace ursula::kernel

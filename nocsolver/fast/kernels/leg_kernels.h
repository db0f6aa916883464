#pragma once

// The fast kernels of all kinds of legs, each in its file, and their common parts. Internal. A kind has
//   rowOfMap    the non-zero components of the rows of its map
//   place       displacement and map, from AB
//   setRates    rates and accelerations of the coordinates, from B's motion in the axes of the leg's plane
//   linkForces  the links' loads on the coordinates; `base` is −g along x, u, z of the plane
//   offLinks    what mass centres off the links' lines add
//   massMatrix  the partial derivatives of linkForces by the accelerations, in closed form
// legs/ works with angles and noc/ with T: they are the independent references, and tests compare all to rounding.

#include "nocsolver/fast/kernels/pus_kernel.h"
#include "nocsolver/fast/kernels/rus_kernel.h"
#include "nocsolver/fast/kernels/ups_kernel.h"
#include "nocsolver/fast/kernels/urs_kernel.h"

namespace ursula::kernel {

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

#pragma once

// What the kernels of all kinds of legs share: components along the fixed frame, the plane of a leg, refusals.
// Internal.

#include <Eigen/Geometry>
#include <cmath>

#include "nocsolver/chain_state.h"
#include "nocsolver/errors.h"

namespace ursula::kernel {

/// AB in F̂: k of (13), with r = √(k_x² + k_z²), the distance of B from the line through A along u.
template <class S>
struct InAxes {
  S k_x, k_y, k_z, r;
};

template <class S>
InAxes<S> inAxes(const ChainModel<S>& leg, const Vector3<S>& AB) {
  using std::sqrt;
  InAxes<S> out{leg.x_hat.dot(AB), leg.u.dot(AB), leg.z_hat.dot(AB), S(0)};
  out.r = sqrt(out.k_x * out.k_x + out.k_z * out.k_z);
  return out;
}

/// Axes x and z of F̂R(α), α from its sine and cosine. (1)
template <class S>
struct Plane {
  S sine, cosine;
  Vector3<S> x, z;
};

template <class S>
Plane<S> planeAt(const ChainModel<S>& leg, const S& sine, const S& cosine) {
  return {sine, cosine, cosine * leg.x_hat + sine * leg.z_hat, cosine * leg.z_hat - sine * leg.x_hat};
}

/// Of α = atan2(−k_x, k_z), which holds B at z = r > 0. (14a)
template <class S>
Plane<S> planeOf(const ChainModel<S>& leg, const InAxes<S>& B) {
  return planeAt<S>(leg, -B.k_x / B.r, B.k_z / B.r);
}

template <class S>
void setLinks(const Vector3<S>& x_1, const Vector3<S>& along_1, const Vector3<S>& x_2, const Vector3<S>& along_2,
              ChainState<S>& out) {
  out.x_1 = x_1;
  out.along_1 = along_1;
  out.x_2 = x_2;
  out.along_2 = along_2;
}

/// Frames of (40), ends and mass centres, from the displacement.
template <class S>
void placeLinks(const ChainModel<S>& leg, ChainState<S>& out) {
  out.R_1 << out.x_1, out.along_1.cross(out.x_1), out.along_1;
  out.R_2 << out.x_2, out.along_2.cross(out.x_2), out.along_2;
  out.arm_1 = leg.rho * out.along_1;
  out.arm_2 = leg.sigma * out.along_2;
  out.RB = leg.s * out.along_2;
  out.O_1.setZero();
  out.O_2 = leg.l * out.along_1;
  if (leg.kind == LegKind::UPS) out.O_2 = (out.cosine[2] - leg.s) * out.along_1;
  if (leg.kind == LegKind::PUS) {
    out.R_1 << leg.x_hat, leg.u, leg.z_hat;  // the carriage does not turn
    out.O_1 = out.cosine[0] * leg.u;
    out.O_2 = out.O_1;
  }
}

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

/// Below √eps the direction of r is made of rounding errors.
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

}  // namespace ursula::kernel

#pragma once

#include <array>

#include "model/leg_kind.h"
#include "parts/fast/kernels/machine_model.h"

// A leg in the plane that contains B and turns about −u by α (for RUS the rod's plane, turning by φ + ψ). It computes
// displacement and map, with angles only as sines and cosines. Internal. link_terms.h shows the plane's use. legs/
// computes the same in B from angles, and is the independent reference.
//
// Components are along x, u, z of the plane: from A to B (0, k_y, r), v_B = h and a_B = a. The rows of the map are kⱼ,
// q̇ⱼ = kⱼ · h; each kind's file gives its own.

namespace ursula::kernel {

template <class S>
struct PlaneLeg {
  S cosine, sine;        ///< of α
  S C_1, S_1, C_2, S_2;  ///< directions of the links in the plane; (1, 0) for a carriage, cos ψ, sin ψ for a crank
  S y, z;                ///< from A to B in the plane; for RUS from R
  std::array<Vector3<S>, 3> k;    ///< rows of the map
  std::array<S, 3> lever;         ///< 1/|kⱼ|, or of similar size
  Vector3<S> rate, acceleration;  ///< of the coordinates
  S d;                            ///< for UPS and PUS, m
};

/// Converts components along F̂ to components in the plane.
template <class S>
Vector3<S> toPlane(const PlaneLeg<S>& leg, const Vector3<S>& v) {
  return {leg.cosine * v.x() + leg.sine * v.z(), v.y(), leg.cosine * v.z() - leg.sine * v.x()};
}

template <class S>
void turnToB(const S& k_x, const S& k_z, const S& per_r, PlaneLeg<S>& out) {
  out.sine = -k_x * per_r;
  out.cosine = k_z * per_r;
}

}  // namespace ursula::kernel

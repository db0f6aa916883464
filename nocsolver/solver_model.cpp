#include "nocsolver/solver_model.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "model/real50.h"

namespace ursula {
namespace {

/// (paper, eq. 2a) as it holds for any tilt: x̂ = (u × e_z)/‖·‖, ŷ = u, ẑ = x̂ × u; for an axis along e_z the seed is
/// e_y.
template <class S>
void setFixedFrame(const Vector3d& axis, bool printed, LegModel<S>& leg) {
  using std::sqrt;
  const Vector3<S> u = axis.cast<S>() / sqrt(axis.cast<S>().squaredNorm());
  const Vector3<S> e_z = Vector3<S>::UnitZ();
  // Below this the cross product would be made of rounding errors of uᵢ as it was written.
  const bool along_e_z = u.cross(e_z).squaredNorm() < S(1e-20);
  const Vector3<S> seed = along_e_z ? Vector3<S>::UnitY() : e_z;
  const Vector3<S> x = u.cross(seed);
  leg.y_hat = u;
  leg.x_hat = x / sqrt(x.squaredNorm());
  leg.z_hat = leg.x_hat.cross(u);
  if (printed) {  // (paper, eq. 2b): orthonormal only without tilt
    leg.x_hat = Vector3<S>(u.y(), -u.x(), S(0));
    leg.y_hat = Vector3<S>(u.x(), u.y(), S(0));
    leg.z_hat = e_z;
  }
}

template <class S>
LegModel<S> makeLeg(const Leg& from, bool printed) {
  LegModel<S> leg;
  setFixedFrame(from.base_axis, printed, leg);
  leg.a = from.base_point.cast<S>();
  leg.b = from.platform_point.cast<S>();
  leg.l = S(from.proximal.length);
  leg.s = S(from.distal.length);
  leg.knee = S(from.knee == Knee::positive ? 1 : -1);
  leg.rho = S(from.proximal.center_of_mass);
  leg.sigma = S(from.distal.center_of_mass);
  leg.mass_proximal = S(from.proximal.mass);
  leg.mass_distal = S(from.distal.mass);
  leg.I_proximal = from.proximal.inertia.cast<S>();
  leg.I_distal = from.distal.inertia.cast<S>();
  leg.viscous = {S(from.friction.actuated), S(from.friction.universal), S(from.friction.knee)};
  leg.coulomb = {S(from.coulomb.actuated), S(from.coulomb.universal), S(from.coulomb.knee)};
  leg.coulomb_speed = S(from.coulomb.smoothing_speed);
  return leg;
}

}  // namespace

template <class S>
SolverModel<S>::SolverModel(const Manipulator& manipulator, bool printed_frames)
    : gravity(manipulator.gravity().cast<S>()),
      mass(static_cast<S>(manipulator.platform().mass)),
      rho(manipulator.platform().center_of_mass.cast<S>()),
      I_M(manipulator.platform().inertia.cast<S>()),
      length(0) {
  for (int i = 0; i < leg_count; ++i) {
    LegModel<S>& leg_model = legs[static_cast<std::size_t>(i)];
    leg_model = makeLeg<S>(manipulator.leg(i), printed_frames);
    length = std::max({length, leg_model.b.norm(), leg_model.l, leg_model.s});
  }
}

template struct SolverModel<double>;
template struct SolverModel<float>;
template struct SolverModel<Real50>;

}  // namespace ursula

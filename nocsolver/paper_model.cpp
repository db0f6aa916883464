#include "nocsolver/paper_model.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "model/real50.h"
#include "nocsolver/kernels/fixed_frame.h"

namespace ursula {
namespace {

template <class S>
void setFixedFrame(const Vector3d& axis, bool printed, LegModel<S>& leg) {
  kernel::setFixedFrame<S>(axis, leg.x_hat, leg.y_hat, leg.z_hat);
  if (printed) {  // (paper, eq. 2b): orthonormal only without tilt
    const Vector3<S> u = leg.y_hat;
    leg.x_hat = Vector3<S>(u.y(), -u.x(), S(0));
    leg.y_hat = Vector3<S>(u.x(), u.y(), S(0));
    leg.z_hat = Vector3<S>::UnitZ();
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
  leg.viscous = {S(from.friction.phi), S(from.friction.psi), S(from.friction.theta)};
  leg.coulomb = {S(from.coulomb.phi), S(from.coulomb.psi), S(from.coulomb.theta)};
  leg.coulomb_speed = S(from.coulomb.smoothing_speed);
  return leg;
}

}  // namespace

template <class S>
PaperModel<S>::PaperModel(const Manipulator& manipulator, bool printed_frames)
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

template struct PaperModel<double>;
template struct PaperModel<float>;
template struct PaperModel<Real50>;

}  // namespace ursula

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "model/real50.h"
#include "nocsolver/chain_solver.h"
#include "nocsolver/kernels/fixed_frame.h"

namespace ursula {
namespace {

template <class S>
ChainModel<S> modelOf(const Leg& from) {
  ChainModel<S> leg;
  leg.kind = from.kind;
  kernel::setFixedFrame<S>(from.base_axis, leg.x_hat, leg.u, leg.z_hat);
  leg.a = from.base_point.cast<S>();
  leg.b = from.platform_point.cast<S>();
  leg.l = S(from.proximal.length);
  leg.s = S(from.distal.length);
  leg.knee = S(from.knee == Knee::positive ? 1 : -1);
  leg.rho = S(from.proximal.center_of_mass);
  leg.sigma = S(from.distal.center_of_mass);
  leg.mass_1 = S(from.proximal.mass);
  leg.mass_2 = S(from.distal.mass);
  leg.I_1 = from.proximal.inertia.cast<S>();
  leg.I_2 = from.distal.inertia.cast<S>();
  for (std::size_t j = 0; j < 3; ++j) {
    const Coordinate coordinate = rowOf(from.kind).coordinates[j];
    leg.viscous[j] = S(from.friction.on(coordinate));
    leg.coulomb[j] = S(from.coulomb.on(coordinate));
    leg.speed[j] = S(from.coulomb.speedOf(coordinate));
  }
  leg.motor.fill(-1);
  return leg;
}

}  // namespace

template <class S, class R>
ChainSolver<S, R>::ChainSolver(const Manipulator& manipulator, R reading)
    : leg_count_(manipulator.legCount()),
      motors_(manipulator.motors()),
      gravity_(manipulator.gravity().cast<S>()),
      mass_(static_cast<S>(manipulator.platform().mass)),
      rho_(manipulator.platform().center_of_mass.cast<S>()),
      I_M_(manipulator.platform().inertia.cast<S>()),
      length_(0),
      reading_(std::move(reading)) {
  for (int i = 0; i < leg_count_; ++i) {
    ChainModel<S>& leg = legs_[static_cast<std::size_t>(i)];
    leg = modelOf<S>(manipulator.leg(i));
    length_ = std::max({length_, S(leg.b.norm()), leg.l, leg.s});
  }
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = motors_[static_cast<std::size_t>(m)];
    legs_[static_cast<std::size_t>(motor.leg)].motor[static_cast<std::size_t>(motor.joint)] = m;
  }
}

template ChainSolver<double>::ChainSolver(const Manipulator&, Corrected);
template ChainSolver<float>::ChainSolver(const Manipulator&, Corrected);
template ChainSolver<Real50>::ChainSolver(const Manipulator&, Corrected);
template ChainSolver<double, SpoiltChain>::ChainSolver(const Manipulator&, SpoiltChain);

}  // namespace ursula

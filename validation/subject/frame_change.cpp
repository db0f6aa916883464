#include "validation/subject/frame_change.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <utility>

#include "base/real50.h"

namespace ursula {
namespace {

Matrix3d turnedTensor(const Matrix3d& R, const Matrix3d& I) {
  const Matrix3d out = R * I * R.transpose();
  return (out + out.transpose()) / 2;  // symmetric to the last bit, like a machine's tensors
}

void rescale(Link& link, const Units& units) {
  link.length /= units.length;
  link.center_of_mass /= units.length;
  link.off_line /= units.length;
  link.mass /= units.mass;
  link.inertia /= units.mass * units.length * units.length;
}

void rescale(JointFriction& friction, double turning, double sliding) {
  friction.phi /= turning;
  friction.psi /= turning;
  friction.theta /= turning;
  friction.d /= sliding;
}

}  // namespace

double Units::sizeOf(const std::string& unit) const {
  const std::pair<const char*, double> known[] = {
      {"", 1},
      {"1", 1},
      {"rad", 1},
      {"s", time},
      {"1/s", 1 / time},
      {"rad/s", 1 / time},
      {"rad_s", 1 / time},
      {"rad/s^2", 1 / (time * time)},
      {"rad_s2", 1 / (time * time)},
      {"m", length},
      {"m/s", velocity()},
      {"m_s", velocity()},
      {"m/s^2", acceleration()},
      {"m_s2", acceleration()},
      {"N", force()},
      {"N m", torque()},
      {"Nm", torque()},
      {"J", torque()},
      {"kg", mass},
  };
  for (const auto& [text, size] : known)
    if (unit == text) return size;
  throw std::invalid_argument("no such unit: " + unit);
}

Efforts effortsOf(const Manipulator& machine) {
  const Motors& motors = machine.motors();
  Efforts out;
  if (allSlide(motors)) out.unit = "N";
  for (std::size_t k = 0; k < motors.size(); ++k) out.leg[k] = motors[k].leg;
  return out;
}

FrameChange::FrameChange(const Manipulator& machine) : legs(machine.legCount()) {
  for (std::size_t k = 0; k < slides.size(); ++k) slides[k] = machine.motors()[k].slides();
}

void FrameChange::relabel(const Manipulator& machine, const PerLeg<int>& to) {
  leg = to;
  std::size_t there = 0;
  for (int i = 0; i < machine.legCount(); ++i)
    for (int k = 0; k < motor_count; ++k)
      if (machine.motors()[k].leg == leg[i]) motor[there++] = k;
}

Manipulator FrameChange::transformed(const Manipulator& machine) const {
  ManipulatorParameters out = machine.parameters();
  const double inertia = units.mass * units.length * units.length;
  out.gravity = turn * out.gravity / units.acceleration();
  out.platform.mass /= units.mass;
  out.platform.center_of_mass = platform_turn.transpose() * out.platform.center_of_mass / units.length;
  if (platform_turn != Matrix3d::Identity())
    out.platform.inertia = turnedTensor(platform_turn.transpose(), out.platform.inertia);
  out.platform.inertia /= inertia;
  for (int i = 0; i < legs; ++i) {
    Leg& to = out.legs[i];
    to = machine.leg(leg[i]);
    to.base_point = turn * (to.base_point - origin) / units.length;
    to.base_axis = turn * to.base_axis;
    to.platform_point = platform_turn.transpose() * to.platform_point / units.length;
    rescale(to.proximal, units);
    rescale(to.distal, units);
    rescale(to.friction, units.torque() * units.time, units.force() / units.velocity());
    rescale(to.coulomb, units.torque(), units.force());
    rescale(to.rotor_inertia, inertia, units.mass);
    to.coulomb.smoothing_speed *= units.time;
    to.coulomb.sliding_speed /= units.velocity();
  }
  return Manipulator(out);
}

template <class S>
Motion<S> FrameChange::transformed(const Motion<S>& motion) const {
  const Matrix3<S> R = turn.cast<S>();
  const S time = units.time;
  Motion<S> out;
  out.t = motion.t / time;
  out.p = R * (motion.p - origin.cast<S>()) / S(units.length);
  out.Q = R * motion.Q * platform_turn.cast<S>();
  out.omega = R * motion.omega * time;
  out.p_dot = R * motion.p_dot / S(units.velocity());
  out.omega_dot = R * motion.omega_dot * S(time * time);
  out.p_ddot = R * motion.p_ddot / S(units.acceleration());
  return out;
}
template Motion<double> FrameChange::transformed(const Motion<double>&) const;
template Motion<Real50> FrameChange::transformed(const Motion<Real50>&) const;

std::shared_ptr<const Load> FrameChange::transformed(const std::shared_ptr<const Load>& load) const {
  if (!load) return nullptr;
  auto out = std::make_shared<Load>(*load);
  const Matrix3d R = load->frame == Load::Frame::base ? turn : Matrix3d(platform_turn.transpose());
  const auto present = [&](Vector3d& force, Vector3d& moment) {
    force = R * force / units.force();
    moment = R * moment / units.torque();
  };
  out->point = platform_turn.transpose() * load->point / units.length;
  present(out->force, out->moment);
  if (load->history) {
    Matrix6d map = Matrix6d::Zero();
    map.topLeftCorner<3, 3>() = R / units.force();
    map.bottomRightCorner<3, 3>() = R / units.torque();
    out->history = std::make_shared<const LoadHistory>(*load->history, map, units.time);
  }
  return out;
}

Vector6d FrameChange::transformed(const Vector6d& torques) const {
  Vector6d out;
  for (int k = 0; k < motor_count; ++k) out(k) = torques(motor[k]) / effort(motor[k]);
  return out;
}

Vector6d FrameChange::torquesBack(const Vector6d& torques) const {
  Vector6d out;
  for (int k = 0; k < motor_count; ++k) out(motor[k]) = torques(k) * effort(motor[k]);
  return out;
}

BodyMotions<double> FrameChange::back(const BodyMotions<double>& bodies) const {
  const Matrix3d R = turn.transpose();
  BodyMotions<double> out;
  for (int b = 0; b < body_count; ++b) {
    const bool is_platform = b == 2 * leg_count;
    const int here = is_platform ? b : b < leg_count ? leg[b] : leg_count + leg[b - leg_count];
    if (!is_platform && b % leg_count >= legs) continue;
    const BodyMotion<double>& from = bodies[b];
    BodyMotion<double>& to = out[here];
    to.c = R * from.c * units.length + origin;
    to.R = R * from.R;
    if (is_platform) to.R = (to.R * platform_turn.transpose()).eval();
    to.twist << R * from.twist.head<3>() / units.time, R * from.twist.tail<3>() * units.velocity();
    to.twist_rate << R * from.twist_rate.head<3>() / (units.time * units.time),
        R * from.twist_rate.tail<3>() * units.acceleration();
  }
  return out;
}

JointMotion FrameChange::back(const JointMotion& joints) const {
  JointMotion out;
  const auto copy = [this](const JointVariables<double>& from, JointVariables<double>& to, double unit) {
    for (int i = 0; i < legs; ++i) {
      to.phi(leg[i]) = from.phi(i) * unit;
      to.psi(leg[i]) = from.psi(i) * unit;
      to.theta(leg[i]) = from.theta(i) * unit;
      to.d(leg[i]) = from.d(i) * unit * units.length;
    }
  };
  copy(joints.q, out.q, 1);
  copy(joints.q_dot, out.q_dot, 1 / units.time);
  copy(joints.q_ddot, out.q_ddot, 1 / (units.time * units.time));
  return out;
}

Matrix6d shapingBack(const FrameChange& p, const Matrix6d& T) {
  Matrix6d out;
  for (int k = 0; k < motor_count; ++k) {
    const int here = p.motor[k];
    out.col(here) << p.turn.transpose() * T.col(k).head<3>(), p.turn.transpose() * T.col(k).tail<3>() * p.units.length;
    if (p.slides[here]) out.col(here) /= p.units.length;
  }
  return out;
}

Reactions FrameChange::back(const Reactions& reactions) const {
  const Matrix3d R = turn.transpose();
  Reactions out;
  for (int i = 0; i < legs; ++i) {
    const LegReactions& from = reactions[i];
    out[leg[i]] = {R * from.f_A * units.force(), R * from.n_A * units.torque(), R * from.f_R * units.force(),
                   R * from.n_R * units.torque(), R * from.f_B * units.force()};
  }
  return out;
}

}  // namespace ursula

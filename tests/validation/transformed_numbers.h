#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "model/joint_variables.h"
#include "model/load.h"
#include "model/manipulator.h"
#include "model/motion.h"
#include "validation/subject/frame_change.h"

namespace ursula {

/// The inverse of `p`: inverse(p).transformed(p.transformed(x)) is x.
inline FrameChange inverse(const FrameChange& p) {
  FrameChange out;
  out.turn = p.turn.transpose();
  out.origin = -(p.turn * p.origin) / p.units.length;
  out.platform_turn = p.platform_turn.transpose();
  for (int i = 0; i < leg_count; ++i) out.leg[static_cast<std::size_t>(p.leg[static_cast<std::size_t>(i)])] = i;
  out.units = {1 / p.units.length, 1 / p.units.mass, 1 / p.units.time};
  return out;
}

/// Numbers in groups of one kind each, a vector or a tensor.
class Numbers {
 public:
  void add(double x) { groups_.push_back({x}); }
  template <class Derived>
  void add(const Eigen::MatrixBase<Derived>& x) {
    const auto value = x.eval();
    groups_.emplace_back(value.data(), value.data() + value.size());
  }

  /// The largest distance of two groups over the size of the group; infinite if only one is zero.
  double distance(const Numbers& other) const {
    if (groups_.size() != other.groups_.size()) return std::numeric_limits<double>::infinity();
    double largest = 0;
    for (std::size_t k = 0; k < groups_.size(); ++k) {
      double size = 0, difference = 0;
      for (std::size_t j = 0; j < groups_[k].size(); ++j) {
        size = std::hypot(size, groups_[k][j]);
        difference = std::hypot(difference, groups_[k][j] - other.groups_[k][j]);
      }
      if (difference > 0 || std::isnan(difference)) largest = std::max(largest, difference / size);
      if (std::isnan(difference)) return difference;
    }
    return largest;
  }
  bool operator==(const Numbers& other) const { return groups_ == other.groups_; }
  std::size_t size() const { return groups_.size(); }

 private:
  std::vector<std::vector<double>> groups_;
};

inline void addLink(const Link& link, Numbers& out) {
  out.add(link.length);
  out.add(link.mass);
  out.add(link.center_of_mass);
  out.add(link.inertia);
}

inline Numbers numbersOf(const Manipulator& machine) {
  Numbers out;
  out.add(machine.gravity());
  out.add(machine.platform().mass);
  out.add(machine.platform().center_of_mass);
  out.add(machine.platform().inertia);
  for (const Leg& leg : machine.parameters().legs) {
    for (const Vector3d& v : {leg.base_point, leg.base_axis, leg.platform_point}) out.add(v);
    addLink(leg.proximal, out);
    addLink(leg.distal, out);
    out.add(leg.knee == Knee::positive ? 1.0 : -1.0);
    for (const JointFriction* friction : {&leg.friction, static_cast<const JointFriction*>(&leg.coulomb)})
      for (double x : {friction->phi, friction->psi, friction->theta, friction->d}) out.add(x);
    out.add(leg.coulomb.smoothing_speed);
  }
  return out;
}

inline Numbers numbersOf(const Motion<double>& motion) {
  Numbers out;
  out.add(motion.t);
  out.add(motion.Q);
  for (const Vector3d& v : {motion.p, motion.omega, motion.p_dot, motion.omega_dot, motion.p_ddot}) out.add(v);
  return out;
}

inline Numbers numbersOf(const Vector6d& torques) {
  Numbers out;
  out.add(torques);
  return out;
}

inline Numbers numbersOf(const JointMotion& joints) {
  Numbers out;
  for (const JointVariables<double>* q : {&joints.q, &joints.q_dot, &joints.q_ddot})
    for (const Vector6d* v : {&q->phi, &q->psi, &q->theta}) out.add(*v);
  return out;
}

inline Numbers numbersOf(const BodyMotions<double>& bodies) {
  Numbers out;
  for (const BodyMotion<double>& body : bodies) {
    out.add(body.c);
    out.add(body.R);
    for (const Vector6d* twist : {&body.twist, &body.twist_rate}) {
      out.add(twist->head<3>());
      out.add(twist->tail<3>());
    }
  }
  return out;
}

inline Numbers numbersOf(const Reactions& reactions) {
  Numbers out;
  for (const LegReactions& leg : reactions)
    for (const Vector3d& v : {leg.f_A, leg.n_A, leg.f_R, leg.n_R, leg.f_B}) out.add(v);
  return out;
}

inline Numbers numbersOf(const Load& load) {
  Numbers out;
  for (const Vector3d& v : {load.force, load.moment, load.point}) out.add(v);
  out.add(load.frame == Load::Frame::base ? 1.0 : -1.0);
  if (load.history)
    for (const TimedWrench& row : load.history->rows()) {
      out.add(row.time);
      out.add(row.wrench.force);
      out.add(row.wrench.moment);
    }
  return out;
}

}  // namespace ursula

#pragma once

// Section 3 of the paper: the bodies and their twists (39)–(43).

#include <Eigen/Geometry>

#include "nocsolver/noc/section_2.h"

namespace ursula {

namespace legs {

constexpr int platform = 2 * leg_count;

template <class Of>
auto block(Of& of, int body) {
  return of.template middleRows<6>(6 * body);
}

/// The velocity of a point at `arm` from P for a twist [ω; v] at P.
template <class S>
Vector3<S> velocityOf(const Vector6<S>& twist, const Vector3<S>& arm) {
  return twist.template tail<3>() + Vector3<S>(twist.template head<3>()).cross(arm);
}

}  // namespace legs

template <class S>
LinkMotions<S> Noc<S>::onLines(int i, const LegState<S>& at, const Vector3<S>& rate, const Vector3<S>& acceleration,
                               bool with_rates) const {
  const LegModel<S>& leg = machine_.legs[i];
  return legs::withLeg(leg.kind, [&](auto kind) {
    return with_rates ? kind.links(leg, at, rate, acceleration)
                      : kind.template links<false>(leg, at, rate, acceleration);
  });
}

template <class S>
LinkMotions<S> Noc<S>::links(int i, const LegState<S>& at, const Vector3<S>& rate, const Vector3<S>& acceleration,
                             bool with_rates) const {
  LinkMotions<S> out = onLines(i, at, rate, acceleration, with_rates);
  if (machine_.legs[i].off_line) addOffLine(i, at, out);
  return out;
}

/// Moves twists from the points on the links' lines to the mass centres. It is bilinear like the links of each kind:
/// `links` may hold ω of a column of T. The frame moves as `at` does.
template <class S>
void Noc<S>::addOffLine(int i, const LegState<S>& at, LinkMotions<S>& links) const {
  const LegModel<S>& leg = machine_.legs[i];
  const LinkMotions<S> now = onLines(i, at, at.rate, Vector3<S>(Vector3<S>::Zero()), false);
  const auto add = [](const Vector3<S>& off, const Vector3<S>& omega_now, LinkMotion<S>& link) {
    link.c_dot += link.omega.cross(off);
    link.c_ddot += link.omega_dot.cross(off);
    link.c_ddot += link.omega.cross(omega_now.cross(off));
  };
  add(at.R_1 * leg.off_1, now.proximal.omega, links.proximal);
  add(at.R_2 * leg.off_2, now.distal.omega, links.distal);
}

template <class S>
Vector3<S> Noc<S>::platformArm(const Motion<S>& motion) const {
  return motion.Q * machine_.rho;
}

/// Q(bᵢ − ρ) of (47) is taken from P by this arm.
template <class S>
Vector3<S> Noc<S>::columnArm(const Motion<S>& motion) const {
  return platformArm(motion);
}

template <class S>
void Noc<S>::bodyMotions(const Motion<S>& motion, const NocWorkspace<S>& work, BodyMotions<S>& bodies) const {
  bodies = BodyMotions<S>();
  for (int i = 0; i < machine_.legs_in_all; ++i) {
    const LegModel<S>& leg = machine_.legs[i];
    const LegState<S>& at = work.legs[i];
    const LinkMotions<S> now = links(i, at, at.rate, at.acceleration, true);
    const auto set = [&](BodyMotion<S>& body, const Vector3<S>& c, const Matrix3<S>& frame, const LinkMotion<S>& link) {
      body.c = leg.a + c;  // (paper, eqs. 39a, 39b)
      body.R = frame;
      body.twist << link.omega, link.c_dot;
      body.twist_rate << link.omega_dot, link.c_ddot;
    };
    set(bodies[i], at.O_1 + at.arm_1, at.R_1, now.proximal);
    set(bodies[leg_count + i], at.O_2 + at.arm_2, at.R_2, now.distal);
    if (!leg.off_line) continue;
    bodies[i].c += at.R_1 * leg.off_1;
    bodies[leg_count + i].c += at.R_2 * leg.off_2;
  }
  const Vector3<S> arm = platformArm(motion), across = motion.omega.cross(arm);
  BodyMotion<S>& body = bodies[legs::platform];
  body.c = motion.p + arm;  // (paper, eq. 39c)
  body.R = motion.Q;
  body.twist << motion.omega, motion.p_dot + across;  // (paper, eq. 41c)
  Vector3<S> c_ddot = motion.p_ddot + motion.omega_dot.cross(arm);
  c_ddot += motion.omega.cross(across);
  body.twist_rate << motion.omega_dot, c_ddot;  // (paper, eq. 43c)
}

}  // namespace ursula

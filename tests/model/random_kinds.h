#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "model/load.h"
#include "model/manipulator.h"
#include "model/motion.h"
#include "tests/support/motions.h"

namespace ursula {

/// A machine with legs of the given kinds that reach at the motion; everything else is random.
struct KindCase {
  ManipulatorParameters machine;
  Motion<double> motion;
  std::shared_ptr<Load> load = std::make_shared<Load>();
};

/// A full tensor within the triangle inequality, as a body of positive density has it.
inline Matrix3d thrownInertia(SeededDraws& dice, double size) {
  Matrix3d second = Matrix3d::Zero();
  for (int k = 0; k < 4; ++k) {
    const Vector3d at = dice.vector(1);
    second += at * at.transpose();
  }
  const Matrix3d inertia = size * (second.trace() * Matrix3d::Identity() - second);
  return (inertia + inertia.transpose()) / 2;
}

inline Link thrownLink(SeededDraws& dice, double length) {
  return {length, dice.between(5, 25), dice.between(-0.2, 0.8) * length, thrownInertia(dice, dice.between(0.5, 2))};
}

inline void throwFriction(SeededDraws& dice, Leg& leg) {
  for (const Coordinate coordinate : rowOf(leg.kind).coordinates) {
    leg.friction.on(coordinate) = dice.between(5, 40);
    leg.coulomb.on(coordinate) = dice.between(5, 40);
  }
  leg.coulomb.smoothing_speed = dice.between(0.1, 0.5);
  leg.coulomb.sliding_speed = dice.between(0.1, 0.5);
}

/// Draws lengths that span AB, well inside the leg's reach.
inline void throwLengths(SeededDraws& dice, const Vector3d& AB, Leg& leg) {
  const double q = AB.norm(), along = leg.base_axis.normalized().dot(AB), r = std::sqrt(q * q - along * along);
  double l = dice.between(0.6, 0.9) * q, s = dice.between(0.6, 0.9) * q;
  if (leg.kind == LegKind::UPS) {
    s = dice.between(0.3, 0.8) * q, l = dice.between(0.4, 0.9) * q;
    l = std::max(l, 1.2 * (q - s));
  } else if (leg.kind == LegKind::RUS) {
    const double c = dice.between(0.6, 0.9) * r;
    l = dice.between(0.6, 0.9) * r, s = std::sqrt(c * c + along * along);
  } else if (leg.kind == LegKind::PUS) {
    s = r / dice.between(0.5, 0.9);
  }
  leg.proximal = thrownLink(dice, l);
  leg.distal = thrownLink(dice, s);
}

inline Leg thrownLeg(SeededDraws& dice, LegKind kind, double around, const Motion<double>& motion) {
  Leg leg;
  leg.kind = kind;
  leg.knee = dice.between(0, 1) < 0.5 ? Knee::negative : Knee::positive;
  const Vector3d outwards(std::cos(around), std::sin(around), 0);
  leg.base_point = dice.between(1.2, 1.8) * outwards + dice.vector(0.1);
  leg.platform_point = dice.between(0.6, 1) * outwards + dice.vector(0.1);
  const Vector3d AB = motion.p + motion.Q * leg.platform_point - leg.base_point;
  do leg.base_axis = dice.vector(1);
  while (leg.base_axis.norm() < 0.3 || leg.base_axis.normalized().cross(AB.normalized()).norm() < 0.5);
  throwLengths(dice, AB, leg);
  throwFriction(dice, leg);
  return leg;
}

/// Draws a motor on each leg, and the rest anywhere.
inline void throwMotors(SeededDraws& dice, std::vector<Leg>& legs) {
  const auto one_more = [&](Leg& leg) {
    bool& driven = leg.actuated[static_cast<std::size_t>(dice.between(0, 3))];
    const bool fresh = !driven;
    driven = true;
    return fresh;
  };
  for (Leg& leg : legs) leg.actuated.fill(false), one_more(leg);
  for (std::size_t motors = legs.size(); motors < motor_count;)
    if (one_more(legs[static_cast<std::size_t>(dice.between(0, static_cast<double>(legs.size())))])) ++motors;
}

/// Adds rotors, mass centres off the links' lines, and thin rods to every other machine, after everything else is
/// drawn.
inline void throwAdded(SeededDraws& dice, std::vector<Leg>& legs) {
  if (dice.between(0, 1) < 0.5) return;
  for (Leg& leg : legs) {
    for (std::size_t j = 0; j < 3; ++j)
      if (leg.actuated[j]) leg.rotor_inertia.on(rowOf(leg.kind).coordinates[j]) = dice.between(1, 30);
    for (Link* link : {&leg.proximal, &leg.distal}) {
      const bool carriage = link == &leg.proximal && leg.kind == LegKind::PUS;
      link->off_line = dice.vector(0.2);
      link->off_line(carriage ? 1 : 2) = 0;
      const double moment = dice.between(1, 3);
      if (!carriage && dice.between(0, 1) < 0.3) link->inertia = Vector3d(moment, moment, 0).asDiagonal();
    }
  }
}

inline KindCase thrownCase(SeededDraws& dice, const std::vector<LegKind>& kinds) {
  KindCase out;
  Motion<double>& motion = out.motion;
  motion.t = 0.5;
  motion.p = Vector3d(0, 0, dice.between(0.8, 1.2)) + dice.vector(0.2);
  const Vector3d turn = dice.vector(0.3);
  motion.Q = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  motion.omega = dice.vector(1), motion.omega_dot = dice.vector(2);
  motion.p_dot = dice.vector(1), motion.p_ddot = dice.vector(2);
  out.machine.gravity = Vector3d(0, 0, -9.81) + dice.vector(1);
  out.machine.platform = {dice.between(200, 400), dice.vector(0.3), thrownInertia(dice, 50)};
  out.machine.legs.clear();
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const double around = 6.28 * (static_cast<double>(i) + dice.between(-0.2, 0.2)) / static_cast<double>(kinds.size());
    out.machine.legs.push_back(thrownLeg(dice, kinds[i], around, motion));
  }
  throwMotors(dice, out.machine.legs);
  out.load->force = dice.vector(500), out.load->moment = dice.vector(60), out.load->point = dice.vector(0.3);
  out.load->frame = dice.between(0, 1) < 0.5 ? Load::Frame::base : Load::Frame::platform;
  throwAdded(dice, out.machine.legs);
  return out;
}

}  // namespace ursula

#include "validation/limits/moved_inputs.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <random>

namespace ursula {

void Mover::operator()(double& number) const {
  std::uint64_t bits = 0;
  const double size = std::abs(number);
  std::memcpy(&bits, &size, sizeof bits);
  std::minstd_rand draw(static_cast<unsigned>(std::hash<std::uint64_t>()(bits) % 1000000007U) + seed_);
  draw.discard(2);
  number *= 1 + ((draw() & 1U) != 0 ? 1 : -1) * Eigen::NumTraits<double>::epsilon();
}

Motion<double> moved(Motion<double> motion, unsigned seed) {
  const Mover move(seed);
  for (Vector3d* vector : {&motion.p, &motion.omega, &motion.p_dot, &motion.omega_dot, &motion.p_ddot}) move(*vector);
  for (int k = 0; k < 3; ++k) {
    Vector3d axis = motion.Q.col(k);
    move(axis);
    motion.Q.col(k) = axis;
  }
  return motion;
}

Manipulator moved(const Manipulator& machine, unsigned seed) {
  const Mover move(seed);
  ManipulatorParameters out = machine.parameters();
  for (Vector3d* vector : {&out.gravity, &out.platform.center_of_mass}) move(*vector);
  move(out.platform.mass);
  move(out.platform.inertia);
  for (Leg& leg : out.legs) {
    for (Vector3d* vector : {&leg.base_point, &leg.base_axis, &leg.platform_point}) move(*vector);
    for (Link* link : {&leg.proximal, &leg.distal}) {
      for (double* number : {&link->length, &link->mass, &link->center_of_mass}) move(*number);
      move(link->inertia);
      move(link->off_line);
    }
    for (PerCoordinate* each : {&leg.friction, static_cast<PerCoordinate*>(&leg.coulomb), &leg.rotor_inertia})
      for (double* number : {&each->phi, &each->psi, &each->theta, &each->d}) move(*number);
    for (double* speed : {&leg.coulomb.smoothing_speed, &leg.coulomb.sliding_speed}) move(*speed);
  }
  return Manipulator(out);
}

Scenario moved(Scenario scenario, unsigned seed) {
  scenario.manipulator = std::make_shared<const Manipulator>(moved(*scenario.manipulator, seed));
  return scenario;
}

}  // namespace ursula

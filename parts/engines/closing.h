#pragma once

#include "model/manipulator.h"
#include "model/open_tree.h"

namespace ursula {

// Every engine's loops are closed alike, leg by leg. With N = J⁻¹P of each leg, u = [N; 1] u_P satisfies the
// constraints. [N; 1]ᵀ removes the multipliers from the forces (García de Jalón and Bayo, Kinematic and Dynamic
// Simulation of Multibody Systems, 1994, sect. 5.3), and six equations are left. These functions allocate nothing.

/// Returns `of(motor)` for each motor.
template <class Of>
Vector6d forMotors(const Manipulator& manipulator, const Of& of) {
  Vector6d out;
  for (int m = 0; m < motor_count; ++m) out(m) = of(manipulator.motors()[m]);
  return out;
}

/// Returns the motors' efforts that balance the tree's forces with closed loops; N·m or N, in motor order.
Vector6d closedEfforts(const OpenTree& tree, const Manipulator& manipulator);

/// Returns the motors' efforts with the loops left open. This is a usual mistake.
Vector6d openEfforts(const OpenTree& tree, const Manipulator& manipulator);

/// Returns the motors' share of the smallest forces on all coordinates, as a pseudoinverse gives them. This is a usual
/// mistake. They depend on the engine's choice of the platform's speeds.
Vector6d leastEfforts(const OpenTree& tree, const Manipulator& manipulator);

/// Returns the platform's displacement, in the coordinates of its speeds, that closes `gaps` (m, leg's point minus
/// platform's) while the motors stand still.
Vector6d displacement(const OpenTree& tree, const PerLeg<Vector3d>& gaps, const Manipulator& manipulator);

}  // namespace ursula

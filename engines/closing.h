#pragma once

#include "engines/open_tree.h"
#include "model/manipulator.h"

namespace ursula {

// Every engine's loops are closed alike, leg by leg. With N = J⁻¹P of each leg u = [N; 1] u_P satisfies the
// constraints, and [N; 1]ᵀ frees the forces of multipliers (García de Jalón and Bayo, Kinematic and Dynamic Simulation
// of Multibody Systems, 1994, sect. 5.3): six equations are left. Nothing is allocated.

/// Efforts for the forces that a tree needs.
Vector6d closedEfforts(const OpenTree& tree, const Manipulator& manipulator);

/// A usual mistake: what moves the legs alone, their loops open.
Vector6d openEfforts(const OpenTree& tree, const Manipulator& manipulator);

/// A usual mistake: the smallest forces on all coordinates, as a pseudoinverse gives, read at the motors. They depend
/// on the platform's speeds that the engine has.
Vector6d leastEfforts(const OpenTree& tree, const Manipulator& manipulator);

/// How the platform moves, in its speeds, where each leg's point moves by `gaps` off the platform's, the motors at
/// rest.
Vector6d displacement(const OpenTree& tree, const std::array<Vector3d, leg_count>& gaps,
                      const Manipulator& manipulator);

/// Rates of the platform's speeds under efforts.
Vector6d closedRates(const OpenTree& tree, const OpenTreeMasses& masses, const Manipulator& manipulator,
                     const Vector6d& efforts);

/// What the platform's rates change by, at most and to first order, where of the acceleration at which each gap would
/// open without its constraint a part is left.
Vector6d changeOfRates(const OpenTree& tree, const OpenTreeMasses& masses, const Manipulator& manipulator,
                       const Vector6d& efforts, double part);

}  // namespace ursula

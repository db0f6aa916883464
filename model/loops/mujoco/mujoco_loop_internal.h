#pragma once

#include <mujoco/mujoco.h>

#include <memory>

#include "model/manipulator.h"

namespace ursula::mujoco {

static_assert(sizeof(mjtNum) == sizeof(double), "MuJoCo may be built for single precision");

struct Delete {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using Model = std::unique_ptr<mjModel, Delete>;
using Data = std::unique_ptr<mjData, Delete>;

// Where things stand in the model: leg after leg, then the platform.
constexpr int joints_per_leg = 3, leg_dofs = joints_per_leg * leg_count, dofs = leg_dofs + 6;
constexpr int proximalBody(int leg) { return 1 + 2 * leg; }
constexpr int distalBody(int leg) { return 2 + 2 * leg; }
constexpr int platform_body = 1 + 2 * leg_count;
constexpr int siteOnLeg(int leg) { return leg; }
constexpr int siteOnPlatform(int leg) { return leg_count + leg; }

/// The frame of the universal joint at angles zero: columns x, e × x, e with e = u, any x across it.
Matrix3d universalFrame(const Leg& leg);

/// Hinges φ (about −u), ψ and θ (about x) of each leg and the platform free, with its body's origin in its mass centre;
/// positions in B less `origin`. A site at Bᵢ on either side of each open loop.
Model buildModel(const Manipulator& manipulator, const Vector3d& origin);

}  // namespace ursula::mujoco

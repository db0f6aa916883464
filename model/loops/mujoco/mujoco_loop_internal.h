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
constexpr int joints_per_leg = 3;
constexpr int legDofs(int legs) { return joints_per_leg * legs; }
constexpr int dofsOf(int legs) { return legDofs(legs) + 6; }
constexpr int proximalBody(int leg) { return 1 + 2 * leg; }
constexpr int distalBody(int leg) { return 2 + 2 * leg; }
constexpr int platformBody(int legs) { return 1 + 2 * legs; }
constexpr int siteOnLeg(int leg) { return leg; }
constexpr int siteOnPlatform(int legs, int leg) { return legs + leg; }
constexpr int dofOf(int leg, int joint) { return joints_per_leg * leg + joint; }

/// The frame of the proximal link at coordinates zero. With a universal joint at the base: columns x, e × x, e with
/// e = u, any x across it; else the kinds' fixed frame [x̂, û, ẑ].
Matrix3d frameAtZero(const Leg& leg);

/// The joints of each leg in the order of its coordinates and the platform free, with its body's origin in its mass
/// centre; positions in B less `origin`. A site at Bᵢ on either side of each open loop.
Model buildModel(const Manipulator& manipulator, const Vector3d& origin);

}  // namespace ursula::mujoco

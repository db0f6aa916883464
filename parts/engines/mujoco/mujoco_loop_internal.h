#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <memory>

#include "model/legs/leg_chain.h"
#include "parts/engines/mujoco/mujoco_loop.h"
#include "parts/engines/mujoco/mujoco_text_internal.h"

namespace ursula::mujoco {

// Indices in the model: leg after leg, then the platform.
constexpr int joints_per_leg = 3;
constexpr int legDofs(int legs) { return joints_per_leg * legs; }
constexpr int dofsOf(int legs) { return legDofs(legs) + 6; }
constexpr int proximalBody(int leg) { return 1 + 2 * leg; }
constexpr int distalBody(int leg) { return 2 + 2 * leg; }
constexpr int platformBody(int legs) { return 1 + 2 * legs; }
constexpr int siteOnLeg(int leg) { return leg; }
constexpr int siteOnPlatform(int legs, int leg) { return legs + leg; }
constexpr int dofOf(int leg, int joint) { return joints_per_leg * leg + joint; }

/// The frame that MuJoCo's coordinates of a leg count from. With a universal joint at the base its first column is any
/// perpendicular of the axis, otherwise it is the kind's fixed frame [x̂, û, ẑ].
Matrix3d frameOf(const Leg& leg);

/// MuJoCo's first coordinate of a leg minus φ.
double offsetOfPhi(const Leg& leg);

/// Whether MuJoCo's own constraints join each pair of sites.
enum class Closure { open, connected };
/// Each leg has its joints in the order of its coordinates. The platform is free, with its body's origin in its mass
/// centre. Positions are in B relative to `origin`. Each open loop has a site at Bᵢ on both sides.
Model buildModel(const Manipulator& manipulator, const Vector3d& origin, Closure closure = Closure::open);

constexpr int most_dofs = dofsOf(leg_count), most_gaps = legDofs(leg_count);
/// Three gaps per leg, as many as its joints.
using GapJacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_gaps, most_dofs>;
using VectorOfGaps = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_gaps, 1>;
using VectorOfDofs = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_dofs, 1>;

/// The machine with loops that MuJoCo closes.
struct Connected {
  Model model;
  Data data;
};
/// `pose` is one that the machine takes, as qpos of its open model.
Connected connected(const Manipulator& manipulator, const Vector3d& origin, const mjtNum* pose);

}  // namespace ursula::mujoco

namespace ursula {

struct MujocoLoop::Impl {
  Impl(const Manipulator& from, std::shared_ptr<const Load> on_platform);

  void place(const Motion<double>& motion);
  void move(const Motion<double>& motion);
  mujoco::GapJacobian gapJacobian() const;
  mujoco::VectorOfGaps gapAcceleration() const;
  mujoco::VectorOfDofs forcesOfTree() const;  ///< M q̈ + bias
  mujoco::VectorOfDofs unbalanced(const Motion<double>& motion) const;
  /// Friction and load on the coordinates, for a model with rates and positions set.
  mujoco::VectorOfDofs given(const mjModel& in_model, mjData& in_data, const Motion<double>& motion) const;
  void placeTree(const TreeCoordinates& at);
  /// Reads the Jacobians of the placed state; `forces` are MuJoCo's result for it.
  void readTree(const Motion<double>& motion, const mujoco::VectorOfDofs& forces, OpenTree& out);
  /// Reads the rates' part of readTree() alone: J and P.
  void readMaps(const mjModel& in_model, mjData& in_data, OpenTree& out) const;
  /// Converts rates of MuJoCo's free joint to [ω̇; p̈]; they are linear at the mass centre in the world, angular in the
  /// body.
  Vector6d twistRate(const Motion<double>& motion, const Vector6d& rates_of_speeds) const;

  Manipulator manipulator;
  std::shared_ptr<const Load> load;
  int legs, leg_dofs, dofs;
  Vector3d origin;  ///< the origin of MuJoCo's world, because B's may be far from the machine
  mujoco::Model model;
  mujoco::Data data;
  mujoco::GapJacobian G;
  PerLeg<double> offset_of_phi{};  ///< MuJoCo's first coordinate of a leg minus φ
  mujoco::Connected connected;     ///< created on first use
};

}  // namespace ursula

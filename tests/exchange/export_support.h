#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "model/joint_variables.h"
#include "model/scenario.h"
#include "parts/exchange/write/export.h"

namespace ursula::exchange {

/// A body as a foreign reader understands it: in the world, at the file's pose.
struct SeenBody {
  double mass = 0;
  Vector3d center_of_mass = Vector3d::Zero();
  Matrix3d inertia = Matrix3d::Zero();  ///< about the mass centre, world axes
};
using SeenBodies = std::map<std::string, SeenBody>;

/// Mass, mass centre and inertia about it, of all.
SeenBody together(const SeenBodies& bodies);

/// The scenario's bodies by the paper's formulas, under the names that files give them.
SeenBodies expectedBodies(const Scenario& scenario);

/// The largest deviation of any body's numbers and of the total, over the expected ones' sizes.
double deviation(const SeenBodies& seen, const SeenBodies& expected);

/// Turning a tensor there and back is some 12 products an entry; a pose goes through up to five transforms, and angles
/// of a quaternion or roll, pitch and yaw lose as much again. A thousand roundings hold them all.
constexpr double rounding = 1024 * 2.220446049250313e-16;

/// A machine of each kind, mixtures, three legs, full tensors, gravity aside.
const std::vector<std::string>& machines();

/// Whether a ball of the exported machine stands for the coordinate, as the leg's rod is free to spin.
bool isInBall(const Leg& leg, Coordinate coordinate);
/// The hinges and slides of the exported machine.
int axesOf(const Scenario& scenario);
Scenario machine(const std::string& name);

std::string textOf(const Scenario& scenario, ModelFormat format);

/// The machine with the tensor of one rod as if the file's axes were the world's: what a careless writer does.
MachineModel withTensorNotTurned(const Scenario& scenario);

}  // namespace ursula::exchange

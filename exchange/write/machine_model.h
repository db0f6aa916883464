#pragma once

#include <vector>

#include "exchange/model_graph.h"
#include "model/scenario.h"

namespace ursula::exchange {

/// A body's numbers in its own frame, as in the scenario, without the rounding of a rotation to the world.
struct OwnNumbers {
  Vector3d center_of_mass = Vector3d::Zero();  ///< m
  Matrix3d inertia = Matrix3d::Zero();         ///< about the mass centre, kg·m²
};

/// A round rod for display; ends in the world, m.
struct DrawnRod {
  std::size_t body = 0;  ///< index into the graph's bodies
  Vector3d from = Vector3d::Zero(), to = Vector3d::Zero();
  double radius = 0;  ///< m
};

/// A scenario's machine at the first instant of the motion, the input of every format.
struct MachineModel {
  ModelGraph graph;             ///< `assumptions` list what no format can hold
  std::vector<OwnNumbers> own;  ///< one per body of the graph, in the same order
  std::vector<DrawnRod> rods;
};

/// A body with mass and the joints that carry it, from the previous body through massless ones.
struct TreeBody {
  std::size_t parent = 0, child = 0;  ///< indices into the graph's bodies
  std::vector<std::size_t> joints;    ///< indices into its joints, starting at the parent
};

/// Limbs of the graph's tree, in the order of their children. Massless bodies count as frames.
std::vector<TreeBody> treeBodiesOf(const ModelGraph& graph);

/// Returns the joint that carries `body` in the tree; null for the base.
const GraphJoint* carrierOf(const ModelGraph& graph, std::size_t body);

}  // namespace ursula::exchange

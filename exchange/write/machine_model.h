#pragma once

#include <vector>

#include "exchange/model_graph.h"
#include "model/scenario.h"

namespace ursula::exchange {

/// A body's numbers in its own frame, as the scenario has them: without the rounding of being turned to the world.
struct OwnNumbers {
  Vector3d center_of_mass = Vector3d::Zero();  ///< m
  Matrix3d inertia = Matrix3d::Zero();         ///< about the mass centre, kg·m²
};

/// A round rod to be seen; ends in the world, m.
struct DrawnRod {
  std::size_t body = 0;  ///< index into the graph's bodies
  Vector3d from = Vector3d::Zero(), to = Vector3d::Zero();
  double radius = 0;  ///< m
};

/// A scenario's machine as every format is given it, at the first instant of the motion.
struct MachineModel {
  ModelGraph graph;             ///< `assumptions` say what no format can hold
  std::vector<OwnNumbers> own;  ///< of the graph's bodies, in their order
  std::vector<DrawnRod> rods;
};

/// A body that has mass, and the joints that carry it: from the body before, through bodies of no mass.
struct Limb {
  std::size_t parent = 0, child = 0;  ///< indices into the graph's bodies
  std::vector<std::size_t> joints;    ///< indices into its joints, from the parent on
};

/// Limbs of the graph's tree, in the order of their children. Bodies without mass are taken for frames.
std::vector<Limb> limbsOf(const ModelGraph& graph);

/// The joint that carries `body` in the tree; null for the base.
const GraphJoint* carrierOf(const ModelGraph& graph, std::size_t body);

}  // namespace ursula::exchange

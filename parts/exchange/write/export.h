#pragma once

#include <string>
#include <vector>

#include "model/scenario.h"
#include "parts/exchange/model_graph.h"

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

/// Returns the limbs of the graph's tree, in the order of their children. Massless bodies count as frames.
std::vector<TreeBody> treeBodiesOf(const ModelGraph& graph);

/// Returns the scenario's machine at the first instant of its motion: a base, the legs' links and the platform. A
/// massless cross joins two consecutive turning coordinates. The first leg carries the platform by a ball; balls close
/// the loops of the others. Throws UnreachablePose.
MachineModel modelOf(const Scenario& scenario);

/// A model file, and notes on the parts of the scenario that it lacks.
struct WrittenModel {
  std::string text;
  Assumptions notes;
};

/// Writes the scenario's machine at the first instant of its motion. Throws UnreachablePose.
WrittenModel exportScenario(const Scenario& scenario, ModelFormat format);

// The individual formats; each adds to `notes` what it cannot hold.

std::string sdfText(const MachineModel& machine, Assumptions& notes);
std::string mjcfText(const MachineModel& machine, Assumptions& notes);
std::string urdfText(const MachineModel& machine, Assumptions& notes);

}  // namespace ursula::exchange

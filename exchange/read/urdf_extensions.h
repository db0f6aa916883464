#pragma once

#include <vector>

#include "exchange/model_graph.h"
#include "exchange/read/urdf_closures.h"

namespace ursula::exchange {

/// Applies the <mujoco> of a URDF as MuJoCo does: gravity, and bounds of masses and inertias. `links` are the elements
/// of the graph's bodies. Without a gravity there it says which was taken. Throws ImportError where MuJoCo would take a
/// mass from a shape or scale all of them.
void readUrdfMujoco(const Element& robot, const std::vector<const Element*>& links, ModelGraph& graph);

/// Reads what <gazebo> says of links and joints. Throws ImportError for what a scenario has no words for.
void readUrdfGazebo(const Element& robot, const UrdfLinks& links, ModelGraph& graph);

}  // namespace ursula::exchange

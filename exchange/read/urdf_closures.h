#pragma once

#include <filesystem>
#include <unordered_map>

#include "exchange/model_graph.h"
#include "exchange/read/xml.h"

namespace ursula::exchange {

/// Links of a URDF by name, as indices of the graph's bodies.
using UrdfLinks = std::unordered_map<std::string, std::size_t>;

/// Reads the closures of the tree's loops from the first available source: Drake's ball constraints, Isaac Sim's loop
/// joints, SDF joints in <gazebo>, robot.yaml next to the file, links named closing_NAME_1 and closing_NAME_2.
void readUrdfClosures(const Element& robot, const std::filesystem::path& file, const UrdfLinks& links,
                      ModelGraph& graph);

}  // namespace ursula::exchange

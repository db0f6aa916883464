#pragma once

#include <filesystem>
#include <unordered_map>

#include "exchange/model_graph.h"
#include "exchange/read/xml.h"

namespace ursula::exchange {

/// Links of a URDF by name: indices of the graph's bodies.
using UrdfLinks = std::unordered_map<std::string, std::size_t>;

/// What closes the tree's loops, of the first of these that is there: Drake's ball constraints, Isaac Sim's loop
/// joints, SDF joints in <gazebo>, robot.yaml beside the file, links named closing_NAME_1 and closing_NAME_2. Where
/// there is none, ends that coincide are told as an assumption's words are: never taken.
void readUrdfClosures(const Element& robot, const std::filesystem::path& file, const UrdfLinks& links,
                      ModelGraph& graph);

}  // namespace ursula::exchange

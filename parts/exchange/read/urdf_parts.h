#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "parts/exchange/read/xml.h"

namespace ursula::exchange {

/// Links of a URDF by name, as indices of the graph's bodies.
using UrdfLinks = std::unordered_map<std::string, std::size_t>;

/// Begins what is said of the root link.
constexpr const char* root_stands_still = "The root link stands still";

/// The few forms of YAML in a robot.yaml: `key: word`, `key: [a, [b, c]]`, and lists of `- a` below a key. Nested lists
/// are flattened.
using SmallYaml = std::map<std::string, std::vector<std::string>>;
/// Reads a file beside the model. Throws ImportError for any other form, and for a link that leads out of its folder.
SmallYaml readSmallYaml(const std::filesystem::path& file);

/// Reads the closures of the tree's loops from the first available source: Drake's ball constraints, Isaac Sim's loop
/// joints, the proposed <constraint>, SDF joints in <gazebo>, robot.yaml next to the file, links named closing_NAME_1
/// and closing_NAME_2. Isaac Sim's and Gazebo's may repeat those of an earlier source; other ones are refused.
void readUrdfClosures(const Element& robot, const std::filesystem::path& file, const UrdfLinks& links,
                      ModelGraph& graph);

/// Applies the <mujoco> of a URDF as MuJoCo does: gravity, and bounds of masses and inertias. `links` are the elements
/// of the graph's bodies. Without a gravity there it says which was taken. Throws ImportError where MuJoCo would take a
/// mass from a shape or scale all of them.
void readUrdfMujoco(const Element& robot, const std::vector<const Element*>& links, ModelGraph& graph);

/// Reads what <gazebo> says of links and joints. Throws ImportError for what a scenario has no words for.
void readUrdfGazebo(const Element& robot, const UrdfLinks& links, ModelGraph& graph);

}  // namespace ursula::exchange

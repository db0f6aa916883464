#pragma once

#include <string>
#include <unordered_map>

#include "exchange/model_graph.h"
#include "exchange/read/mjcf_settings.h"

namespace ursula::exchange {

struct MjcfSite {
  std::size_t body = 0;
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();  ///< in the world
};

/// What the tree gave names to: indices of the graph's bodies and joints.
struct MjcfNamed {
  std::unordered_map<std::string, std::size_t> bodies, joints;
  std::unordered_map<std::string, MjcfSite> sites;
};

/// Adds the joints of <equality>, which close the tree's loops. Throws ImportError.
void readMjcfClosures(const Element& root, const MjcfDefaults& defaults, const MjcfNamed& named, ModelGraph& graph);

/// Marks the joints that <actuator> drives. Throws ImportError.
void readMjcfActuators(const Element& root, const MjcfDefaults& defaults, const MjcfNamed& named, ModelGraph& graph);

}  // namespace ursula::exchange

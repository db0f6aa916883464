#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exchange/import.h"
#include "exchange/recognise/groups.h"

namespace ursula::exchange {

/// A single-axis joint or a ball between base and platform, at the initial pose, in the world.
struct Primitive {
  enum class Kind { R, P, S } kind = Kind::R;
  Vector3d axis = Vector3d::Zero();   ///< the coordinate grows as the outer part turns about it or slides along it
  Vector3d inner = Vector3d::Zero();  ///< the centre in the body towards the base
  Vector3d outer = Vector3d::Zero();  ///< the centre in the body towards the platform
  std::size_t joint = 0;              ///< index in the graph
};

/// A chain from base to platform. bodies[k] is the group between primitives k and k + 1, or nullopt within a joint.
struct Chain {
  std::vector<Primitive> primitives;
  std::vector<std::optional<std::size_t>> bodies;
  std::string place(const ModelGraph& graph) const;  ///< names of its joints, for messages
};

struct Chains {
  std::size_t base = 0, platform = 0;  ///< groups
  std::vector<Chain> legs;             ///< in the order of their first joints in the file
};

/// Throws ImportError with the bodies and joints that prevent it.
Chains findChains(const ModelGraph& graph, const Groups& groups, const ImportChoices& choices,
                  std::vector<Assumption>& assumptions);

}  // namespace ursula::exchange

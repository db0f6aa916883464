#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exchange/import.h"
#include "exchange/recognise/groups.h"

namespace ursula::exchange {

/// One freedom or a ball on the way from the base to the platform, at the initial pose, in the world.
struct Primitive {
  enum class Kind { R, P, S } kind = Kind::R;
  Vector3d axis = Vector3d::Zero();   ///< the coordinate grows as what lies outwards turns about it or slides along it
  Vector3d inner = Vector3d::Zero();  ///< the centre as the body towards the base has it
  Vector3d outer = Vector3d::Zero();  ///< as the body towards the platform has it
  std::size_t joint = 0;              ///< of the graph
};

/// The way from base to platform. Between primitives k and k + 1 lies bodies[k], a group, or none within a joint.
struct Chain {
  std::vector<Primitive> primitives;
  std::vector<std::optional<std::size_t>> bodies;
  std::string place(const ModelGraph& graph) const;  ///< its joints, for messages
};

struct Chains {
  std::size_t base = 0, platform = 0;  ///< groups
  std::vector<Chain> legs;             ///< in the order of their first joints in the file
};

/// Throws ImportError with the bodies and joints that speak against it.
Chains findChains(const ModelGraph& graph, const Groups& groups, const ImportChoices& choices,
                  std::vector<Assumption>& assumptions);

}  // namespace ursula::exchange

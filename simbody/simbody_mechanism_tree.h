#pragma once

#include <optional>
#include <vector>

#include "model/mechanism.h"

namespace ursula {

/// A spanning tree over a mechanism's bodies, with all fixed bodies as one ground.
struct SpanningTree {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// A body on its inboard body, by a joint or freely on the ground.
  struct Step {
    std::size_t joint;              ///< or none: six freedoms
    std::size_t inboard, outboard;  ///< bodies; inboard is any of the fixed ones if the joint is none
    bool reversed;                  ///< whether inboard is the joint's child
  };

  /// A massless body between two hinges whose axes meet, left out as the two are cut: they act as a universal joint.
  struct Gimbal {
    std::size_t body, first, second;  ///< hinges
    std::size_t before, after;        ///< bodies at the first and the second hinge
    Vector3d centre;                  ///< at the reference pose
  };

  std::vector<Step> steps;  ///< from the ground outwards
  std::vector<std::size_t> cuts;
  std::vector<Gimbal> gimbals;
};

/// Chooses a tree that cuts neither motors nor loaded joints if it can, and that has no massless tips if it can. If
/// `keeps_closures` is set it prefers the file's closures to its other joints, otherwise it cuts them.
SpanningTree spanningTree(const Mechanism& mechanism, bool keeps_closures);

/// Returns whether a body has neither mass nor moments of inertia.
bool isMassless(const MechanismBody& body);

}  // namespace ursula

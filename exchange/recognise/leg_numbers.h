#pragma once

#include "exchange/recognise/imported_machine.h"
#include "exchange/recognise/leg_shape.h"

namespace ursula::exchange {

/// Input for the numbers of a leg.
struct LegTask {
  const ModelGraph& graph;
  const Groups& groups;
  const LegShape& shape;
  const ImportChoices& choices;
  double size;                 ///< size of the machine, m
  Eigen::Isometry3d base;      ///< B in the world
  Eigen::Isometry3d platform;  ///< M in the world
};

/// Returns the leg in the scenario's terms, measured on its own bodies at the initial pose. Throws ImportError if it
/// lacks the geometry of its kind. Adds masses of crosses on the platform to `platform`.
ImportedLeg legOf(const LegTask& task, Group& platform, std::vector<Assumption>& assumptions);

/// F̂ = [x̂, û, ẑ] of docs/legs.md.
Matrix3d fixedFrame(const Vector3d& u);

}  // namespace ursula::exchange

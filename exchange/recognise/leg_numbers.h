#pragma once

#include "exchange/recognise/imported_machine.h"
#include "exchange/recognise/leg_shape.h"

namespace ursula::exchange {

/// What a leg's numbers are made of.
struct LegTask {
  const ModelGraph& graph;
  const Groups& groups;
  const LegShape& shape;
  const ImportChoices& choices;
  double size;                 ///< of the machine, m
  Eigen::Isometry3d base;      ///< B in the world
  Eigen::Isometry3d platform;  ///< M in the world
};

/// The leg in the scenario's own words, measured on its own bodies at the initial pose. Throws ImportError where it
/// does not have the geometry of its kind. Masses of its crosses that ride on the platform are added to `platform`.
ImportedLeg legOf(const LegTask& task, Group& platform, std::vector<Assumption>& assumptions);

/// F̂ = [x̂, û, ẑ] of docs/legs.md.
Matrix3d fixedFrame(const Vector3d& u);

}  // namespace ursula::exchange

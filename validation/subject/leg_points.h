#pragma once

#include <array>
#include <optional>
#include <vector>

#include "model/scenario.h"
#include "nocsolver/noc/noc.h"

namespace ursula {

/// What there is to draw of a leg, m, in B. Links run from A to R and from S to B; of a carriage A is where its d is 0.
struct LegPoints {
  Vector3d A;                    ///< base joint
  Vector3d R;                    ///< where the first link ends: the knee, the cylinder's open end, the carriage
  Vector3d S;                    ///< where the second link begins: R, but within the cylinder of UPS
  Vector3d B;                    ///< platform joint
  std::array<Vector3d, 3> axes;  ///< unit, of the three coordinates: positive turns about it, or slides along it
};

/// Of every leg, from the displacements in `work`.
std::vector<LegPoints> legPoints(const Manipulator& machine, const NocWorkspace<double>& work);

/// What a carriage passes along its rail.
struct Stretch {
  Vector3d from = Vector3d::Zero(), to = Vector3d::Zero();  ///< m, in B
};

/// The rails of carriages, of PUS legs alone, with a tenth of the rod's length beyond what the motion needs; as far as
/// the motion can be made. Empty entries for legs without.
std::vector<std::optional<Stretch>> rails(const Scenario& scenario);

}  // namespace ursula

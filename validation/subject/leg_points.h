#pragma once

#include <array>
#include <optional>
#include <vector>

#include "model/scenario.h"
#include "nocsolver/noc/noc.h"

namespace ursula {

/// Points of a leg for a drawing, m, in B. Links run from A to R and from S to B; for a carriage, A is where d = 0.
struct LegPoints {
  Vector3d A;                    ///< base joint
  Vector3d R;                    ///< end of the first link: the knee, the cylinder's open end, the carriage
  Vector3d S;                    ///< start of the second link: R, or a point inside the cylinder for UPS
  Vector3d B;                    ///< platform joint
  std::array<Vector3d, 3> axes;  ///< unit, of the three coordinates; positive motion is about or along the axis
};

/// Returns the points of every leg, from the displacements in `work`.
std::vector<LegPoints> legPoints(const Manipulator& machine, const NocWorkspace<double>& work);

/// The section of its rail that a carriage passes.
struct RailSection {
  Vector3d from = Vector3d::Zero(), to = Vector3d::Zero();  ///< m, in B
};

/// Returns the rails of carriages (PUS legs), a tenth of the rod's length longer than the motion needs, up to its last
/// possible pose. Entries of other legs are empty.
std::vector<std::optional<RailSection>> rails(const Scenario& scenario);

}  // namespace ursula

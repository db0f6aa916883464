#pragma once

#include <memory>
#include <optional>

#include "model/joint_reactions.h"
#include "model/joint_variables.h"
#include "model/loops/further_roads.h"
#include "model/scenario.h"
#include "validation/subject/presentation.h"

namespace ursula {

/// What the engines answer for one motion, in B and SI wherever they were asked.
struct EngineView {
  JointMotion joints;
  BodyMotions<double> bodies;
  Vector6d torques;                                 ///< Simbody's, N·m
  OfFurtherRoads<std::optional<Vector6d>> further;  ///< the others', those that are built in
  Vector6d acceleration;        ///< Simbody's of the platform under the motion's torques, [ω̇; p̈]
  Vector6d direct;              ///< the same under torques given from outside
  double gap_acceleration = 0;  ///< of the loops, m/s²
  Reactions reactions;          ///< under the motion's torques
};

/// All engines on one scenario in one presentation. The solver has no part in it.
class EnginePresentation {
 public:
  EnginePresentation(const Scenario& scenario, const Presentation& presentation);
  ~EnginePresentation();
  EnginePresentation(EnginePresentation&&) noexcept;

  /// `motion` as the scenario has it, with its `torques`; `others` for direct. Throws std::domain_error where an engine
  /// has no answer.
  EngineView at(const Motion<double>& motion, const Vector6d& torques, const Vector6d& others);

 private:
  struct Engines;
  Presentation presentation_;
  std::unique_ptr<Engines> engines_;
};

/// The largest difference of a force, or of a moment over `length`, N.
double distance(const LegReactions& a, const LegReactions& b, double length);

}  // namespace ursula

#pragma once

#include <memory>
#include <optional>

#include "model/joint_variables.h"
#include "model/scenario.h"
#include "validation/limits/formulation_faults.h"
#include "validation/limits/further_engines.h"
#include "validation/subject/frame_change.h"

namespace ursula {

/// The engines' results for one motion, converted to B and SI from the engine's frame.
struct EngineView {
  JointMotion joints;
  BodyMotions<double> bodies;
  Vector6d torques;                                   ///< Simbody's, N·m
  OfFurtherEngines<std::optional<Vector6d>> further;  ///< of the other engines in this build
  Vector6d acceleration;        ///< Simbody's for the platform under the motion's torques, [ω̇; p̈]
  Vector6d direct;              ///< the same under given torques
  double gap_acceleration = 0;  ///< of the loops, m/s²
  Reactions reactions;          ///< under the motion's torques
};

/// All engines on one scenario in one change of frame, without the solver.
class EngineFrameChange {
 public:
  EngineFrameChange(const Scenario& scenario, const FrameChange& frame_change, const FormulationFaults& faults = {});
  ~EngineFrameChange();
  EngineFrameChange(EngineFrameChange&&) noexcept;

  /// Takes `motion` in the scenario's frame, with its `torques`, and `others` for direct. Throws std::domain_error if
  /// an engine fails.
  EngineView at(const Motion<double>& motion, const Vector6d& torques, const Vector6d& others);

 private:
  struct Engines;
  FrameChange frame_change_;
  std::unique_ptr<Engines> engines_;
};

/// The largest difference of a force, or of a moment over `length`, N.
double distance(const LegReactions& a, const LegReactions& b, double length);

}  // namespace ursula

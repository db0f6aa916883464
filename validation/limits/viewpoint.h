#pragma once

#include <memory>
#include <optional>

#include "model/joint_reactions.h"
#include "model/joint_variables.h"
#include "model/loops/further_roads.h"
#include "model/scenario.h"
#include "validation/subject/presentation.h"

namespace ursula {

/// What all roads answer for one motion, in B and SI wherever they were asked.
struct View {
  JointMotion joints_solver, joints_simbody;
  BodyMotions<double> bodies_solver, bodies_simbody;  ///< Simbody's where it is put into the solver's joint state
  Vector6d jacobian, jacobian_rate;          ///< T φ̇, T φ̈ + Ṫ φ̇ with Simbody's joint motion: [ω; v] at P
  Matrix6d T, T_rate;                        ///< the solver's
  Vector6d torques_solver, torques_simbody;  ///< N·m
  OfFurtherRoads<std::optional<Vector6d>> torques_further;  ///< those that are built in
  Vector6d acceleration;                   ///< Simbody's of the platform under the solver's torques, [ω̇; p̈]
  Vector6d direct_solver, direct_simbody;  ///< both under torques given from outside
  double gap_acceleration = 0;             ///< of the loops, m/s²
  Reactions reactions_solver, reactions_simbody;
};

/// All roads on one scenario in one presentation.
class Viewpoint {
 public:
  Viewpoint(const Scenario& scenario, const Presentation& presentation);
  ~Viewpoint();
  Viewpoint(Viewpoint&&) noexcept;

  /// `motion` as the scenario has it; `torques` for direct_*. Throws PoseError or std::domain_error where a road has no
  /// answer.
  View at(const Motion<double>& motion, const Vector6d& torques);

 private:
  struct Roads;
  Presentation presentation_;
  std::unique_ptr<Roads> roads_;
};

/// The largest difference of a force, or of a moment over `length`, N.
double distance(const LegReactions& a, const LegReactions& b, double length);

}  // namespace ursula

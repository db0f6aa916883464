#pragma once

#include <memory>
#include <vector>

#include "model/joint_reactions.h"
#include "model/joint_variables.h"
#include "model/load.h"
#include "model/manipulator.h"
#include "model/motion.h"

namespace ursula {

/// What the NOC answers for one motion, in B.
struct SolverView {
  JointMotion joints;
  BodyMotions<double> bodies;
  Matrix6d T, T_rate;
  Vector6d torques, direct;  ///< N·m; [ω̇; p̈] under torques given from outside
  Reactions reactions;
};

/// How the NOC rounds, measured in one and the same frame: its formulas as they are, and with every number of the
/// machine and of the motion moved by one rounding. A wrong formula is wrong in all of them alike and adds nothing,
/// whatever leg, frame, unit or precision it depends on.
class SolverRounding {
 public:
  SolverRounding(const Manipulator& machine, std::shared_ptr<const Load> load);
  ~SolverRounding();
  SolverRounding(SolverRounding&&) noexcept;

  /// The NOC's torques as they are, N·m.
  Vector6d torques(const Motion<double>& motion);
  /// The first answer is to the numbers as they are, the others to moved ones. `others` are torques for `direct`.
  /// Throws PoseError.
  std::vector<SolverView> at(const Motion<double>& motion, const Vector6d& others);

 private:
  struct Formulations;
  std::unique_ptr<Formulations> formulations_;
};

}  // namespace ursula

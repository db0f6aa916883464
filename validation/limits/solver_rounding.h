#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "model/joint_variables.h"
#include "model/load.h"
#include "model/manipulator.h"
#include "model/motion.h"
#include "validation/subject/subject.h"

namespace ursula {

/// The NOC's results for one motion, in B.
struct SolverView {
  JointMotion joints;
  BodyMotions<double> bodies;
  Matrix6d T, T_rate;
  Vector6d torques, direct;  ///< N·m; [ω̇; p̈] under given torques
  Reactions reactions;
};

/// The rounding of the NOC, measured in one frame. Its formulas get the given numbers, then numbers of machine and
/// motion that are all changed by one rounding. A wrong formula is equally wrong in all evaluations and adds nothing.
class SolverRounding {
 public:
  /// `fault` falsifies the NOC, for negative controls.
  SolverRounding(const Manipulator& machine, std::shared_ptr<const Load> load,
                 const std::function<Subject(const Subject&)>& fault = nullptr);
  ~SolverRounding();
  SolverRounding(SolverRounding&&) noexcept;

  /// The NOC's torques for the given numbers, N·m.
  Vector6d torques(const Motion<double>& motion);
  /// Returns the results for the given numbers first, then those for changed ones. `others` are torques for `direct`.
  /// Throws PoseError.
  std::vector<SolverView> at(const Motion<double>& motion, const Vector6d& others);

 private:
  struct Formulations;
  std::unique_ptr<Formulations> formulations_;
};

}  // namespace ursula

#pragma once

#include <optional>

#include "nocsolver/chain_solver.h"
#include "nocsolver/fast_dynamics.h"
#include "nocsolver/paper_solver.h"

namespace ursula {

/// Where Solver keeps what it finds; one for each thread. Fixed size: nothing is allocated.
template <class S>
struct Workspace {
  PaperWorkspace<S> paper;
  ChainWorkspace<S> chain;
};

/// Kinematics and dynamics of any machine. Dynamics by FastDynamics; kinematics by the paper's own equations where they
/// are for it, else by ChainSolver, which has the same method for legs of all kinds. All agree to rounding where they
/// can be asked. Immutable: threads share it, each with a Workspace of its own. Nothing here allocates.
///
/// Every function throws OutOfReach, OutOfStroke or PointOnAxis for poses that the legs cannot take, and from the rates
/// on StretchedLeg; those that need B⁻¹ throw SingularJacobian.
template <class S>
class Solver {
 public:
  explicit Solver(const Manipulator& manipulator) : chain_(manipulator), dynamics_(manipulator) {
    if (manipulator.isOfThePaper()) paper_.emplace(manipulator);
  }

  /// The paper's equations; null where the machine is of another kind.
  const PaperSolver<S>* paper() const { return paper_ ? &*paper_ : nullptr; }
  /// The general road, for any machine.
  const ChainSolver<S>& chain() const { return chain_; }
  /// A length of the machine's size, m: the largest ‖bᵢ‖ or link.
  const S& length() const { return chain_.length(); }

  /// Displacements only: (3)–(5), (13), (14) and what is like them.
  void displacements(const Motion<S>& motion, Workspace<S>& work) const {
    paper_ ? paper_->displacements(motion, work.paper) : chain_.displacements(motion, work.chain);
  }

  /// Displacements, rates and accelerations of all joints, (1)–(19).
  void inverseKinematics(const Motion<S>& motion, Workspace<S>& work) const {
    paper_ ? paper_->inverseKinematics(motion, work.paper) : chain_.inverseKinematics(motion, work.chain);
  }

  /// What `work` holds: angles in (−π, π] but for ψ of (14b), and d in m.
  JointVariables<S> angles(const Workspace<S>& work) const {
    return paper_ ? paper_->angles(work.paper) : chain_.angles(work.chain);
  }
  JointVariables<S> rates(const Workspace<S>& work) const {
    return paper_ ? paper_->rates(work.paper) : chain_.rates(work.chain);
  }
  JointVariables<S> accelerations(const Workspace<S>& work) const {
    return paper_ ? paper_->accelerations(work.paper) : chain_.accelerations(work.chain);
  }

  /// How near leg i is to where its rates are not determined. Needs displacements.
  LegMargins<S> margins(const Workspace<S>& work, int i) const {
    using std::abs;
    const auto at = static_cast<std::size_t>(i);
    if (!paper_) return work.chain.legs[at].margins;
    const LegState<S>& leg = work.paper.legs[at];
    return {abs(leg.sin_theta), leg.q / leg.r};
  }

  /// A, B of (23) and the factors of Bᵀ, from the displacements in `work`.
  void jacobians(const Motion<S>& motion, Workspace<S>& work) const {
    paper_ ? paper_->jacobians(motion, work.paper) : chain_.jacobians(motion, work.chain);
  }
  /// Its rows are [Qb × n; n], n of length 1.
  Matrix6<S> B(const Workspace<S>& work) const {
    if (paper_) return work.paper.B;
    Matrix6<S> B = work.chain.B;
    for (int m = 0; m < motor_count; ++m) B.row(m) /= B.row(m).template tail<3>().norm();
    return B;
  }

  /// Of Bᵀ, its moment rows over the length. Needs jacobians.
  S determinant(const Workspace<S>& work) const {
    return paper_ ? work.paper.B_transposed.determinant() : work.chain.B_transposed.determinant();
  }

  /// T = B⁻¹A of (24), 6 × 6: t_P = T q̇ of the driven coordinates. Needs jacobians.
  Matrix6<S> T(const Workspace<S>& work) const { return paper_ ? paper_->T(work.paper) : chain_.T(work.chain); }

  /// Ṫ of (25), (26). Needs inverseKinematics and jacobians.
  Matrix6<S> TRate(const Motion<S>& motion, const Workspace<S>& work) const {
    return paper_ ? paper_->TRate(motion, work.paper) : chain_.TRate(motion, work.chain);
  }

  /// Pose, twist and twist rate of all bodies, (16), (17), (39)–(43). Needs inverseKinematics.
  void bodyMotions(const Motion<S>& motion, Workspace<S>& work, BodyMotions<S>& bodies) const {
    paper_ ? paper_->bodyMotions(motion, work.paper, bodies) : chain_.bodyMotions(motion, work.chain, bodies);
  }

  /// The twist-shaping matrix by (48) and (47). Needs inverseKinematics and jacobians.
  void twistShaping(const Motion<S>& motion, const Workspace<S>& work, TwistShaping<S>& shaping) const {
    paper_ ? paper_->twistShaping(motion, work.paper, shaping) : chain_.twistShaping(motion, work.chain, shaping);
  }

  /// Efforts of the motors, N·m, or N where they push, conjugate to the rates of their coordinates, by (37); `load` is
  /// an external wrench on the platform, [moment about P; force], in B. The workspace is left as it is.
  Vector6<S> inverseDynamics(const Motion<S>& motion, Workspace<S>&,
                             const Vector6<S>& load = Vector6<S>::Zero()) const {
    return dynamics_.inverseDynamics(motion, load);
  }

  /// The platform's twist rate [ω̇; p̈] under efforts, by (36) projected on t_P; accelerations in `motion` are not read.
  /// Does not throw SingularJacobian: the motors act whether or not they determine the motion. The workspace is left as
  /// it is.
  Vector6<S> directDynamics(const Motion<S>& motion, const Vector6<S>& efforts, Workspace<S>&,
                            const Vector6<S>& load = Vector6<S>::Zero()) const {
    return dynamics_.directDynamics(motion, efforts, load);
  }

  /// M_P: the whole machine's mass matrix in the platform's twist at P. Needs inverseKinematics.
  Matrix6<S> massMatrixAtP(const Motion<S>& motion, const Workspace<S>& work) const {
    return paper_ ? paper_->massMatrixAtP(motion, work.paper) : chain_.massMatrixAtP(motion, work.chain);
  }

 private:
  std::optional<PaperSolver<S>> paper_;
  ChainSolver<S> chain_;
  FastDynamics<S> dynamics_;
};

}  // namespace ursula

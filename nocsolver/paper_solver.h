#pragma once

#include <array>

#include <Eigen/LU>

#include "model/joint_variables.h"
#include "model/motion.h"
#include "nocsolver/errors.h"
#include "nocsolver/leg_state.h"
#include "nocsolver/paper_model.h"
#include "nocsolver/reading.h"

namespace ursula {

/// The twist-shaping matrix of (32a), 78 × 6, rows in the order of (30a).
template <class S>
using TwistShaping = Eigen::Matrix<S, 6 * body_count, leg_count>;

/// Where the solver keeps what it finds; one for each thread. Fixed size: nothing is allocated.
template <class S>
struct PaperWorkspace {
  std::array<LegState<S>, leg_count> legs;
  std::array<LinkMotion<S>, leg_count> proximal, distal;
  Vector6<S> A;                                  ///< diagonal of A (23)
  Matrix6<S> B;                                  ///< (23)
  Eigen::PartialPivLU<Matrix6<S>> B_transposed;  ///< factors of Bᵀ
};

/// The paper's closed forms for one manipulator. Immutable: threads share it, each with a Workspace of its own.
/// `Reading` is Corrected, or WithSlips for the formulas as printed. Nothing here allocates.
///
/// Every function throws OutOfReach or PointOnAxis for poses that the legs cannot take, and from the rates on
/// StretchedLeg; those that need B⁻¹ throw SingularJacobian.
template <class S, class Reading = Corrected>
class PaperSolver {
 public:
  explicit PaperSolver(const Manipulator& manipulator, Reading reading = Reading{});

  const PaperModel<S>& model() const { return model_; }

  /// Displacements only: (3)–(5), (13), (14).
  void displacements(const Motion<S>& motion, PaperWorkspace<S>& work) const;

  /// Displacements, rates and accelerations of all joints, (1)–(19).
  void inverseKinematics(const Motion<S>& motion, PaperWorkspace<S>& work) const;

  /// What `work` holds, as φ ∈ (−π, π], ψ of (14b), θ ∈ (−π, π) with the knee's sign.
  JointVariables<S> angles(const PaperWorkspace<S>& work) const;
  JointVariables<S> rates(const PaperWorkspace<S>& work) const;
  JointVariables<S> accelerations(const PaperWorkspace<S>& work) const;

  /// A, B of (23) and the factors of Bᵀ, from the displacements in `work`.
  void jacobians(const Motion<S>& motion, PaperWorkspace<S>& work) const;

  /// T = B⁻¹A of (24), 6 × 6: t_P = T φ̇. Needs jacobians.
  Matrix6<S> T(const PaperWorkspace<S>& work) const;

  /// Ṫ of (25), (26). Needs inverseKinematics and jacobians.
  Matrix6<S> TRate(const Motion<S>& motion, const PaperWorkspace<S>& work) const;

  /// Pose, twist and twist rate of all 13 bodies, (16), (17), (39)–(43). Needs inverseKinematics.
  void bodyMotions(const Motion<S>& motion, PaperWorkspace<S>& work, BodyMotions<S>& bodies) const;

  /// The twist-shaping matrix by (48) and (47). Needs inverseKinematics and jacobians.
  void twistShaping(const Motion<S>& motion, const PaperWorkspace<S>& work, TwistShaping<S>& shaping) const;

  /// Its rate: ṫ = T φ̈ + Ṫ φ̇ (32b). Needs inverseKinematics and jacobians.
  void twistShapingRate(const Motion<S>& motion, const PaperWorkspace<S>& work, TwistShaping<S>& shaping_rate) const;

  /// Actuator torques τ^a, N·m, conjugate to φ̇ (positive about −uᵢ), by (37); `load` is an external wrench on the
  /// platform, [moment about P; force], in B. Does all of inverseKinematics and jacobians on the way.
  Vector6<S> inverseDynamics(const Motion<S>& motion, PaperWorkspace<S>& work,
                             const Vector6<S>& load = Vector6<S>::Zero()) const;

  /// The platform's twist rate [ω̇; p̈] under actuator torques, by (36) projected on t_P; accelerations in `motion` are
  /// not read. Does not throw SingularJacobian: the torques act whether or not they determine the motion.
  Vector6<S> directDynamics(const Motion<S>& motion, const Vector6<S>& torques, PaperWorkspace<S>& work,
                            const Vector6<S>& load = Vector6<S>::Zero()) const;

  /// M_P: the whole machine's mass matrix in the platform's twist at P. Needs displacements.
  Matrix6<S> massMatrixAtP(const Motion<S>& motion, const PaperWorkspace<S>& work) const;

 private:
  Vector6<S> wrenchAtP(const Motion<S>& motion, PaperWorkspace<S>& work, Vector6<S>& Q_phi) const;

  PaperModel<S> model_;
  Reading reading_;
};

extern template class PaperSolver<double, Corrected>;
extern template class PaperSolver<double, WithSlips>;
extern template class PaperSolver<float, Corrected>;

}  // namespace ursula

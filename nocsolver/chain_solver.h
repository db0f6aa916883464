#pragma once

#include <array>

#include <Eigen/LU>

#include "model/joint_variables.h"
#include "model/motion.h"
#include "nocsolver/chain_state.h"
#include "nocsolver/errors.h"
#include "nocsolver/spoilt_chain.h"

namespace ursula {

/// Where the solver keeps what it finds; one for each thread. Fixed size: nothing is allocated.
template <class S>
struct ChainWorkspace {
  std::array<ChainState<S>, leg_count> legs;
  Vector6<S> A;                                  ///< diagonal of A: t_P = B⁻¹A q̇ of the driven coordinates (23)
  Matrix6<S> B;                                  ///< rows [Qb × n; n], n along the row of a leg's map, near 1 (23)
  Eigen::PartialPivLU<Matrix6<S>> B_transposed;  ///< factors of Bᵀ
};

/// Inverse and direct dynamics by the natural orthogonal complement for a platform on legs of any kinds, with the
/// motors where they are. A leg is a chain of three joints with a kernel of its own; all else is written once.
///
/// The method is the paper's: the twists of all bodies are linear in the platform's, t = T t_P, so that Tᵀ frees the
/// equations of motion from the constraints (31)–(37). T is never formed: each leg's forces are brought onto its
/// coordinates, those that no motor drives onto B by the leg's map, and from there onto P.
///
/// Immutable: threads share it, each with a workspace of its own. Nothing here allocates. Throws as PaperSolver does,
/// and OutOfStroke. `Reading` is Corrected, or SpoiltChain for formulas that are wrong.
template <class S, class Reading = Corrected>
class ChainSolver {
 public:
  explicit ChainSolver(const Manipulator& manipulator, Reading reading = Reading{});

  int legCount() const { return leg_count_; }
  /// A length of the machine's size, m.
  const S& length() const { return length_; }
  const Motors& motors() const { return motors_; }

  /// With the legs' maps: refuses stretched legs as well.
  void displacements(const Motion<S>& motion, ChainWorkspace<S>& work) const;
  void inverseKinematics(const Motion<S>& motion, ChainWorkspace<S>& work) const;
  JointVariables<S> angles(const ChainWorkspace<S>& work) const;
  JointVariables<S> rates(const ChainWorkspace<S>& work) const;
  JointVariables<S> accelerations(const ChainWorkspace<S>& work) const;

  /// Needs displacements.
  void jacobians(const Motion<S>& motion, ChainWorkspace<S>& work) const;
  Matrix6<S> T(const ChainWorkspace<S>& work) const;
  Matrix6<S> TRate(const Motion<S>& motion, const ChainWorkspace<S>& work) const;

  void bodyMotions(const Motion<S>& motion, const ChainWorkspace<S>& work, BodyMotions<S>& bodies) const;
  /// 78 × 6, for unit rates of the driven coordinates; zero rows for legs that are not there. Needs jacobians.
  void twistShaping(const Motion<S>& motion, const ChainWorkspace<S>& work,
                    Eigen::Matrix<S, 6 * body_count, motor_count>& shaping) const;

  Vector6<S> inverseDynamics(const Motion<S>& motion, ChainWorkspace<S>& work,
                             const Vector6<S>& load = Vector6<S>::Zero()) const;
  Vector6<S> directDynamics(const Motion<S>& motion, const Vector6<S>& efforts, ChainWorkspace<S>& work,
                            const Vector6<S>& load = Vector6<S>::Zero()) const;
  /// Needs displacements, or what inverseDynamics leaves.
  Matrix6<S> massMatrixAtP(const Motion<S>& motion, const ChainWorkspace<S>& work) const;

  /// The force, in B, that a leg puts on the platform at its joint under `efforts`, N. Needs inverseKinematics.
  Vector3<S> forceOnPlatform(const ChainWorkspace<S>& work, int leg, const Vector6<S>& efforts) const;

  const ChainModel<S>& leg(int i) const { return legs_[static_cast<std::size_t>(i)]; }
  const Vector3<S>& gravity() const { return gravity_; }

 private:
  const ChainModel<S>& model(int i) const { return legs_[static_cast<std::size_t>(i)]; }

  void place(const Motion<S>& motion, int leg, ChainState<S>& out) const;
  /// On the coordinates of a leg, friction included: by the recursion over its joints. Needs inverseKinematics.
  Vector3<S> legForces(const ChainWorkspace<S>& work, int leg) const;
  Vector6<S> platformWrench(const Motion<S>& motion) const;
  Vector6<S> wrenchAtP(const Motion<S>& motion, const ChainWorkspace<S>& work, Vector6<S>& Q_driven) const;

  std::array<ChainModel<S>, leg_count> legs_;
  int leg_count_;
  Motors motors_;
  Vector3<S> gravity_;
  S mass_;
  Vector3<S> rho_;
  Matrix3<S> I_M_;
  S length_;
  Reading reading_;
};

extern template class ChainSolver<double>;
extern template class ChainSolver<float>;
extern template class ChainSolver<double, SpoiltChain>;

}  // namespace ursula

#pragma once

#include "nocsolver/errors.h"
#include "nocsolver/noc/noc.h"
#include "parts/fast/fast_dynamics.h"

namespace ursula {

/// A Solver's intermediate results; each thread needs its own. Its size is fixed, so nothing is allocated.
template <class S>
using Workspace = NocWorkspace<S>;

/// Kinematics and dynamics of any machine, for users. Kinematics and Jacobians are those of Noc; dynamics are those of
/// FastDynamics, which every validation compares with Noc. Immutable; threads share it, each with its own Workspace.
/// Does not allocate.
///
/// Every function throws OutOfReach, OutOfStroke or PointOnAxis for poses beyond the legs. Rates and all later
/// quantities throw StretchedLeg. Functions that need B⁻¹ throw SingularJacobian. Non-finite efforts and twist rates
/// throw std::domain_error with the instant.
template <class S>
class Solver {
 public:
  explicit Solver(const Manipulator& manipulator) : noc_(manipulator), dynamics_(manipulator) {}

  const Noc<S>& noc() const { return noc_; }
  const MachineParameters<S>& machine() const { return noc_.machine(); }
  /// A length of the machine's size, m: the largest ‖bᵢ‖ or link.
  const S& length() const { return machine().length; }

  /// Displacements only: (3)–(5), (13), (14) and their counterparts for other kinds.
  void displacements(const Motion<S>& motion, Workspace<S>& work) const { noc_.displacements(motion, work); }
  /// Displacements, rates and accelerations of all joints, (1)–(19).
  void inverseKinematics(const Motion<S>& motion, Workspace<S>& work) const { noc_.inverseKinematics(motion, work); }

  /// The joint coordinates in `work`: angles in (−π, π] except ψ of (14b), and d in m.
  JointVariables<S> angles(const Workspace<S>& work) const { return noc_.angles(work); }
  JointVariables<S> rates(const Workspace<S>& work) const { return noc_.rates(work); }
  JointVariables<S> accelerations(const Workspace<S>& work) const { return noc_.accelerations(work); }

  /// How near leg i is to poses where its rates are undetermined. Needs displacements.
  LegMargins<S> margins(const Workspace<S>& work, int i) const { return work.legs[i].margins; }

  /// A, B of (23) and the factors of Bᵀ, from the displacements in `work`.
  void jacobians(const Motion<S>& motion, Workspace<S>& work) const { noc_.jacobians(motion, work); }
  /// B of (23); its rows are [Qb × n; n], n of length 1.
  const Matrix6<S>& B(const Workspace<S>& work) const { return work.B; }
  /// The determinant of Bᵀ, with its moment rows divided by the length. Needs jacobians.
  S determinant(const Workspace<S>& work) const { return work.B_transposed.determinant(); }
  /// T = B⁻¹A of (24), 6 × 6: t_P = T q̇ of the driven coordinates. Needs jacobians.
  Matrix6<S> T(const Workspace<S>& work) const { return noc_.platformShaping(work); }
  /// Ṫ of (25), (26). Needs inverseKinematics and jacobians.
  Matrix6<S> TRate(const Motion<S>& motion, const Workspace<S>& work) const {
    return noc_.platformShapingRate(motion, work);
  }

  /// Pose, twist and twist rate of all bodies, (16), (17), (39)–(43). Needs inverseKinematics.
  void bodyMotions(const Motion<S>& motion, const Workspace<S>& work, BodyMotions<S>& bodies) const {
    noc_.bodyMotions(motion, work, bodies);
  }

  /// Efforts of the motors by (37), N·m, or N for sliding coordinates, conjugate to their rates. `load` is an external
  /// wrench on the platform, [moment about P; force], in B. The workspace is unused.
  Vector6<S> inverseDynamics(const Motion<S>& motion, Workspace<S>&,
                             const Vector6<S>& load = Vector6<S>::Zero()) const {
    return finite(dynamics_.inverseDynamics(motion, load), "effort", motion.t);
  }

  /// The platform's twist rate [ω̇; p̈] under efforts, by (36) projected on t_P; ignores accelerations in `motion`.
  /// Does not throw SingularJacobian, because the motors act whether or not they determine the motion. The workspace is
  /// unused.
  Vector6<S> directDynamics(const Motion<S>& motion, const Vector6<S>& efforts, Workspace<S>&,
                            const Vector6<S>& load = Vector6<S>::Zero()) const {
    return finite(dynamics_.directDynamics(motion, efforts, load), "twist rate", motion.t);
  }

  /// M_P: the whole machine's mass matrix in the platform's twist at P. Needs displacements.
  Matrix6<S> massMatrixAtP(const Motion<S>& motion, const Workspace<S>& work) const {
    return noc_.massMatrixAtP(motion, work);
  }

 private:
  Noc<S> noc_;
  FastDynamics<S> dynamics_;
};

}  // namespace ursula

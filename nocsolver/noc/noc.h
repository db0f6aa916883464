#pragma once

#include <array>
#include <utility>

#include <Eigen/LU>

#include "model/joint_reactions.h"
#include "model/joint_variables.h"
#include "model/motion.h"
#include "nocsolver/errors.h"
#include "nocsolver/legs/reading.h"

namespace ursula {

/// Generalised twist and wrenches of (30a): six rows a body, in the order of BodyMotions.
template <class S>
using BodyVector = Eigen::Matrix<S, 6 * body_count, 1>;

/// The twist-shaping matrix of (32a), 78 × 6, rows in the order of (30a); zero rows for legs that are not there.
template <class S>
using TwistShaping = Eigen::Matrix<S, 6 * body_count, motor_count>;

/// Of all bodies about their mass centres, in B.
template <class S>
using BodyTensors = std::array<Matrix3<S>, body_count>;

/// Where the solver keeps what it finds; one for each thread. Fixed size: nothing is allocated.
template <class S>
struct NocWorkspace {
  Matrix3<S> Q;  ///< of the platform
  std::array<LegState<S>, leg_count> legs;
  Vector6<S> A;                                  ///< diagonal of A (23), a row a motor
  Matrix6<S> B;                                  ///< (23), rows [Qb × n; n] with n of length 1
  Eigen::PartialPivLU<Matrix6<S>> B_transposed;  ///< factors of Bᵀ, its moment rows over the length
  BodyMotions<S> bodies;
  BodyTensors<S> I_B;        ///< (46)
  Matrix6<S> T_P, T_P_rate;  ///< (24), (25)
  TwistShaping<S> T, T_rate;
};

/// The paper's method, for a platform on legs of any kinds, with the motors where they are: kinematics and Jacobians of
/// section 2, dynamics by the natural orthogonal complement of section 3 as it is printed. This is the formulation that
/// a validation judges. Written to be read beside the paper; fast/ has the same numbers without forming T.
///
/// The generalised speeds are the rates q̇ of the driven coordinates, φ̇ in the paper. Immutable: threads share it, each
/// with a workspace of its own. `Reading` is Corrected, or WithFormulaErrors for formulas that are wrong. Nothing here
/// allocates but where it is said.
///
/// Every function throws OutOfReach, OutOfStroke or PointOnAxis for poses that the legs cannot take, and from the rates
/// on StretchedLeg; those that need B⁻¹ throw SingularJacobian.
template <class S, class Reading = Corrected>
class Noc {
 public:
  explicit Noc(const Manipulator& manipulator, Reading reading = Reading{})
      : Noc(MachineParameters<S>(manipulator), std::move(reading)) {}
  explicit Noc(const MachineParameters<S>& machine, Reading reading = Reading{});

  const MachineParameters<S>& machine() const { return machine_; }

  // --- section 2: kinematics -----------------------------------------------------------------------------------------

  /// Displacements only: (3)–(5), (13), (14) and what is like them.
  void displacements(const Motion<S>& motion, NocWorkspace<S>& work) const;
  /// Displacements, rates and accelerations of all joints, (1)–(19).
  void inverseKinematics(const Motion<S>& motion, NocWorkspace<S>& work) const;

  /// What `work` holds: angles in (−π, π] but for ψ of (14b), and d in m.
  JointVariables<S> angles(const NocWorkspace<S>& work) const;
  JointVariables<S> rates(const NocWorkspace<S>& work) const;
  JointVariables<S> accelerations(const NocWorkspace<S>& work) const;

  /// A, B of (23) and the factors of Bᵀ, from the displacements in `work`.
  void jacobians(const Motion<S>& motion, NocWorkspace<S>& work) const;
  /// T = B⁻¹A of (24), 6 × 6: t_P = T q̇. Needs jacobians.
  Matrix6<S> platformShaping(const NocWorkspace<S>& work) const;
  /// Ṫ of (25), (26). Needs inverseKinematics and jacobians.
  Matrix6<S> platformShapingRate(const Motion<S>& motion, const NocWorkspace<S>& work) const;

  // --- section 3: dynamics -------------------------------------------------------------------------------------------

  /// Pose, twist and twist rate of all bodies, (16), (17), (39)–(43). Needs inverseKinematics.
  void bodyMotions(const Motion<S>& motion, const NocWorkspace<S>& work, BodyMotions<S>& bodies) const;
  /// T of (32a) by (47), (48), into `work`. Needs inverseKinematics and jacobians.
  void twistShaping(const Motion<S>& motion, NocWorkspace<S>& work) const;
  /// T and its rate, of (32b): ṫ = T q̈ + Ṫ q̇. Needs inverseKinematics and jacobians.
  void twistShapingRate(const Motion<S>& motion, NocWorkspace<S>& work) const;

  /// Efforts τ^a of the motors, N·m, or N where they push, conjugate to q̇, by (37); `load` is an external wrench on the
  /// platform, [moment about P; force], in B. Does all of inverseKinematics, jacobians and twistShaping on the way.
  Vector6<S> inverseDynamics(const Motion<S>& motion, NocWorkspace<S>& work,
                             const Vector6<S>& load = Vector6<S>::Zero()) const;

  /// The platform's twist rate [ω̇; p̈] under efforts, by (36) and (25); accelerations in `motion` are not read.
  Vector6<S> directDynamics(const Motion<S>& motion, const Vector6<S>& efforts, NocWorkspace<S>& work,
                            const Vector6<S>& load = Vector6<S>::Zero()) const;

  /// I = TᵀMT of (34), with the rotors' inertia. Needs what inverseDynamics leaves.
  Matrix6<S> I(const NocWorkspace<S>& work) const;
  /// C = Tᵀ(MṪ + WMT) of (34). Needs what directDynamics leaves.
  Matrix6<S> C(const NocWorkspace<S>& work) const;

  /// w^N of (31), 78: what is left of Newton and Euler when everything that works is taken off. Needs what
  /// inverseDynamics leaves.
  BodyVector<S> constraintWrench(const Motion<S>& motion, const Vector6<S>& efforts, const NocWorkspace<S>& work,
                                 const Vector6<S>& load = Vector6<S>::Zero()) const;

  /// D of the velocity constraints D t = 0 of (33), 12 rows a leg and 78 columns: at each joint what it does not let
  /// move, of its axes and points alone. Needs bodyMotions in `work`. Allocates.
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> D(const Motion<S>& motion, const NocWorkspace<S>& work) const;

  /// The reactions at the joints of all legs under `efforts`: the force of a leg on the platform by the leg's own share
  /// of (37), the others by (28) body by body. Needs what inverseDynamics leaves.
  Reactions reactions(const Motion<S>& motion, const Vector6<S>& efforts, const NocWorkspace<S>& work) const;

  /// M_P: the machine's mass matrix in the platform's twist at P, TᵀMT for t = T t_P. Needs displacements.
  Matrix6<S> massMatrixAtP(const Motion<S>& motion, const NocWorkspace<S>& work) const;

 private:
  using Rates = Eigen::Matrix<S, 3, 6>;    ///< of a leg's joints, a column of T each
  using Columns = Eigen::Matrix<S, 6, 3>;  ///< twists of a link, a unit rate of a joint each
  struct UnitTwists {
    Columns first, second, first_rate, second_rate;  ///< of the proximal and the distal link
  };

  void place(const Motion<S>& motion, int leg, LegState<S>& out) const;
  LinkMotions<S> links(int leg, const LegState<S>& at, const Vector3<S>& rate, const Vector3<S>& acceleration) const;
  void shape(const Motion<S>& motion, NocWorkspace<S>& work, bool with_rate) const;
  UnitTwists unitTwists(int leg, const LegState<S>& at, bool with_rate) const;
  Rates ratesForTwists(int leg, const LegState<S>& at, const Matrix6<S>& T_P) const;
  Rates columnRates(int leg, const LegState<S>& at, const Matrix6<S>& T_P) const;
  Rates columnAccelerations(const Motion<S>& motion, int leg, const NocWorkspace<S>& work, const Rates& rates) const;
  Vector3<S> columnAcceleration(const Motion<S>& motion, const NocWorkspace<S>& work, int motor,
                                const Vector3<S>& arm) const;
  void shapePlatform(const Vector3<S>& arm, const Matrix6<S>& T_P, TwistShaping<S>& T) const;
  Vector3<S> platformArm(const Motion<S>& motion) const;

  S massOf(int body) const;
  BodyTensors<S> tensors(const NocWorkspace<S>& work) const;
  bool hasRotors() const;
  Vector6<S> rotors() const;
  Vector6<S> rotorEfforts(const NocWorkspace<S>& work) const;
  void addOffLine(int leg, const LegState<S>& at, LinkMotions<S>& links) const;
  void setBodies(const Motion<S>& motion, NocWorkspace<S>& work) const;
  Vector6<S> M(int body, const NocWorkspace<S>& work, const Vector6<S>& x) const;
  Vector6<S> W(int body, const NocWorkspace<S>& work, const Vector6<S>& x) const;
  TwistShaping<S> massTimes(const BodyTensors<S>& tensors, const TwistShaping<S>& X) const;
  BodyVector<S> inertiaWrench(const NocWorkspace<S>& work) const;
  BodyVector<S> gravityWrench() const;
  BodyVector<S> dissipativeWrench(const NocWorkspace<S>& work) const;
  BodyVector<S> loadWrench(const Motion<S>& motion, const Vector6<S>& load) const;
  BodyVector<S> actuatorWrench(const NocWorkspace<S>& work, const Vector6<S>& efforts) const;
  void addJointWrench(const NocWorkspace<S>& work, int leg, int joint, const S& effort, BodyVector<S>& w) const;

  MachineParameters<S> machine_;
  Reading reading_;
};

extern template class Noc<double>;
extern template class Noc<long double>;
extern template class Noc<double, WithFormulaErrors>;

}  // namespace ursula

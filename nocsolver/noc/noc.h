#pragma once

#include <array>

#include <Eigen/LU>

#include "model/joint_variables.h"
#include "model/motion.h"
#include "nocsolver/errors.h"
#include "nocsolver/legs/leg_model.h"
#include "nocsolver/legs/leg_state.h"

namespace ursula {

/// Generalised twist and wrenches of (30a): six rows per body, in the order of BodyMotions.
template <class S>
using BodyVector = Eigen::Matrix<S, 6 * body_count, 1>;

/// The twist-shaping matrix of (32a), 78 × 6, rows in the order of (30a); missing legs have zero rows.
template <class S>
using TwistShaping = Eigen::Matrix<S, 6 * body_count, motor_count>;

/// Inertia tensors of all bodies about their mass centres, in B.
template <class S>
using BodyTensors = PerBody<Matrix3<S>>;

/// The solver's intermediate results; each thread needs its own. Its size is fixed, so nothing is allocated.
template <class S>
struct NocWorkspace {
  Matrix3<S> Q;  ///< of the platform
  PerLeg<LegState<S>> legs;
  Vector6<S> A;                                  ///< diagonal of A (23), one row per motor
  Matrix6<S> B;                                  ///< (23), rows [Qb × n; n] with n of length 1
  Eigen::PartialPivLU<Matrix6<S>> B_transposed;  ///< factors of Bᵀ, its moment rows divided by the length
  BodyMotions<S> bodies;
  BodyTensors<S> I_B;        ///< (46)
  Matrix6<S> T_P, T_P_rate;  ///< (24), (25)
  TwistShaping<S> T, T_rate;
};

/// The paper's method for a platform on legs of any kinds with any motors, with the corrections that docs/equations.md
/// names. Section 2 gives kinematics and Jacobians, section 3 dynamics by the natural orthogonal complement. A
/// validation judges this formulation. It is written to be read beside the paper; parts/fast/ gives the same numbers
/// without forming T.
///
/// The generalised speeds are the rates q̇ of the driven coordinates, φ̇ in the paper. Immutable; threads share it, each
/// with its own workspace. Only functions that say so allocate. The virtual functions let tests derive wrong formulas
/// (parts/wrong_formulas/).
///
/// Every function throws OutOfReach, OutOfStroke or PointOnAxis for poses beyond the legs. Rates and all later
/// quantities throw StretchedLeg. Functions that need B⁻¹ throw SingularJacobian.
template <class S>
class Noc {
 public:
  explicit Noc(const Manipulator& manipulator) : Noc(MachineParameters<S>(manipulator)) {}
  explicit Noc(const MachineParameters<S>& machine) : machine_(machine) {}
  virtual ~Noc() = default;
  Noc(const Noc&) = default;
  Noc(Noc&&) noexcept = default;
  Noc& operator=(const Noc&) = default;
  Noc& operator=(Noc&&) noexcept = default;

  const MachineParameters<S>& machine() const { return machine_; }

  // --- section 2: kinematics -----------------------------------------------------------------------------------------

  /// Displacements only: (3)–(5), (13), (14) and their counterparts for other kinds.
  void displacements(const Motion<S>& motion, NocWorkspace<S>& work) const;
  /// Displacements, rates and accelerations of all joints, (1)–(19).
  void inverseKinematics(const Motion<S>& motion, NocWorkspace<S>& work) const;

  /// The joint coordinates in `work`: angles in (−π, π] except ψ of (14b), and d in m.
  virtual JointVariables<S> angles(const NocWorkspace<S>& work) const;
  JointVariables<S> rates(const NocWorkspace<S>& work) const;
  JointVariables<S> accelerations(const NocWorkspace<S>& work) const;

  /// A, B of (23) and the factors of Bᵀ, from the displacements in `work`.
  void jacobians(const Motion<S>& motion, NocWorkspace<S>& work) const;
  /// T = B⁻¹A of (24), 6 × 6: t_P = T q̇. Needs jacobians.
  Matrix6<S> platformShaping(const NocWorkspace<S>& work) const;
  /// Ṫ of (25), (26). Needs inverseKinematics and jacobians.
  virtual Matrix6<S> platformShapingRate(const Motion<S>& motion, const NocWorkspace<S>& work) const;

  // --- section 3: dynamics -------------------------------------------------------------------------------------------

  /// Pose, twist and twist rate of all bodies, (16), (17), (39)–(43). Needs inverseKinematics.
  virtual void bodyMotions(const Motion<S>& motion, const NocWorkspace<S>& work, BodyMotions<S>& bodies) const;
  /// T of (32a) by (47), (48), into `work`. Needs inverseKinematics and jacobians.
  void twistShaping(const Motion<S>& motion, NocWorkspace<S>& work) const;
  /// T and its rate, of (32b): ṫ = T q̈ + Ṫ q̇. Needs inverseKinematics and jacobians.
  void twistShapingRate(const Motion<S>& motion, NocWorkspace<S>& work) const;

  /// Efforts τ^a of the motors by (37), N·m, or N for sliding coordinates, conjugate to q̇. `load` is an external wrench
  /// on the platform, [moment about P; force], in B. Includes inverseKinematics, jacobians and twistShaping.
  virtual Vector6<S> inverseDynamics(const Motion<S>& motion, NocWorkspace<S>& work,
                                     const Vector6<S>& load = Vector6<S>::Zero()) const;

  /// The platform's twist rate [ω̇; p̈] under efforts, by (36) and (25); ignores accelerations in `motion`.
  Vector6<S> directDynamics(const Motion<S>& motion, const Vector6<S>& efforts, NocWorkspace<S>& work,
                            const Vector6<S>& load = Vector6<S>::Zero()) const;

  /// I = TᵀMT of (34), with the rotor inertias. Needs the results of inverseDynamics.
  Matrix6<S> I(const NocWorkspace<S>& work) const;
  /// C = Tᵀ(MṪ + WMT) of (34). Needs the results of directDynamics.
  virtual Matrix6<S> C(const NocWorkspace<S>& work) const;

  /// w^N of (31), 78: the remainder of the Newton–Euler equations without all wrenches that do work. Needs the results
  /// of inverseDynamics.
  BodyVector<S> constraintWrench(const Motion<S>& motion, const Vector6<S>& efforts, const NocWorkspace<S>& work,
                                 const Vector6<S>& load = Vector6<S>::Zero()) const;

  /// D of the velocity constraints D t = 0 of (33), 12 rows per leg and 78 columns. It holds each joint's blocked
  /// directions, from axes and points only. Needs bodyMotions in `work`. Allocates.
  virtual Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> D(const Motion<S>& motion,
                                                             const NocWorkspace<S>& work) const;

  /// Reactions at the joints of all legs under `efforts`. A leg's force on the platform follows from its part of (37),
  /// the others body by body from (28). Needs the results of inverseDynamics.
  Reactions reactions(const Motion<S>& motion, const Vector6<S>& efforts, const NocWorkspace<S>& work) const;

  /// M_P = TᵀMT for t = T t_P: the machine's mass matrix in the platform's twist at P. Needs displacements.
  Matrix6<S> massMatrixAtP(const Motion<S>& motion, const NocWorkspace<S>& work) const;

 protected:
  using Rates = Eigen::Matrix<S, 3, 6>;    ///< of a leg's joints, one column per column of T
  using Columns = Eigen::Matrix<S, 6, 3>;  ///< twists of a link, one column per unit joint rate

  // A leg's formulas, by its kind (legs/). `at` moves as in the motion; rates and accelerations may be those of a
  // column of T.
  virtual void displacement(int leg, const S& t, LegState<S>& out) const;  ///< from AB in `out`
  virtual void rows(int leg, LegState<S>& out) const;
  virtual void rowRates(int leg, LegState<S>& out) const;
  virtual Vector3<S> jointRates(int leg, const LegState<S>& at, const Vector3<S>& v_B) const;
  virtual Vector3<S> jointAccelerations(int leg, const LegState<S>& at, const Vector3<S>& rate, const Vector3<S>& v_B,
                                        const Vector3<S>& a_B) const;
  /// Twists of the points on the links' lines.
  virtual LinkMotions<S> onLines(int leg, const LegState<S>& at, const Vector3<S>& rate, const Vector3<S>& acceleration,
                                 bool with_rates) const;
  /// Moves these to the mass centres.
  virtual void addOffLine(int leg, const LegState<S>& at, LinkMotions<S>& links) const;
  static void setFrames(const LegModel<S>& leg, LegState<S>& out);

  virtual Rates columnRates(int leg, const LegState<S>& at, const Matrix6<S>& T_P) const;
  virtual Vector3<S> columnArm(const Motion<S>& motion) const;
  virtual Vector3<S> sphericalPoint(const Motion<S>& motion, int leg, const LegState<S>& at) const;

  virtual S massOf(int body) const;
  virtual BodyTensors<S> tensors(const NocWorkspace<S>& work) const;
  virtual Vector6<S> rotors() const;
  virtual Vector6<S> W(int body, const NocWorkspace<S>& work, const Vector6<S>& x) const;
  virtual BodyVector<S> gravityWrench() const;
  virtual BodyVector<S> dissipativeWrench(const NocWorkspace<S>& work) const;
  virtual BodyVector<S> loadWrench(const Motion<S>& motion, const Vector6<S>& load) const;
  virtual Vector6<S> tauG(const Motion<S>& motion, const NocWorkspace<S>& work, const Vector6<S>& load) const;
  virtual Vector6<S> tauD(const NocWorkspace<S>& work) const;
  BodyVector<S> inertiaWrench(const NocWorkspace<S>& work) const;
  TwistShaping<S> massTimes(const BodyTensors<S>& tensors, const TwistShaping<S>& X) const;
  Vector3<S> platformArm(const Motion<S>& motion) const;

 private:
  struct UnitTwists {
    Columns first, second, first_rate, second_rate;  ///< of the proximal and the distal link
  };

  void place(const Motion<S>& motion, int leg, LegState<S>& out) const;
  LinkMotions<S> links(int leg, const LegState<S>& at, const Vector3<S>& rate, const Vector3<S>& acceleration,
                       bool with_rates) const;
  void shape(const Motion<S>& motion, NocWorkspace<S>& work, bool with_rate) const;
  UnitTwists unitTwists(int leg, const LegState<S>& at, bool with_rate) const;
  Rates ratesForTwists(int leg, const LegState<S>& at, const Matrix6<S>& T_P) const;
  Rates columnAccelerations(const Motion<S>& motion, int leg, const NocWorkspace<S>& work, const Rates& rates) const;
  Vector3<S> columnAcceleration(const Motion<S>& motion, const NocWorkspace<S>& work, int motor,
                                const Vector3<S>& arm) const;
  void shapePlatform(const Vector3<S>& arm, const Matrix6<S>& T_P, TwistShaping<S>& T) const;

  bool hasRotors() const;
  Vector6<S> rotorEfforts(const NocWorkspace<S>& work) const;
  void setBodies(const Motion<S>& motion, NocWorkspace<S>& work) const;
  Vector6<S> M(int body, const NocWorkspace<S>& work, const Vector6<S>& x) const;
  BodyVector<S> actuatorWrench(const NocWorkspace<S>& work, const Vector6<S>& efforts) const;
  void addJointWrench(const NocWorkspace<S>& work, int leg, int joint, const S& effort, BodyVector<S>& w) const;

  MachineParameters<S> machine_;
};

extern template class Noc<double>;

}  // namespace ursula

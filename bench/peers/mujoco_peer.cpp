// How a user with the joints' motion calls MuJoCo: the fewest calls that suffice.

#include <Eigen/Geometry>
#include <algorithm>

#include "bench/peers/closed_rates.h"
#include "bench/peers/peer.h"
#include "parts/engines/closing.h"
#include "parts/engines/mujoco/mujoco_loop_internal.h"

namespace ursula::bench {
namespace {

using mujoco::dofOf, mujoco::most_dofs, mujoco::VectorOfDofs;

class MujocoPeer : public Peer {
 public:
  explicit MujocoPeer(const Manipulator& manipulator)
      : manipulator_(manipulator), loop_(manipulator), at_(loop_.impl()) {}

  std::string name() const override { return "MuJoCo"; }
  std::string version() const override { return mujocoVersion(); }

  void coordinates(const Motion<double>& motion, const JointMotion& joints, TreeCoordinates& out) const override {
    out.motion = motion;
    out.q.resize(static_cast<std::size_t>(at_.dofs + 1));
    out.u.resize(static_cast<std::size_t>(at_.dofs));
    out.u_dot.resize(out.u.size());
    for (int leg = 0; leg < at_.legs; ++leg) {
      for (int joint = 0; joint < mujoco::joints_per_leg; ++joint) {
        const auto at = static_cast<std::size_t>(dofOf(leg, joint));
        const Leg& from = at_.manipulator.leg(leg);
        const Coordinate coordinate = rowOf(from.kind).coordinates[static_cast<std::size_t>(joint)];
        out.q[at] = joints.q.of(coordinate)(leg) + (joint == 0 ? at_.offset_of_phi[static_cast<std::size_t>(leg)] : 0);
        out.u[at] = joints.q_dot.of(coordinate)(leg);
        out.u_dot[at] = joints.q_ddot.of(coordinate)(leg);
      }
    }
    const Vector3d arm = motion.Q * at_.manipulator.platform().center_of_mass, v = motion.omega.cross(arm);
    const Eigen::Quaterniond Q(motion.Q);
    Eigen::Map<Eigen::Matrix<double, 7, 1>>(out.q.data() + at_.leg_dofs) << (motion.p - at_.origin) + arm, Q.w(),
        Q.vec();
    Eigen::Map<Vector6d>(out.u.data() + at_.leg_dofs) << motion.p_dot + v, motion.Q.transpose() * motion.omega;
    Eigen::Map<Vector6d>(out.u_dot.data() + at_.leg_dofs)
        << motion.p_ddot + motion.omega_dot.cross(arm) + motion.omega.cross(v),
        motion.Q.transpose() * motion.omega_dot;
  }

  Vector6d inverseDynamics(const TreeCoordinates& at) override {
    place(at);
    std::copy(at.u_dot.begin(), at.u_dot.end(), at_.data->qacc);
    at_.readTree(at.motion, at_.forcesOfTree(), tree_);
    return closedEfforts(tree_, manipulator_);
  }
  Vector6d directDynamics(const TreeCoordinates& at, const Vector6d& efforts) override {
    readMasses(at);
    return twistRate(at.motion, closedRates(tree_, masses_, manipulator_, efforts));
  }

 protected:
  void place(const TreeCoordinates& at) {
    std::copy(at.q.begin(), at.q.end(), at_.data->qpos);
    std::copy(at.u.begin(), at.u.end(), at_.data->qvel);
    mj_kinematics(at_.model.get(), at_.data.get());
    mj_comPos(at_.model.get(), at_.data.get());
    mj_comVel(at_.model.get(), at_.data.get());
  }

  /// Uses mj_rne without accelerations, mj_crb, mj_jacSite and mj_rnePostConstraint; ignores accelerations in `at`.
  void readMasses(const TreeCoordinates& at) {
    using SquareOfDofs = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, most_dofs, most_dofs>;
    place(at);
    VectorOfDofs forces(at_.dofs);
    mj_rne(at_.model.get(), at_.data.get(), 0, forces.data());
    at_.readTree(at.motion, forces, tree_);
    mj_crb(at_.model.get(), at_.data.get());
    SquareOfDofs mass(at_.dofs, at_.dofs);
    mj_fullM(at_.model.get(), mass.data(), at_.data->qM);
    std::fill_n(at_.data->qacc, at_.dofs, 0.0);
    mj_rnePostConstraint(at_.model.get(), at_.data.get());
    const mujoco::VectorOfGaps drift = -at_.gapAcceleration();
    for (int i = 0; i < at_.legs; ++i) {
      masses_.legs[static_cast<std::size_t>(i)] = mass.block<3, 3>(dofOf(i, 0), dofOf(i, 0));
      masses_.drift[static_cast<std::size_t>(i)] = drift.segment<3>(3 * i);
    }
    masses_.platform = mass.bottomRightCorner<6, 6>();
  }

  /// Converts rates of MuJoCo's free joint to [ω̇; p̈]; they are linear at the mass centre in the world, angular in the
  /// body.
  Vector6d twistRate(const Motion<double>& motion, const Vector6d& rates_of_speeds) const {
    const Vector3d arm = motion.Q * manipulator_.platform().center_of_mass;
    Vector6d out;
    out.head<3>() = motion.Q * rates_of_speeds.tail<3>();
    out.tail<3>() = rates_of_speeds.head<3>() - out.head<3>().cross(arm) - motion.omega.cross(motion.omega.cross(arm));
    return out;
  }

  Manipulator manipulator_;
  MujocoLoop loop_;
  MujocoLoop::Impl& at_;
  OpenTree tree_;
  OpenTreeMasses masses_;
};

/// MuJoCo's own `connect` constraints are soft by design: a share of about 1 − the impedance of an unconstrained gap's
/// acceleration remains. They also omit J̇ q̇.
class SoftMujocoPeer : public MujocoPeer {
 public:
  using MujocoPeer::MujocoPeer;

  std::string name() const override { return "MuJoCo, soft"; }
  bool hasInverse() const override { return false; }
  Vector6d directDynamics(const TreeCoordinates& at, const Vector6d& efforts) override {
    if (!connected_.model) connected_ = mujoco::connected(manipulator_, at_.origin, at.q.data());
    const mjModel* model = connected_.model.get();
    mjData* data = connected_.data.get();
    std::copy(at.q.begin(), at.q.end(), data->qpos);
    std::copy(at.u.begin(), at.u.end(), data->qvel);
    const VectorOfDofs given = at_.given(*model, *data, at.motion);
    std::copy_n(given.data(), at_.dofs, data->qfrc_applied);
    for (int m = 0; m < motor_count; ++m) {
      const Motor& motor = manipulator_.motors()[static_cast<std::size_t>(m)];
      data->qfrc_applied[dofOf(motor.leg, motor.joint)] += efforts(m);
    }
    mj_forward(model, data);
    return twistRate(at.motion, Eigen::Map<const Vector6d>(data->qacc + at_.leg_dofs));
  }

  /// Compares the loop closed exactly, with J̇ q̇ and without.
  Deviation deviation(const TreeCoordinates& at, const Vector6d& efforts) override {
    readMasses(at);
    const Vector6d with = closedRates(tree_, masses_, manipulator_, efforts);
    for (Vector3d& drift : masses_.drift) drift.setZero();
    const Vector6d without = closedRates(tree_, masses_, manipulator_, efforts);
    const Vector6d change = changeOfRates(tree_, masses_, manipulator_, efforts, 1 - mjMAXIMP);
    return {twistRate(at.motion, without) - twistRate(at.motion, with), change};
  }

 private:
  mujoco::Connected connected_;  ///< made on first use
};

}  // namespace

std::unique_ptr<Peer> makeMujocoPeer(const Manipulator& manipulator) {
  return std::make_unique<MujocoPeer>(manipulator);
}

std::unique_ptr<Peer> makeSoftMujocoPeer(const Manipulator& manipulator) {
  return std::make_unique<SoftMujocoPeer>(manipulator);
}

}  // namespace ursula::bench

#include "model/check_names.h"

namespace ursula {

const std::vector<CheckName>& checkNames() {
  using N = CheckNeeds;
  static const std::vector<CheckName> names = {
      {"motion.pose", "m", N::nothing},
      {"motion.twist", "m/s", N::nothing},
      {"motion.twist_rate", "m/s^2", N::nothing},
      {"motion.load", "N, N m", N::load_history},
      {"kinematics.joint_angles", "rad", N::kinematics},
      {"kinematics.joint_rates", "rad/s", N::kinematics},
      {"kinematics.joint_accelerations", "rad/s^2", N::kinematics},
      {"kinematics.positions", "m", N::kinematics},
      {"kinematics.twists", "m/s", N::kinematics},
      {"kinematics.accelerations", "m/s^2", N::kinematics},
      {"kinematics.jacobian", "m/s", N::kinematics},
      {"kinematics.jacobian_rate", "m/s^2", N::kinematics},
      {"kinematics.jacobian_difference", "m/s", N::kinematics},
      {"torque.pointwise", "N m", N::nothing},
      {"acceleration.pointwise", "m/s^2", N::nothing},
      {"torque.against_noc", "N m", N::torque_file},
      {"torque.twin", "N m", N::any_instant},
      {"torque.maximal", "N m", N::any_instant},
      {"torque.mujoco", "N m", N::further_engine},
      {"complement.orthogonality", "", N::own_complement},
      {"complement.rank", "", N::own_complement},
      {"invariance.rotation", "N m", N::other_machines},
      {"invariance.axes", "N m", N::other_machines},
      {"invariance.units", "N m", N::other_machines},
      {"invariance.labels", "N m", N::other_machines},
      {"invariance.mass", "N m", N::other_machines},
      {"invariance.time_reversal", "N m", N::other_machines},
      {"reactions.pointwise", "N", N::own_reactions},
      {"torque.between", "N m", N::any_instant},
      {"direct.pointwise", "m/s^2", N::direct_dynamics},
      {"direct.off_path", "m/s^2", N::direct_dynamics},
      {"fast.inverse", "N m", N::nothing},
      {"fast.direct", "m/s^2", N::nothing},
      {"fast.inverse_batch", "N m", N::nothing},
      {"fast.direct_batch", "m/s^2", N::nothing},
      {"replay.position", "m", N::nothing},
      {"replay.orientation", "rad", N::nothing},
      {"closure.position", "m", N::nothing},
      {"closure.velocity", "m/s", N::nothing},
      {"energy.balance", "J", N::nothing},
      {"integration.ladder", "m", N::any_instant},
      {"integration.second", "m", N::any_instant},
      {"integration.order", "", N::any_instant},
      {"feedback.torque", "N m", N::any_instant},
  };
  return names;
}

std::vector<std::string> namesOfChecks() {
  std::vector<std::string> out;
  for (const CheckName& check : checkNames()) out.emplace_back(check.name);
  return out;
}

}  // namespace ursula

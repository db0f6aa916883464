#include "parts/engines/closed_mechanism.h"

namespace ursula {

ClosedMechanism::ClosedMechanism(const Mechanism& mechanism, BuildTree* build)
    : mechanism_(mechanism),
      welded_(mechanism_),
      tree_(build(mechanism_, welded_)),
      closing_(mechanism_, welded_, tree_.cut, *tree_.speeds) {}

std::vector<std::size_t> ClosedMechanism::cutJoints() const {
  std::vector<std::size_t> out;
  for (const std::size_t j : tree_.cut) {
    const MechanismJoint& joint = mechanism_.joints()[j];
    if (joint.kind != JointKind::free && welded_.parentOf(joint) != welded_.childOf(joint)) out.push_back(j);
  }
  return out;
}

/// Engines weigh the whole mass of a body, in its centre.
Eigen::VectorXd ClosedMechanism::missingWeights() const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(tree_.speeds->count());
  for (std::size_t w = 1; w < welded_.welds.size(); ++w) {
    const WeldedBodies& weld = welded_.welds[w];
    if (weld.weight == weld.mass) continue;
    const Vector3d &g = mechanism_.gravity(), arm = tree_.speeds->state(w).R * weld.weight_arm;
    Vector6d missing;
    missing << -arm.cross(weld.weight * g), (weld.mass - weld.weight) * g;
    tree_.speeds->addRow(w, missing, out);
  }
  return out;
}

Eigen::VectorXd ClosedMechanism::efforts(Recipe recipe, const MotorMotion& motion) {
  const bool own = recipe == Recipe::own_inverse || recipe == Recipe::own_inverse_hard;
  closing_.place(motion, recipe == Recipe::no_bias ? MechanismClosing::Bias::left_out : MechanismClosing::Bias::kept);
  const Eigen::VectorXd& u_dot = closing_.accelerations();
  const Eigen::VectorXd f =
      (own ? tree_.speeds->ownInverse(u_dot, recipe == Recipe::own_inverse_hard) : tree_.speeds->forces(u_dot)) +
      missingWeights() - closing_.loads();
  if (own || recipe == Recipe::open) return closing_.atMotors(f);
  if (recipe == Recipe::least_squares) return closing_.leastEfforts(f);
  return tree_.speeds->isTree() ? closing_.effortsByComplement(f) : closing_.effortsByMultipliers(f);
}

}  // namespace ursula

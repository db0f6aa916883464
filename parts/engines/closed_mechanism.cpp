#include "parts/engines/closed_mechanism.h"

#include <stdexcept>

namespace ursula {

MechanismCalls::Moved MechanismCalls::start(const Rigidity&, const MotorMotion&) {
  throw std::logic_error("the engine moves no mechanism in time");
}
void MechanismCalls::step(const Eigen::VectorXd&) { throw std::logic_error("the engine moves no mechanism in time"); }
MechanismCalls::Moved MechanismCalls::moved() const { throw std::logic_error("the engine moves no mechanism in time"); }

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

MechanismCalls::Moved ClosedMechanism::start(const Rigidity& rigidity, const MotorMotion& motion) {
  closing_.place(motion);
  tree_.speeds->startTime(rigidity);
  closing_.take(Eigen::VectorXd(closing_.speeds()));
  return moved();
}

void ClosedMechanism::step(const Eigen::VectorXd& efforts) {
  closing_.take(tree_.speeds->stepTime(closing_.onSpeeds(efforts) + closing_.loads() - missingWeights()));
}

double ClosedMechanism::energy() const {
  double out = closing_.energyOfRotors();
  for (std::size_t w = 1; w < welded_.welds.size(); ++w) {
    const WeldedBodies& weld = welded_.welds[w];
    const WeldState& at = tree_.speeds->state(w);
    const Vector3d omega = at.R.transpose() * at.w;
    out += (weld.mass * at.v.squaredNorm() + omega.dot(weld.inertia * omega)) / 2 -
           weld.weight * mechanism_.gravity().dot(at.c + at.R * weld.weight_arm);
  }
  return out;
}

MechanismCalls::Moved ClosedMechanism::moved() const {
  const std::size_t weld = welded_.of_body[mechanism_.output()];
  const WeldState& at = tree_.speeds->state(weld);
  const Vector3d center = mechanism_.bodies()[mechanism_.output()].center_of_mass - welded_.welds[weld].center;
  return {closing_.motorValues(), welded_.welds[0].center + at.c + at.R * center, closing_.gap(), energy(),
          closing_.loads().dot(closing_.speeds())};
}

}  // namespace ursula

#include <Eigen/QR>

#include "parts/exchange/recognise/chains.h"

namespace ursula::exchange {
namespace {

constexpr std::size_t most_bodies = 60;

/// Returns the directions in which a joint lets its child move relative to its parent, as columns: rotations about the
/// joint's centre in rows 0 to 2, its velocity in rows 3 to 5.
Eigen::MatrixXd freedomsOf(const GraphJoint& joint) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(6, joint.kind == JointKind::ball        ? 3
                                                 : joint.kind == JointKind::universal ? 2
                                                                                      : 1);
  if (joint.kind == JointKind::ball)
    out.topRows<3>().setIdentity();
  else
    for (Eigen::Index k = 0; k < out.cols(); ++k)
      out.block<3, 1>(joint.kind == JointKind::prismatic ? 3 : 0, k) = joint.axis[k];
  return out;
}

/// Bodies that are connected with the fixed ones by moving joints, and these joints.
struct Connected {
  std::vector<int> number;  ///< of each group; 0 for fixed ones, −1 for others
  std::vector<const GraphJoint*> joints;
  int count = 0;

  Connected(const ModelGraph& graph, const Groups& groups, const ImportChoices& choices)
      : number(groups.groups.size(), -1) {
    for (std::size_t i = 0; i < groups.groups.size(); ++i)
      if (groups.groups[i].fixed) number[i] = 0;
    if (!choices.base.empty()) number[groups.group_of[bodyNamed(graph, choices.base, "--base")]] = 0;
    for (bool grows = true; grows;) {
      grows = false;
      for (const GraphJoint& joint : graph.joints) {
        int &a = number[groups.group_of[joint.parent]], &b = number[groups.group_of[joint.child]];
        if (joint.kind == JointKind::free || (a < 0) == (b < 0)) continue;
        (a < 0 ? a : b) = ++count;
        grows = true;
      }
    }
    for (const GraphJoint& joint : graph.joints)
      if (joint.kind != JointKind::free && joint.kind != JointKind::fixed && number[groups.group_of[joint.parent]] >= 0)
        joints.push_back(&joint);
  }
};

/// Returns the rank by the widest gap of the pivots below 1e-2, since loops are redundant and files have few digits.
int rankOf(const Eigen::MatrixXd& rows) {
  const Eigen::VectorXd pivots =
      Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(rows).matrixR().diagonal().cwiseAbs() / rows.norm();
  Eigen::Index rank = 0;
  double widest = 0;
  for (Eigen::Index k = 0; k < pivots.size(); ++k) {
    const double next = k + 1 < pivots.size() ? std::max(pivots(k + 1), 1e-9) : 1e-9;
    if (next > 1e-2 * pivots(0) || !(pivots(k) / next > widest)) continue;
    widest = pivots(k) / next;
    rank = k + 1;
  }
  return static_cast<int>(rank);
}

}  // namespace

std::optional<int> freedomsOf(const ModelGraph& graph, const Groups& groups, const ImportChoices& choices) {
  if (graph.joints.size() > 1000) return {};
  const Connected machine(graph, groups, choices);
  if (machine.count == 0 || machine.joints.size() > 2 * most_bodies) return {};
  double size = 0;
  for (const GraphJoint* joint : machine.joints)
    size = std::max(size, (joint->centre - machine.joints[0]->centre).norm());
  // A body's velocities are ω and that of the point of it at the origin, divided by the size; each joint forbids what
  // is across its freedoms.
  Eigen::MatrixXd forbidden =
      Eigen::MatrixXd::Zero(6 * static_cast<Eigen::Index>(machine.joints.size()), 6 * machine.count);
  for (std::size_t j = 0; j < machine.joints.size(); ++j) {
    const GraphJoint& joint = *machine.joints[j];
    const Vector3d centre = (joint.centre - machine.joints[0]->centre) / (size > 0 ? size : 1);
    Matrix6d at_centre = Matrix6d::Identity();
    for (int k = 0; k < 3; ++k) at_centre.block<3, 1>(3, k) = Vector3d::Unit(k).cross(centre);
    const Eigen::MatrixXd free = freedomsOf(joint);
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> basis(free);
    Matrix6d across = basis.householderQ();
    across = across.transpose().eval() * at_centre;
    across.topRows(free.cols()).setZero();
    const Eigen::Index row = 6 * static_cast<Eigen::Index>(j);
    for (const auto& [body, sign] : {std::pair(joint.child, 1.0), std::pair(joint.parent, -1.0)})
      if (const int number = machine.number[groups.group_of[body]]; number > 0)
        forbidden.block<6, 6>(row, 6 * (number - 1)) += sign * across;
  }
  return 6 * machine.count - rankOf(forbidden);
}

}  // namespace ursula::exchange

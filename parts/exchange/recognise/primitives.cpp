#include "parts/exchange/recognise/chains.h"

namespace ursula::exchange {

void append(const ModelGraph& graph, const Groups& groups, std::size_t index, bool outwards, Chain& chain) {
  const GraphJoint& joint = graph.joints[index];
  const Eigen::Isometry3d &parent = groups.moved[joint.parent], &child = groups.moved[joint.child];
  const Eigen::Isometry3d closing = joint.isOpen() ? joint.closing() : Eigen::Isometry3d::Identity();
  const Eigen::Isometry3d step = parent * closing * child.inverse();
  const Vector3d on_parent = parent * joint.centre, on_child = child * joint.centre_of_child;
  const auto add = [&](Primitive::Kind kind, const Vector3d& axis, bool on_cross = false) {
    const Vector3d of_parent = parent.linear() * axis, of_child = child.linear() * joint.turn.transpose() * axis;
    Primitive primitive;
    primitive.joint = index;
    primitive.kind = kind;
    primitive.inner = outwards ? on_parent : on_child;
    primitive.outer = outwards ? on_child : on_parent;
    primitive.axis = outwards ? of_parent : Vector3d(-of_child);
    primitive.outer_axis = outwards ? of_child : Vector3d(-of_parent);
    if (on_cross)
      primitive.inner = primitive.outer, primitive.axis = primitive.outer_axis;
    else
      primitive.step = outwards ? step : step.inverse();
    chain.primitives.push_back(primitive);
  };
  switch (joint.kind) {
    case JointKind::revolute:
      return add(Primitive::Kind::R, joint.axis[0]);
    case JointKind::prismatic:
      return add(Primitive::Kind::P, joint.axis[0]);
    case JointKind::ball:
      return add(Primitive::Kind::S, Vector3d::Zero());
    case JointKind::universal:
      add(Primitive::Kind::R, joint.axis[outwards ? 0 : 1]);
      return add(Primitive::Kind::R, joint.axis[outwards ? 1 : 0], true);
    case JointKind::fixed:
    case JointKind::free:
      break;
  }
}

void meet(Primitive& joint, bool at_platform, Eigen::Isometry3d& beyond) {
  joint.inner = beyond * joint.inner;
  joint.axis = beyond.linear() * joint.axis;
  if (at_platform) return;
  beyond = beyond * joint.step;
  joint.outer = joint.inner;
  joint.outer_axis = joint.axis;
}

}  // namespace ursula::exchange

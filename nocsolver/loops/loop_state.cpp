#include "nocsolver/loops/loop_state.h"

namespace ursula::loops {
const FrameState& Frames::at(int element) const { return element < 0 ? ground_ : frames_[element]; }

Eigen::Isometry3d Frames::displacement(int element) const {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() = at(element).R;
  out.translation() = at(element).d;
  return out;
}

void Frames::place(const LoopPose& pose) {
  for (std::size_t e = 0; e < frames_.size(); ++e) {
    const Element& element = tree_->elements[e];
    const FrameState& before = at(element.before);
    FrameState& frame = frames_[e];
    frame.before = before.R;
    frame.R = before.R;
    frame.d = before.d;
    const Vector3d centre = before.R * element.centre + before.d;
    const double q = pose.q(element.first);
    if (element.kind == ElementKind::slide) {
      frame.axis = before.R * element.axis;
      frame.d += q * frame.axis;
      frame.point = centre + q * frame.axis;
      continue;
    }
    if (element.kind == ElementKind::turn) {
      frame.axis = before.R * element.axis;
      frame.R = before.R * Eigen::AngleAxisd(q, element.axis).toRotationMatrix();
    } else {
      frame.R = before.R * pose.balls[e].toRotationMatrix();
    }
    frame.d = centre - frame.R * element.centre;
    frame.point = centre;
  }
}

void Frames::move(const VectorXd& u, const VectorXd& u_dot) {
  for (std::size_t e = 0; e < frames_.size(); ++e) {
    const Element& element = tree_->elements[e];
    const FrameState& before = at(element.before);
    FrameState& frame = frames_[e];
    const Vector3d r = frame.point - before.point;
    const Vector3d& w = before.omega;
    frame.v = before.v + w.cross(r);
    frame.a = before.a + before.alpha.cross(r) + w.cross(w.cross(r));
    frame.omega = w;
    frame.alpha = before.alpha;
    if (element.kind == ElementKind::slide) {
      const Vector3d along = frame.axis * u(element.first);
      frame.v += along;
      frame.a += 2 * w.cross(along) + frame.axis * u_dot(element.first);
      continue;
    }
    const Vector3d turn = element.kind == ElementKind::turn ? Vector3d(frame.axis * u(element.first))
                                                            : Vector3d(frame.before * u.segment<3>(element.first));
    const Vector3d turn_rate = element.kind == ElementKind::turn
                                   ? Vector3d(frame.axis * u_dot(element.first))
                                   : Vector3d(frame.before * u_dot.segment<3>(element.first));
    frame.omega += turn;
    frame.alpha += turn_rate + w.cross(turn);
  }
}

PointMotion Frames::pointOf(int element, const Vector3d& reference) const {
  const FrameState& frame = at(element);
  PointMotion out;
  out.x = frame.R * reference + frame.d;
  const Vector3d r = out.x - frame.point;
  out.omega = frame.omega;
  out.alpha = frame.alpha;
  out.v = frame.v + frame.omega.cross(r);
  out.a = frame.a + frame.alpha.cross(r) + frame.omega.cross(frame.omega.cross(r));
  return out;
}

void Frames::addColumns(int element, const Vector3d& point, double sign, Eigen::Ref<MatrixXd> angular,
                        Eigen::Ref<MatrixXd> linear) const {
  if (element < 0) return;
  for (const int e : tree_->path_to[element]) {
    const Element& step = tree_->elements[e];
    const FrameState& frame = frames_[e];
    if (step.kind == ElementKind::slide) {
      linear.col(step.first) += sign * frame.axis;
      continue;
    }
    const Vector3d r = point - frame.point;
    for (int k = 0; k < step.rates(); ++k) {
      const Vector3d axis = step.kind == ElementKind::turn ? frame.axis : Vector3d(frame.before.col(k));
      angular.col(step.first + k) += sign * axis;
      linear.col(step.first + k) += sign * axis.cross(r);
    }
  }
}

void advance(const LoopTree& tree, const VectorXd& step, LoopPose& pose) {
  for (std::size_t e = 0; e < tree.elements.size(); ++e) {
    const Element& element = tree.elements[e];
    if (element.kind != ElementKind::ball) {
      pose.q(element.first) += step(element.first);
      continue;
    }
    const Vector3d turn = step.segment<3>(element.first);
    const double angle = turn.norm();
    if (angle > 0)  // the rates are in the frame before the ball
      pose.balls[e] = (Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle)) * pose.balls[e]).normalized();
  }
}

}  // namespace ursula::loops

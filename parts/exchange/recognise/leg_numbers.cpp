#include "parts/exchange/recognise/legs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/scalar.h"
#include "base/text.h"
#include "model/legs/leg_chain.h"

namespace ursula::exchange {
namespace {

Matrix3d frameOf(const Vector3d& x, const Vector3d& along) {
  Matrix3d out;
  out << x, along.cross(x), along;
  return out;
}

Knee kneeOf(bool positive) { return positive ? Knee::positive : Knee::negative; }

Vector3d offAxis(const Vector3d& v, const Vector3d& unit) { return v - unit * unit.dot(v); }

Group sumOf(const LegTask& task, const std::vector<std::size_t>& groups) {
  Group out = task.groups.groups[groups.at(0)];
  for (std::size_t k = 1; k < groups.size(); ++k) {
    const Group& more = task.groups.groups[groups[k]];
    out.add(more.mass, more.center_of_mass, more.inertia);
    out.inertia_rounding += more.inertia_rounding;
    out.weightless = out.weightless || more.weightless;
  }
  return out;
}

/// Measures one leg. Points and axes are in the world; only F̂ uses B's axes.
class LegMaker {
 public:
  explicit LegMaker(const LegTask& task) : task_(task), shape_(task.shape), joints_(task.shape.joints) {}

  ImportedLeg make() {
    leg_.kind = shape_.kind;
    leg_.actuated = {};
    leg_.joints = shape_.place;
    leg_.spins = shape_.inner_ball.has_value();
    B_ = joints_.back().inner;
    proximal_ = sumOf(task_, shape_.proximal);
    distal_ = sumOf(task_, shape_.distal);
    const LegKindRow& row = rowOf(shape_.kind);
    if (row.joints_of_proximal == 2)
      row.isTelescopic() ? makeTelescope() : makeKneed();
    else
      row.hasCarriage() ? makeCarriage() : makeCrank();
    lumpCrosses(task_, A_, proximal_, distal_);
    makeLinks();
    leg_.base_point = task_.base.inverse() * base_point_;
    leg_.base_axis = task_.base.linear().transpose() * u_;
    leg_.platform_point = task_.platform.inverse() * joints_.back().outer;
    takeLegDynamics(task_, grows_along_, leg_);
    return leg_;
  }

 private:
  [[noreturn]] void refuseLeg(const std::string& what) const {
    throw ImportError(fmt::format("the leg of {}: {}", shape_.place, what), joint(0).line);
  }

  const GraphJoint& joint(std::size_t k) const { return task_.graph.joints[joints_[k].joint]; }

  /// Requires two directions to be parallel, up to the sign.
  void requireParallel(const Vector3d& a, const Vector3d& b, const std::string& what) const {
    requireSmallSine(a.cross(b).norm(), what + ", expected them parallel");
  }
  void requireSquare(const Vector3d& a, const Vector3d& b, const std::string& what) const {
    requireSmallSine(std::abs(a.dot(b)), what + ", expected them at right angles");
  }
  void requireSmallSine(double sine, const std::string& what) const {
    const double angle = std::asin(std::min(sine, 1.0));
    if (!(angle <= task_.choices.tolerance))
      refuseLeg(fmt::format("{}, off by {:.6g}° ({:.3g} rad), more than {:g} (--tolerance)", what,
                            angle * degrees_per_radian, angle, task_.choices.tolerance));
    if (angle > worth_saying)
      task_.assumptions.push_back({fmt::format("{}: taken as exact", what), shape_.place, angle, "rad"});
  }

  /// Returns a direction across the line. If a ball replaces the universal joint, any of them will do.
  Vector3d someAcross(const Vector3d& line) const {
    const Vector3d up = task_.base.linear().col(2), side = task_.base.linear().col(0);
    const Vector3d across = line.cross(up);
    return (across.norm() > 0.1 ? across : line.cross(side)).normalized();
  }

  void makeTelescope() {
    const bool ball = leg_.spins;
    // With a ball at the base, joints_ are S, P, S: the slide is second.
    const Primitive& slide = joints_[ball ? 1 : 2];
    base_point_ = A_ = ball ? joints_[0].inner : meetingOf(0);
    const double d = (B_ - A_).norm();
    if (!(d > 0)) refuseLeg("its ball is at its universal joint, expected a leg with a length");
    const Vector3d e = (B_ - A_) / d;
    requireParallel(
        slide.axis, e,
        fmt::format("the slide {} and the line between its joints", shown(task_.graph.joints[slide.joint].name)));
    u_ = ball ? someAcross(e) : Vector3d(-joints_[0].axis);
    if (!ball)
      requireSquare(joints_[1].axis, e, fmt::format("the axis of {} and the leg's line", shown(joint(1).name)));
    if (!(u_.cross(e).norm() > 1e-6)) refuseLeg("its first axis lies along its line, expected it across");
    const Vector3d x = u_.cross(e).normalized();
    const Stroke stroke = strokeOf(task_, slide, e, d);
    leg_.stroke_from_file = stroke.from_file;
    s_ = stroke.least;
    l_ = stroke.most - stroke.least;
    grows_along_ = {-u_, x, e};
    proximal_frame_ = placedAt(A_, frameOf(x, e));
    distal_frame_ = placedAt(A_ + (d - s_) * e, frameOf(x, e));
  }

  void makeKneed() {
    base_point_ = A_ = meetingOf(0);
    u_ = -joints_[0].axis;
    const Vector3d x = joints_[1].axis;
    requireParallel(joints_[2].axis, x,
                    fmt::format("the axes of {} and {}", shown(joint(1).name), shown(joint(2).name)));
    const Vector3d R = joints_[2].inner - x * x.dot(joints_[2].inner - A_);
    requireOnPlane(x.dot(B_ - A_));
    const Vector3d e = lengthAndDirection(R - A_, l_), along = lengthAndDirection(B_ - R, s_);
    if (!(u_.cross(B_ - A_).norm() > 1e-9 * task_.size)) refuseLeg("its ball lies on its first axis");
    const Vector3d x_of_leg = u_.cross(B_ - A_).dot(x) > 0 ? x : Vector3d(-x);
    leg_.knee = kneeOf(along.dot(x_of_leg.cross(e)) < 0);
    grows_along_ = {-u_, x_of_leg, x_of_leg};
    proximal_frame_ = placedAt(A_, frameOf(x_of_leg, e));
    distal_frame_ = placedAt(R, frameOf(x_of_leg, along));
  }

  void makeCrank() {
    u_ = -joints_[0].axis;
    const Vector3d C = middleJoint();
    base_point_ = A_ = joints_[0].inner + u_ * u_.dot(C - joints_[0].inner);
    const Vector3d e = lengthAndDirection(C - A_, l_), along = lengthAndDirection(B_ - C, s_);
    const Vector3d across = offAxis(along, u_);
    if (!(across.norm() > 1e-6)) refuseLeg("its rod lies along the crank's axis, expected it across");
    const Vector3d x_2 = u_.cross(across).normalized();
    if (!leg_.spins) requireUniversalAlong(along);
    leg_.knee = kneeOf(across.dot(u_.cross(e)) < 0);
    grows_along_ = {-u_, -u_, -x_2};
    proximal_frame_ = placedAt(A_, frameOf(u_.cross(e).normalized(), e));
    distal_frame_ = placedAt(C, frameOf(x_2, along));
  }

  void makeCarriage() {
    u_ = joints_[0].axis;
    const Vector3d C = middleJoint();
    A_ = C;
    base_point_ = C - joint(0).position * u_;
    const Vector3d along = lengthAndDirection(B_ - C, s_);
    const Vector3d across = offAxis(along, u_);
    if (!(across.norm() > 1e-6)) refuseLeg("its rod lies along the rail, expected it across");
    if (!leg_.spins) requireUniversalAlong(along);
    leg_.knee = kneeOf(along.dot(u_) > 0);
    const Matrix3d to_world = task_.base.linear();
    const Vector3d x = u_.cross(across).normalized();
    grows_along_ = {u_, -u_, x};
    proximal_frame_ = placedAt(C, to_world * fixedFrame(to_world.transpose() * u_));
    distal_frame_ = placedAt(C, frameOf(x, along));
  }

  /// Returns the centre of the universal joint of the hinges `first` and the next one.
  Vector3d meetingOf(std::size_t first) const {
    const Primitive &a = joints_[first], &b = joints_[first + 1];
    return commonPerpendicular(a.inner, a.axis, b.inner, b.axis).at;
  }
  /// Returns the centre of the joint between crank or carriage and rod.
  Vector3d middleJoint() const { return leg_.spins ? joints_[1].inner : meetingOf(1); }

  /// The universal joint's first axis is the crank's or the rail's; its second is perpendicular to the rod.
  void requireUniversalAlong(const Vector3d& rod) const {
    requireParallel(joints_[1].axis, u_,
                    fmt::format("the axes of {} and {}", shown(joint(0).name), shown(joint(1).name)));
    requireSquare(joints_[2].axis, rod, fmt::format("the axis of {} and the rod", shown(joint(2).name)));
  }

  void requireOnPlane(double off) const {
    if (!(std::abs(off) <= task_.choices.tolerance * task_.size))
      refuseLeg(fmt::format(
          "its ball is {:.6g} m off the plane of its links, expected within {:g} of the machine's size, {:.4g} m",
          std::abs(off), task_.choices.tolerance, task_.size));
    if (std::abs(off) > worth_saying * task_.size)
      task_.assumptions.push_back(
          {"The ball is assumed to lie in the plane of the leg's links", shape_.place, std::abs(off), "m"});
  }

  Vector3d lengthAndDirection(const Vector3d& v, double& length) const {
    length = v.norm();
    if (!(length > 1e-9 * task_.size)) refuseLeg("two of its joints coincide, expected a link between them");
    return v / length;
  }

  static Eigen::Isometry3d placedAt(const Vector3d& point, const Matrix3d& turn) {
    Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
    out.translation() = point;
    out.linear() = turn;
    return out;
  }

  void makeLinks() {
    const bool telescopic = rowOf(leg_.kind).isTelescopic(), carriage = rowOf(leg_.kind).hasCarriage();
    leg_.proximal = linkOf(task_, proximal_, proximal_frame_, leg_.proximalLine(), carriage ? 0 : l_, telescopic);
    leg_.distal = linkOf(task_, distal_, distal_frame_, 2, s_, true);
    leg_.bodies = {proximal_.name, distal_.name};
    if (leg_.spins) {
      if (telescopic) freeSpin(task_, proximal_, proximal_frame_, true, leg_.proximal);
      freeSpin(task_, distal_, distal_frame_, true, leg_.distal);
    }
    if (leg_.spins) return;
    for (const std::size_t group : shape_.spinning) {
      const bool outer = std::find(shape_.distal.begin(), shape_.distal.end(), group) != shape_.distal.end();
      freeSpin(task_, task_.groups.groups[group], outer ? distal_frame_ : proximal_frame_, false,
               outer ? leg_.distal : leg_.proximal);
    }
  }

  const LegTask& task_;
  const LegShape& shape_;
  std::vector<Primitive> joints_;
  ImportedLeg leg_;
  Group proximal_, distal_;
  Vector3d A_ = Vector3d::Zero(), B_ = Vector3d::Zero(), base_point_ = Vector3d::Zero(), u_ = Vector3d::UnitX();
  std::array<Vector3d, 3> grows_along_ = {};  ///< of the kind's coordinates, docs/conventions.md
  double l_ = 0, s_ = 0;
  Eigen::Isometry3d proximal_frame_ = Eigen::Isometry3d::Identity(), distal_frame_ = Eigen::Isometry3d::Identity();
};

}  // namespace

ImportedLeg legOf(const LegTask& task) {
  task.assumptions.insert(task.assumptions.end(), task.shape.assumptions.begin(), task.shape.assumptions.end());
  return LegMaker(task).make();
}

}  // namespace ursula::exchange

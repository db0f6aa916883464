// Closes the loops of the file's pose, and tells whether that pose is singular.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/dense.h"
#include "base/scalar.h"
#include "base/text.h"
#include "nocsolver/loops/loop_solver_internal.h"

namespace ursula {

using loops::Element;
using loops::ElementKind;
using loops::Frames;
using loops::LoopPose;
using loops::PassiveRates;

namespace {

constexpr double digits_of_files = 1e-6;  ///< what files close to their digits is open by less
constexpr double nearly_closed = 1e-8;
constexpr double nearby[] = {0.2, -0.2, 0.5, -0.5, 1, -1};  ///< where to look for other poses, rad or scaled

/// Moves all coordinates by up to `most`, each another way.
void scatter(const loops::LoopTree& tree, const VectorXd& scale, double most, LoopPose& pose) {
  constexpr double golden = 0.61803398874989485;
  VectorXd by(tree.rate_count);
  for (Eigen::Index k = 0; k < by.size(); ++k) {
    const double fraction = golden * static_cast<double>(k + 1);
    by(k) = scale(k) * most * (2 * (fraction - std::floor(fraction)) - 1);
  }
  loops::advance(tree, by, pose);
}

double angleFrom(const Vector3d& from, const Vector3d& to, const Vector3d& axis) {
  return std::atan2(axis.dot(from.cross(to)), from.dot(to) - axis.dot(from) * axis.dot(to));
}

}  // namespace

LoopPose LoopSolver::Impl::poseOf(const std::vector<Eigen::Isometry3d>& start) const {
  LoopPose out = zeroPose();
  std::vector<Eigen::Isometry3d> of_element(tree.elements.size(), Eigen::Isometry3d::Identity());
  for (std::size_t b = 0; b < start.size(); ++b)
    if (tree.element_of_body[b] >= 0) of_element[tree.element_of_body[b]] = start[b];
  const auto carries = [&](std::size_t e) {  // whether the next element belongs to the same joint
    return e + 1 < tree.elements.size() && tree.elements[e + 1].joint == tree.elements[e].joint &&
           tree.elements[e + 1].before == static_cast<int>(e);
  };
  Eigen::Isometry3d rest = Eigen::Isometry3d::Identity();  // of the joint's displacement
  for (std::size_t e = 0; e < tree.elements.size(); ++e) {
    const Element& element = tree.elements[e];
    if (e == 0 || !carries(e - 1)) {
      std::size_t last = e;
      while (carries(last)) ++last;
      rest = of_element[last];
      if (element.before >= 0) rest = of_element[element.before].inverse() * rest;
    }
    double& q = out.q(element.first);
    if (element.kind == ElementKind::ball) {
      out.balls[e] = Eigen::Quaterniond(rest.linear()).normalized();
    } else if (element.kind == ElementKind::slide) {
      q = element.axis.dot(rest * element.centre - element.centre);
      rest.translation() -= q * element.axis;
    } else {
      const Vector3d across = carries(e) ? tree.elements[e + 1].axis : Vector3d(element.axis.unitOrthogonal());
      q = angleFrom(across, rest.linear() * across, element.axis);
      rest.linear() = Eigen::AngleAxisd(-q, element.axis) * rest.linear();
    }
  }
  return out;
}

/// Gauss-Newton by Levenberg's and Marquardt's damping over all coordinates. It moves little, and stops where no small
/// movement closes the gap further.
double LoopSolver::Impl::approach(LoopPose& pose) const {
  constexpr double enough = 1e-10, longest = 0.2, most_damping = 1e8;
  constexpr int most = 300;
  Frames frames(tree);
  MatrixXd G(closures.rows(), tree.rate_count);
  VectorXd g(closures.rows());
  const auto errorAt = [&](const LoopPose& at) {
    frames.place(at);
    closures.errors(frames, g);
    return g.norm();
  };
  const Eigen::Index n = tree.rate_count, rows = closures.rows();
  double error = errorAt(pose), damping = 1e-3;
  for (int k = 0; k < most && error > enough && damping < most_damping; ++k) {
    errorAt(pose);
    closures.jacobian(frames, G);
    MatrixXd A(rows + n, n);
    A << G * scale.asDiagonal(), std::sqrt(damping) * MatrixXd::Identity(n, n);
    MatrixXd b = MatrixXd::Zero(rows + n, 1);
    b.topRows(rows) = -g;
    VectorXd x = leastNormSolution(A, b);
    const double size = x.cwiseAbs().maxCoeff();
    if (!(size > 1e-14)) break;
    if (size > longest) x *= longest / size;
    LoopPose next = pose;
    loops::advance(tree, scale.cwiseProduct(x), next);
    const double after = errorAt(next);
    const bool better = after < error;
    damping = better ? std::max(damping / 4, 1e-14) : damping * 8;
    if (!better) continue;
    error = after;
    pose = std::move(next);
  }
  for (const Element& each : tree.elements)
    if (each.kind == ElementKind::turn) pose.q(each.first) = std::remainder(pose.q(each.first), 2 * pi);
  return error;
}

/// The same; where it gets stuck at a pose that is not singular, it begins again beside the first.
void LoopSolver::Impl::approachFromNearby(LoopPose& pose) const {
  const LoopPose first = pose;
  if (approach(pose) < nearly_closed || singularLoop(pose)) return;
  for (const double most : nearby) {
    LoopPose other = first;
    scatter(tree, scale, most, other);
    if (!(approach(other) < nearly_closed)) continue;
    pose = std::move(other);
    return;
  }
}

void LoopSolver::Impl::assemble() {
  const bool is_given = !mechanism.start().empty();
  reference = zeroPose();
  Frames frames(tree);
  frames.place(reference);
  double open = gap = errorOf(frames, nullptr);
  constexpr double most = 1e-7, wide = 1e-3;
  if (is_given) {
    reference = poseOf(mechanism.start());
    frames.place(reference);
    open = errorOf(frames, nullptr);
  }
  if (open > wide) approachFromNearby(reference);
  // What the file closes to its digits is closed by the passive joints; an open one by all, with least movement.
  std::vector<int> all(tree.rate_count);
  for (int k = 0; k < tree.rate_count; ++k) all[k] = k;
  PassiveRates solver(open > digits_of_files ? all : passive, scale);
  MatrixXd G(closures.rows(), tree.rate_count);
  for (int k = 0; k < 30; ++k) {  // the rank may change while a gap closes
    frames.place(reference);
    if (open > wide && errorOf(frames, nullptr) > wide) break;
    closures.jacobian(frames, G);
    solver.decideRank(G);
    LoopPose next = reference;
    static_cast<void>(close(next, frames, solver, 1));
    reference = next;
    frames.place(reference);
    if (errorOf(frames, nullptr) < 1e-13) break;
  }
  if (!(errorOf(frames, nullptr) < most)) {
    if (const auto singular = singularLoop(reference)) throw LoopError(singularWords(mechanism, *singular));
    refuse(reference, "the file's pose cannot be closed");
  }
  if (gap > digits_of_files && !is_given) {
    std::vector<Eigen::Isometry3d> start;
    for (const int element : tree.element_of_body) start.push_back(frames.displacement(element));
    mechanism.startAt(std::move(start));
  }
  closures.jacobian(frames, G);
  rates.decideRank(G);
  static_cast<void>(rates.factorise(G));
  LoopFreedoms ignored;
  findFreedoms(reference, ignored, spins);
}

std::optional<SingularLoop> LoopSolver::Impl::singularLoop(const LoopPose& pose) const {
  Frames frames(tree);
  MatrixXd here(closures.rows(), tree.rate_count), there = here;
  frames.place(pose);
  closures.jacobian(frames, here);
  for (const double most : nearby) {
    LoopPose other = pose;
    scatter(tree, scale, most, other);
    if (!(approach(other) < nearly_closed)) continue;
    frames.place(other);
    closures.jacobian(frames, there);
    for (int first = 0, end = 0; first < closures.rows(); first = end) {
      while (end < closures.rows() && closures.jointOf(end) == closures.jointOf(first)) ++end;
      const auto rankOfLoop = [&](const MatrixXd& G) {
        return loops::rankByGap(G.middleRows(first, end - first) * scale.asDiagonal()).rank;
      };
      if (rankOfLoop(here) >= rankOfLoop(there)) continue;
      const MechanismJoint& closing = mechanism.joints()[closures.jointOf(first)];
      SingularLoop out{closing.name, closing.line, {}, VectorXd(motors()), {}};
      for (const Element& each : tree.elements)
        if (each.joint < mechanism.joints().size() &&
            !there.block(first, each.first, end - first, each.rates()).isZero(1e-9) &&
            std::find(out.joints.begin(), out.joints.end(), mechanism.joints()[each.joint].name) == out.joints.end())
          out.joints.push_back(mechanism.joints()[each.joint].name);
      for (int k = 0; k < motors(); ++k) out.motors(k) = other.q(tree.rate_of_motor[k]) + mechanism.motor(k).position;
      std::vector<RestingSpin> ignored;
      findFreedoms(other, out.freedoms, ignored);
      return out;
    }
  }
  return std::nullopt;
}

std::optional<SingularLoop> LoopSolver::singularLoop(const LoopPose& pose) const { return impl_->singularLoop(pose); }

std::string singularWords(const Mechanism& mechanism, const SingularLoop& loop) {
  std::string joints, motors;
  for (const std::string& name : loop.joints) joints += (joints.empty() ? "" : ", ") + shown(name);
  for (std::size_t k = 0; k < mechanism.motorCount(); ++k) {
    const MechanismJoint& motor = mechanism.motor(k);
    if (std::find(loop.joints.begin(), loop.joints.end(), motor.name) == loop.joints.end()) continue;
    motors += fmt::format("{}{} at {:.3g} {}", motors.empty() ? "" : ", ", shown(motor.name),
                          loop.motors(static_cast<Eigen::Index>(k)), motor.slides() ? "m" : "rad");
  }
  return fmt::format(
      "the file's pose is singular: the loop of {} that '{}'{} closes is stretched or folded there, as links in a line "
      "are. It is not at another pose{}{}. Expected a model whose pose is one like it: other positions, or a keyframe "
      "(`key` of [mechanism])",
      joints, shown(loop.closing), loop.line > 0 ? fmt::format(" of line {}", loop.line) : "",
      motors.empty() ? "" : ", such as with ", motors);
}

JointMove LoopSolver::assemblyMove() const {
  const Impl& own = *impl_;
  JointMove out;
  for (std::size_t e = 0; e < own.tree.elements.size(); ++e) {
    const Element& element = own.tree.elements[e];
    const bool is_ball = element.kind == ElementKind::ball;
    const double by = is_ball ? Eigen::AngleAxisd(own.reference.balls[e]).angle() : own.reference.q(element.first);
    const double share = std::abs(by) / (is_ball ? 1 : own.scale(element.first));
    if (!(share > out.share)) continue;
    const bool is_joint = element.joint < own.mechanism.joints().size();
    out = {is_joint ? own.mechanism.joints()[element.joint].name : "", by, share, element.kind == ElementKind::slide};
  }
  return out;
}

}  // namespace ursula

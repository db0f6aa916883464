#include "nocsolver/loops/loop_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/dense.h"
#include "base/text.h"
#include "nocsolver/loops/loop_solver_internal.h"

namespace ursula {

using loops::Frames;
using loops::LoopPose;
using loops::PassiveRates;

namespace {

std::vector<int> passiveRates(const loops::LoopTree& tree) {
  std::vector<int> out;
  for (int k = 0; k < tree.rate_count; ++k)
    if (std::find(tree.rate_of_motor.begin(), tree.rate_of_motor.end(), k) == tree.rate_of_motor.end())
      out.push_back(k);
  return out;
}

VectorXd scales(const Mechanism& mechanism, const loops::LoopTree& tree) {
  VectorXd out = VectorXd::Ones(tree.rate_count);
  for (const loops::Element& each : tree.elements)
    if (each.kind == loops::ElementKind::slide) out(each.first) = mechanism.length();
  return out;
}

std::vector<loops::CoordinateLoad> loadsOf(const loops::LoopTree& tree) {
  std::vector<loops::CoordinateLoad> out(tree.rate_count);
  for (const loops::Element& each : tree.elements)
    for (int k = 0; k < each.rates(); ++k) out[each.first + k] = each.load;
  return out;
}

std::vector<Lump> lumpsOf(const Mechanism& mechanism, const loops::LoopTree& tree) {
  std::vector<Lump> out(tree.elements.size());
  for (std::size_t b = 0; b < mechanism.bodies().size(); ++b) {
    const int element = tree.element_of_body[b];
    if (element < 0) continue;
    const MechanismBody& body = mechanism.bodies()[b];
    Lump& lump = out[element];
    lump.bodies.push_back(b);
    const auto point = [](double m, const Vector3d& r) {
      return Matrix3d(m * (r.squaredNorm() * Matrix3d::Identity() - r * r.transpose()));
    };
    const double sum = lump.mass + body.mass;
    if (sum > 0) {
      const Vector3d apart = body.center_of_mass - lump.center;
      lump.inertia += point(lump.mass * body.mass / sum, apart);
      lump.center += apart * (body.mass / sum);
    }
    lump.inertia += body.inertia;
    lump.mass = sum;
  }
  return out;
}

}  // namespace

LoopSolver::Impl::Impl(const Mechanism& given)
    : mechanism(given),
      tree(mechanism),
      closures(mechanism, tree),
      scale(scales(mechanism, tree)),
      passive(passiveRates(tree)),
      loads(loadsOf(tree)),
      lumps(lumpsOf(mechanism, tree)),
      rates(passive, scale) {
  assemble();
}

LoopPose LoopSolver::Impl::zeroPose() const {
  return {VectorXd::Zero(tree.rate_count),
          std::vector<Eigen::Quaterniond>(tree.elements.size(), Eigen::Quaterniond::Identity())};
}

double LoopSolver::Impl::errorOf(const Frames& frames, std::size_t* joint) const {
  VectorXd g = VectorXd::Zero(closures.rows());
  closures.errors(frames, g);
  double out = 0;
  for (int row = 0; row < closures.rows(); ++row) {
    if (!(std::abs(g(row)) > out)) continue;
    out = std::abs(g(row));
    if (joint != nullptr) *joint = closures.jointOf(row);
  }
  return out;
}

void LoopSolver::Impl::refuse(const LoopPose& pose, const std::string& what, const std::string& more) const {
  Frames frames(tree);
  frames.place(pose);
  std::size_t joint = mechanism.joints().size();
  const double error = errorOf(frames, &joint);
  const std::string name = joint < mechanism.joints().size() ? shown(mechanism.joints()[joint].name) : "a loop";
  throw LoopError(fmt::format("{}: the loop that '{}' closes is open by {:.2g} of the machine's length{}", what, name,
                              error, more));
}

/// Gauss-Newton of least norm over the rates of `solver`.
double LoopSolver::Impl::close(LoopPose& pose, Frames& frames, PassiveRates& solver, int most) const {
  constexpr double converged = 1e-9, rounding = 1e-14;
  MatrixXd G(closures.rows(), tree.rate_count);
  VectorXd g(closures.rows()), step = VectorXd::Zero(tree.rate_count);
  double moved = 0, before = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most; ++k) {
    frames.place(pose);
    closures.errors(frames, g);
    closures.jacobian(frames, G);
    solver.factorise(G);
    const VectorXd x = solver.solve(-g);
    if (!x.allFinite()) break;
    double size = 0;
    for (std::size_t i = 0; i < solver.passive().size(); ++i) {
      const int rate = solver.passive()[i];
      step(rate) = x(static_cast<Eigen::Index>(i));
      size = std::max(size, std::abs(step(rate)) / scale(rate));
    }
    loops::advance(tree, step, pose);
    moved += size;
    if (size <= rounding || (size <= converged && size >= 0.5 * before) || size <= converged) {
      frames.place(pose);
      return moved;
    }
    before = size;
  }
  return std::numeric_limits<double>::infinity();
}

LoopSolver::Impl::Conditions LoopSolver::Impl::conditionsAt(const LoopPose& pose) const {
  Frames frames(tree);
  MatrixXd G(closures.rows(), tree.rate_count), G_p(closures.rows(), static_cast<Eigen::Index>(passive.size()));
  frames.place(pose);
  closures.jacobian(frames, G);
  G = (G * scale.asDiagonal()).eval();
  for (std::size_t k = 0; k < passive.size(); ++k) G_p.col(static_cast<Eigen::Index>(k)) = G.col(passive[k]);
  const auto last = [this](const MatrixXd& of) {
    if (rates.rank() == 0) return 1.0;
    const VectorXd sigma = singularValues(of);
    return sigma(rates.rank() - 1) / sigma(0);
  };
  return {last(G_p), last(G)};
}

LoopSolver::Impl::Step LoopSolver::Impl::step(const VectorXd& from, const VectorXd& to, bool watched,
                                              LoopPose& pose) const {
  constexpr double most_turn = 0.5, free_of_check = 0.02, share = 0.2;
  LoopPose next = pose;
  Frames frames(tree);
  PassiveRates solver = rates;
  MatrixXd G(closures.rows(), tree.rate_count), N;
  frames.place(next);
  closures.jacobian(frames, G);
  if (!solver.factorise(G)) return Step::singular;
  std::optional<PassiveRates> before;
  if (watched) before = solver;
  complement(frames, G, solver, N);
  VectorXd predicted = N * (to - from);
  for (int k = 0; k < motors(); ++k) predicted(tree.rate_of_motor[k]) = to(k) - next.q(tree.rate_of_motor[k]);
  const double size = predicted.cwiseQuotient(scale).cwiseAbs().maxCoeff();
  if (size > most_turn) return Step::too_long;
  loops::advance(tree, predicted, next);
  const double moved = close(next, frames, solver, 12);
  if (!(moved <= std::max(free_of_check, share * size)) || errorOf(frames, nullptr) > 1e-6) return Step::too_long;
  if (before) {
    closures.jacobian(frames, G);
    if (!before->keepsSign(G)) return Step::singular;
  }
  pose = next;
  return Step::made;
}

LoopSolver::LoopSolver(const Mechanism& mechanism) : impl_(std::make_unique<Impl>(mechanism)) {}
LoopSolver::~LoopSolver() = default;
LoopSolver::LoopSolver(LoopSolver&&) noexcept = default;

const Mechanism& LoopSolver::mechanism() const { return impl_->mechanism; }
LoopPose LoopSolver::assembled() const { return impl_->reference; }
double LoopSolver::assemblyGap() const { return impl_->gap; }

VectorXd LoopSolver::motorCoordinates(const LoopPose& pose) const {
  VectorXd out(impl_->motors());
  for (int k = 0; k < impl_->motors(); ++k)
    out(k) = pose.q(impl_->tree.rate_of_motor[k]) + impl_->mechanism.motor(k).position;
  return out;
}

LoopFreedoms LoopSolver::freedoms(const LoopPose& pose) const {
  LoopFreedoms out;
  std::vector<RestingSpin> spins;
  impl_->findFreedoms(pose, out, spins);
  return out;
}

void LoopSolver::moveTo(const VectorXd& q, LoopPose& pose, bool watched) const {
  constexpr double least = 1.0 / 65536;
  const Impl& own = *impl_;
  VectorXd from(own.motors()), to(own.motors());
  for (int k = 0; k < own.motors(); ++k) {
    from(k) = pose.q(own.tree.rate_of_motor[k]);
    to(k) = q(k) - own.mechanism.motor(k).position;
  }
  double done = 0, share = 1;
  while (done < 1) {
    const double next = std::min(1.0, done + share);
    const Impl::Step made =
        own.step(from + done * (to - from), next == 1 ? to : VectorXd(from + next * (to - from)), watched, pose);
    if (made == Impl::Step::made) {
      done = next;
      share *= 2;
      continue;
    }
    share /= 2;
    if (share < least) {
      // Where a reach ends, the loops still hold all directions with the motors'; at a singular pose they lose one.
      constexpr double nearly = 1e-2, much = 0.1;
      const Impl::Conditions at = own.conditionsAt(pose);
      if (made == Impl::Step::singular && at.all < std::sqrt(at.passive)) throw LoopError(singular_pose);
      LoopPose tried = pose;
      for (int k = 0; k < own.motors(); ++k)
        tried.q(own.tree.rate_of_motor[k]) = from(k) + std::min(1.0, done + 0.02) * (to(k) - from(k));
      const bool singular = at.passive < nearly && at.passive < much * own.conditionsAt(own.reference).passive;
      own.refuse(tried, "the loops cannot follow the motors",
                 singular ? "; the pose before it is singular, as where a reach ends" : "");
    }
  }
}

}  // namespace ursula

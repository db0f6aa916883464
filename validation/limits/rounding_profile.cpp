#include "validation/limits/rounding_profile.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "nocsolver/noc/noc.h"
#include "validation/limits/engine_view.h"
#include "validation/limits/solver_rounding.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

/// Changes of frame beside the given one.
constexpr unsigned frame_changes = 3;
/// Number of instants on either side whose spread counts.
constexpr std::size_t neighbours = 2;

/// The largest difference of ψ, θ and d. φ depends on the frame, so the axis x of the leg's plane is compared.
double angleDistance(const Manipulator& machine, const JointVariables<double>& a, const JointVariables<double>& b,
                     const BodyMotions<double>& of_a, const BodyMotions<double>& of_b, double length) {
  double largest = 0;
  for (int i = 0; i < machine.legCount(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const bool carriage = rowOf(machine.leg(i).kind).hasCarriage();
    // The plane of a leg with a carriage is its rod's; its ψ starts at an axis that does not turn with the frame.
    const std::size_t in_plane = carriage ? leg_count + k : k;
    const double plane = (of_a[in_plane].R.col(0) - of_b[in_plane].R.col(0)).norm();
    const auto turn = [](double x, double y) { return std::abs(std::remainder(x - y, 2 * pi)); };
    largest = larger(largest, plane);
    if (!carriage) largest = larger(largest, turn(a.psi(i), b.psi(i)));
    largest = larger(largest, turn(a.theta(i), b.theta(i)));
    largest = larger(largest, std::abs(a.d(i) - b.d(i)) / length);
  }
  return largest;
}

/// The largest difference of a force, or of a moment over `length`, N.
double reactionDistance(const Reactions& a, const Reactions& b, double length) {
  double largest = 0;
  for (std::size_t i = 0; i < leg_count; ++i) largest = larger(largest, distance(a[i], b[i], length));
  return largest;
}

double torqueDistance(const Vector6d& a, const Vector6d& b) {
  return (a - b).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

void raise(RoundingLevels& levels, Rounded quantity, double value) {
  double& level = levels[static_cast<std::size_t>(quantity)];
  level = larger(level, value);
}

/// Compares joints and bodies, which the solver and the engines both have.
template <class View>
void spreadOfMotions(const Manipulator& machine, const View& a, const View& b, double length, RoundingLevels& out) {
  for (std::size_t i = 0; i < body_count; ++i) {
    // A carriage's frame depends on the vertical, not on the machine.
    const bool is_carriage =
        i < static_cast<std::size_t>(machine.legCount()) && rowOf(machine.leg(static_cast<int>(i)).kind).hasCarriage();
    const double turn = is_carriage ? 0 : length;
    const BodyMotion<double>&x = a.bodies[i], &y = b.bodies[i];
    raise(out, Rounded::positions, (x.c - y.c).norm() + turn * (x.R - y.R).norm());
    raise(out, Rounded::twists, twistSize(x.twist - y.twist, length));
    raise(out, Rounded::twist_rates, twistSize(x.twist_rate - y.twist_rate, length));
  }
  raise(out, Rounded::angles, angleDistance(machine, a.joints.q, b.joints.q, a.bodies, b.bodies, length));
  raise(out, Rounded::rates, jointDistance(a.joints.q_dot, b.joints.q_dot, length));
  raise(out, Rounded::accelerations, jointDistance(a.joints.q_ddot, b.joints.q_ddot, length));
  raise(out, Rounded::reactions, reactionDistance(a.reactions, b.reactions, length));
  raise(out, Rounded::direct, twistSize(a.direct - b.direct, length));
}

/// Rates and accelerations of the driven coordinates.
struct DrivenMotion {
  Vector6d q_dot, q_ddot;
};

/// The spread of the NOC in one frame. `driven` is Simbody's; `to_efforts` is T_PᵀM_P: efforts per acceleration of the
/// platform. An engine's level also contains the solver's spread.
RoundingLevels spreadOfSolver(const Manipulator& machine, const std::vector<SolverView>& views,
                              const DrivenMotion& driven, const Matrix6d& to_efforts, double length) {
  const Eigen::PartialPivLU<Matrix6d> to_efforts_lu(to_efforts);
  RoundingLevels out = uniformLevels(0);
  const auto size = [length](const Matrix6d& T) { return T.bottomRows<3>().norm() + length * T.topRows<3>().norm(); };
  for (std::size_t i = 0; i < views.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const SolverView &a = views[i], &b = views[j];
      spreadOfMotions(machine, a, b, length, out);
      const Matrix6d T = a.T - b.T, T_rate = a.T_rate - b.T_rate;
      raise(out, Rounded::shaping, size(T));
      raise(out, Rounded::shaping_rate, size(T_rate));
      raise(out, Rounded::jacobian, twistSize(T * driven.q_dot, length));
      raise(out, Rounded::jacobian_rate, twistSize(T * driven.q_ddot + T_rate * driven.q_dot, length));
      const double torque = torqueDistance(a.torques, b.torques);
      raise(out, Rounded::effort, (a.torques - b.torques).norm());
      raise(out, Rounded::acceleration, twistSize(to_efforts_lu.solve(a.torques - b.torques), length));
      raise(out, Rounded::solver, torque);
      raise(out, Rounded::solver_direct, twistSize(a.direct - b.direct, length));
      raise(out, Rounded::torque, torque);
      for (std::size_t k = 0; k < furtherEngines().size(); ++k) raise(out, ofFurtherEngine(k), torque);
    }
  return out;
}

/// The engines' spread over changes of frame. `solver` is the NOC in the given one, `to_efforts` is T_PᵀM_P.
RoundingLevels spreadOfEngines(const Manipulator& machine, const std::vector<EngineView>& views,
                               const SolverView& solver, const Matrix6d& to_efforts, double length) {
  RoundingLevels out = uniformLevels(0);
  const Motors motors = machine.motors();
  for (std::size_t i = 0; i < views.size(); ++i) {
    raise(out, Rounded::gaps, views[i].gap_acceleration);
    for (std::size_t j = 0; j < i; ++j) {
      const EngineView &a = views[i], &b = views[j];
      spreadOfMotions(machine, a, b, length, out);
      const Vector6d q_dot = a.joints.q_dot.driven(motors) - b.joints.q_dot.driven(motors);
      const Vector6d q_ddot = a.joints.q_ddot.driven(motors) - b.joints.q_ddot.driven(motors);
      raise(out, Rounded::jacobian, twistSize(solver.T * q_dot, length));
      raise(out, Rounded::jacobian_rate, twistSize(solver.T * q_ddot + solver.T_rate * q_dot, length));
      raise(out, Rounded::torque, torqueDistance(a.torques, b.torques));
      for (std::size_t k = 0; k < furtherEngines().size(); ++k)
        if (a.further[k] && b.further[k]) raise(out, ofFurtherEngine(k), torqueDistance(*a.further[k], *b.further[k]));
      raise(out, Rounded::acceleration, twistSize(a.acceleration - b.acceleration, length));
      raise(out, Rounded::effort, (to_efforts * (a.acceleration - b.acceleration)).norm());
    }
  }
  return out;
}

/// Divides by the shape, or by the floor if that is larger; infinite if there is a spread without either.
void divideByShape(const Conditioning& at, RoundingLevels& spread) {
  for (std::size_t q = 0; q < rounded_count; ++q) {
    const double shape = std::max(at.floors[q], at.shape(static_cast<Rounded>(q)));
    if (spread[q] != 0) spread[q] = shape > 0 ? spread[q] / shape : std::numeric_limits<double>::infinity();
  }
}

/// The least level: rounding_floor, or less where condition numbers alone would exceed floor_share. `well_conditioned`
/// is the same machine without condition numbers.
double floorOf(const Conditioning& at, const Conditioning& well_conditioned, Rounded quantity) {
  const double share = floor_share / std::numeric_limits<double>::epsilon();
  const double shape = at.shape(quantity);
  return shape > 0 ? std::min(rounding_floor, share * well_conditioned.shape(quantity) / shape) : rounding_floor;
}

/// Moves P by a billionth of `length`, differently for each k: nearly the same pose with other roundings.
void nudge(Motion<double>& motion, int k, double length) {
  for (int axis = 0; axis < 3; ++axis) motion.p(axis) += 0x1p-30 * length * std::sin(1.0 + k + 2.3 * axis);
}

}  // namespace

Vector6d otherTorques(const Vector6d& torques) {
  const double size = torques.cwiseAbs().maxCoeff();
  Vector6d out = torques;
  for (int i = 0; i < motor_count; ++i) out(i) += (i % 2 == 0 ? 1 : -1) * size;
  return out;
}

int profileInstants(int samples) { return std::clamp(samples, 21, instants_along); }

struct RoundingProfile::Workspace {
  explicit Workspace(const Scenario& scenario)
      : machine(*scenario.manipulator), noc(machine), solver(machine, scenario.load), probe(machine, scenario.load) {
    engines.emplace_back(scenario, FrameChange(machine));
    for (unsigned k = 0; k < frame_changes; ++k)
      engines.emplace_back(scenario, randomFrameChange(k + 1, noc.machine().length, machine));
  }

  std::mutex guard;
  Manipulator machine;
  Noc<double> noc;
  NocWorkspace<double> work;
  SolverRounding solver;
  ConditioningProbe probe;
  std::vector<EngineFrameChange> engines;
};

RoundingProfile::RoundingProfile(const Scenario& scenario, int instants, const Deadline& deadline)
    : sizes_(scenario, deadline), workspace_(std::make_unique<Workspace>(scenario)) {
  Motion<double> last_distinct;
  for (int k = 0; k < instants; ++k) {
    deadline.require();
    const double t = instants > 1 ? scenario.trajectory->duration() * k / (instants - 1) : 0;
    Motion<double> motion = scenario.trajectory->at(t);
    if (k > 0 && sameState(motion, last_distinct))
      nudge(motion, k, workspace_->noc.machine().length);  // without this a held pose would repeat one measurement
    else
      last_distinct = motion;
    measured_.push_back(measure(motion, nullptr));
  }
}

RoundingProfile::~RoundingProfile() = default;

RoundingProfile::Measured RoundingProfile::measure(const Motion<double>& motion, const Vector6d* torques) const {
  Workspace& w = *workspace_;
  const std::lock_guard<std::mutex> lock(w.guard);
  Measured here;
  here.t = motion.t;
  Conditioning conditioning = w.probe.at(motion);
  conditioning.floors = sizes_.floors();
  const Vector6d commanded = w.solver.torques(motion), others = torques != nullptr ? *torques : otherTorques(commanded);
  const std::vector<SolverView> solver = w.solver.at(motion, others);
  std::vector<EngineView> engines;
  for (EngineFrameChange& each : w.engines) engines.push_back(each.at(motion, commanded, others));
  w.noc.displacements(motion, w.work);
  const Matrix6d to_efforts = solver.front().T.transpose() * w.noc.massMatrixAtP(motion, w.work);
  const JointMotion& simbody = engines.front().joints;
  const Motors motors = w.machine.motors();
  const DrivenMotion driven = {simbody.q_dot.driven(motors), simbody.q_ddot.driven(motors)};
  here.spread = spreadOfSolver(w.machine, solver, driven, to_efforts, conditioning.length);
  const RoundingLevels of_engines =
      spreadOfEngines(w.machine, engines, solver.front(), to_efforts, conditioning.length);
  // A limit covers the difference of both sides, so their spreads add.
  for (std::size_t q = 0; q < rounded_count; ++q) here.spread[q] += of_engines[q];
  divideByShape(conditioning, here.spread);
  return here;
}

Conditioning RoundingProfile::withLevels(const Motion<double>& motion, const Measured* measured_here) const {
  Conditioning out;
  {
    const std::lock_guard<std::mutex> lock(workspace_->guard);
    out = workspace_->probe.at(motion);
  }
  out.floors = sizes_.floors();
  const auto after = std::lower_bound(measured_.begin(), measured_.end(), motion.t,
                                      [](const Measured& each, double t) { return each.t < t; });
  const auto i = static_cast<std::size_t>(after - measured_.begin());
  const std::size_t first = i > neighbours ? i - neighbours : 0;
  const std::size_t last = std::min(i + neighbours, measured_.size() - 1);
  RoundingLevels spread = measured_here != nullptr ? measured_here->spread : uniformLevels(0);
  for (std::size_t k = std::min(first, last); k <= last; ++k)
    for (std::size_t q = 0; q < rounded_count; ++q) spread[q] = larger(spread[q], measured_[k].spread[q]);
  Conditioning well_conditioned = out;
  well_conditioned.kappa_B = well_conditioned.kappa_legs = 1;
  for (std::size_t q = 0; q < rounded_count; ++q)
    out.levels[q] = floorOf(out, well_conditioned, static_cast<Rounded>(q)) + rounding_safety * spread[q];
  return out;
}

Conditioning RoundingProfile::at(const Motion<double>& motion) const { return withLevels(motion, nullptr); }

Conditioning RoundingProfile::closer(const Motion<double>& motion, const Vector6d* torques) const {
  const Measured here = measure(motion, torques);
  return withLevels(motion, &here);
}

double RemeasuredLimits::limit(double error, const Conditioning& at, Rounded quantity, const Motion<double>& motion,
                               double factor, const Vector6d* torques) {
  const double first = factor * at.rounding(quantity);
  if (error <= first || confirmed_ || !std::isfinite(error)) return first;
  Conditioning closer = at;
  closer.levels = profile_.closer(motion, torques).levels;
  const double second = factor * closer.rounding(quantity);
  confirmed_ = error > second;
  return second;
}

std::vector<double> RoundingProfile::spreads(Rounded quantity) const {
  std::vector<double> out;
  for (const Measured& each : measured_) out.push_back(each.spread[static_cast<std::size_t>(quantity)]);
  return out;
}

}  // namespace ursula

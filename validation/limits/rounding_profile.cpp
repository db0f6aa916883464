#include "validation/limits/rounding_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "nocsolver/solver.h"
#include "validation/limits/viewpoint.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

/// Beside the scenario as it stands.
constexpr unsigned presentations = 3;
/// On either side of an instant, those whose spread counts.
constexpr std::size_t neighbours = 2;

double spin(const Vector6d& v, double length) { return v.tail<3>().norm() + length * v.head<3>().norm(); }

/// ψ and θ, which count from the machine itself, and φ by the axis x that turns with it.
double angleDistance(const Manipulator& machine, const JointVariables<double>& a, const JointVariables<double>& b,
                     const BodyMotions<double>& of_a, const BodyMotions<double>& of_b, double length) {
  double largest = 0;
  for (int i = 0; i < machine.legCount(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const LegKind kind = machine.leg(i).kind;
    // The plane of PUS is its rod's; ψ of it counts from an axis that is not turned along, too.
    const std::size_t in_plane = kind == LegKind::PUS ? leg_count + k : k;
    const double plane = (of_a[in_plane].R.col(0) - of_b[in_plane].R.col(0)).norm();
    const auto turn = [](double x, double y) { return std::abs(std::remainder(x - y, 2 * std::acos(-1.0))); };
    largest = larger(largest, plane);
    if (kind != LegKind::PUS) largest = larger(largest, turn(a.psi(i), b.psi(i)));
    largest = larger(largest, turn(a.theta(i), b.theta(i)));
    largest = larger(largest, std::abs(a.d(i) - b.d(i)) / length);
  }
  return largest;
}

double reactionDistance(const Reactions& a, const Reactions& b, double length) {
  double largest = 0;
  for (std::size_t i = 0; i < leg_count; ++i) largest = larger(largest, distance(a[i], b[i], length));
  return largest;
}

double torqueDistance(const Vector6d& a, const Vector6d& b) {
  return (a - b).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

void set(RoundingLevels& levels, Rounded quantity, double value) {
  double& level = levels[static_cast<std::size_t>(quantity)];
  level = larger(level, value);
}

void spreadOfBodies(const Manipulator& machine, const View& a, const View& b, double length, RoundingLevels& out) {
  for (std::size_t i = 0; i < body_count; ++i) {
    // A carriage's frame hangs on what is upright, not on the machine.
    const bool is_carriage =
        i < static_cast<std::size_t>(machine.legCount()) && machine.leg(static_cast<int>(i)).kind == LegKind::PUS;
    const double turn = is_carriage ? 0 : length;
    const auto pair = [&](const BodyMotions<double> View::*of) {
      const BodyMotion<double>&x = (a.*of)[i], &y = (b.*of)[i];
      return std::array<double, 3>{(x.c - y.c).norm() + turn * (x.R - y.R).norm(), spin(x.twist - y.twist, length),
                                   spin(x.twist_rate - y.twist_rate, length)};
    };
    const auto solver = pair(&View::bodies_solver), simbody = pair(&View::bodies_simbody);
    set(out, Rounded::positions, solver[0] + simbody[0]);
    set(out, Rounded::twists, solver[1] + simbody[1]);
    set(out, Rounded::twist_rates, solver[2] + simbody[2]);
  }
}

void spreadOfKinematics(const Manipulator& machine, const View& a, const View& b, double length, RoundingLevels& out) {
  spreadOfBodies(machine, a, b, length, out);
  set(out, Rounded::angles,
      angleDistance(machine, a.joints_solver.q, b.joints_solver.q, a.bodies_solver, b.bodies_solver, length) +
          angleDistance(machine, a.joints_simbody.q, b.joints_simbody.q, a.bodies_simbody, b.bodies_simbody, length));
  set(out, Rounded::rates,
      jointDistance(a.joints_solver.q_dot, b.joints_solver.q_dot, length) +
          jointDistance(a.joints_simbody.q_dot, b.joints_simbody.q_dot, length));
  set(out, Rounded::accelerations,
      jointDistance(a.joints_solver.q_ddot, b.joints_solver.q_ddot, length) +
          jointDistance(a.joints_simbody.q_ddot, b.joints_simbody.q_ddot, length));
  set(out, Rounded::jacobian, spin(a.jacobian - b.jacobian, length));
  set(out, Rounded::jacobian_rate, spin(a.jacobian_rate - b.jacobian_rate, length));
  const auto size = [length](const Matrix6d& T) { return T.bottomRows<3>().norm() + length * T.topRows<3>().norm(); };
  set(out, Rounded::shaping, size(a.T - b.T));
  set(out, Rounded::shaping_rate, size(a.T_rate - b.T_rate));
}

/// `effort` is T_PᵀM_P.
void spreadOfDynamics(const View& a, const View& b, const Matrix6d& effort, double length, RoundingLevels& out) {
  const double solver = torqueDistance(a.torques_solver, b.torques_solver);
  set(out, Rounded::solver, solver);
  set(out, Rounded::torque, solver + torqueDistance(a.torques_simbody, b.torques_simbody));
  for (std::size_t k = 0; k < further_road_count; ++k)
    if (a.torques_further[k] && b.torques_further[k])
      set(out, ofFurtherRoad(k), solver + torqueDistance(*a.torques_further[k], *b.torques_further[k]));
  set(out, Rounded::acceleration, spin(a.acceleration - b.acceleration, length));
  set(out, Rounded::effort, (effort * (a.acceleration - b.acceleration)).norm());
  set(out, Rounded::direct,
      spin(a.direct_solver - b.direct_solver, length) + spin(a.direct_simbody - b.direct_simbody, length));
  set(out, Rounded::reactions,
      reactionDistance(a.reactions_solver, b.reactions_solver, length) +
          reactionDistance(a.reactions_simbody, b.reactions_simbody, length));
}

RoundingLevels spreadOf(const Manipulator& machine, const std::vector<View>& views, const Matrix6d& effort,
                        double length) {
  RoundingLevels out = uniformLevels(0);
  for (std::size_t i = 0; i < views.size(); ++i) {
    set(out, Rounded::gaps, views[i].gap_acceleration);
    for (std::size_t j = 0; j < i; ++j) {
      spreadOfKinematics(machine, views[i], views[j], length, out);
      spreadOfDynamics(views[i], views[j], effort, length, out);
    }
  }
  return out;
}

/// In units of the shape; infinite where there is a spread and no shape.
void divideByShape(const Conditioning& at, RoundingLevels& spread) {
  for (std::size_t q = 0; q < rounded_count; ++q) {
    const double shape = at.shape(static_cast<Rounded>(q));
    if (spread[q] != 0) spread[q] = shape > 0 ? spread[q] / shape : std::numeric_limits<double>::infinity();
  }
}

/// As large as the motion's own, so that the direct dynamics are seen off the commanded motion.
Vector6d otherTorques(const Vector6d& torques) {
  const double size = torques.cwiseAbs().maxCoeff();
  Vector6d out = torques;
  for (int i = 0; i < motor_count; ++i) out(i) += (i % 2 == 0 ? 1 : -1) * size;
  return out;
}

/// In units of the shape; `even` is the same machine without condition numbers.
double floorOf(const Conditioning& at, const Conditioning& even, Rounded quantity) {
  const double share = floor_share / std::numeric_limits<double>::epsilon();
  const double shape = at.shape(quantity);
  return shape > 0 ? std::min(rounding_floor, share * even.shape(quantity) / shape) : rounding_floor;
}

bool areSame(const Motion<double>& a, const Motion<double>& b) {
  return a.p == b.p && a.Q == b.Q && a.omega == b.omega && a.p_dot == b.p_dot && a.omega_dot == b.omega_dot &&
         a.p_ddot == b.p_ddot;
}

/// By a billionth of `length`, another way for each k: the same machine and pose, rounded otherwise.
void nudge(Motion<double>& motion, int k, double length) {
  for (int axis = 0; axis < 3; ++axis) motion.p(axis) += 0x1p-30 * length * std::sin(1.0 + k + 2.3 * axis);
}

}  // namespace

int profileInstants(int samples) { return std::clamp(samples, 2, 61); }

struct RoundingProfile::Workshop {
  explicit Workshop(const Scenario& scenario)
      : machine(*scenario.manipulator),
        load(scenario.load),
        solver(*scenario.manipulator),
        probe(*scenario.manipulator, scenario.load) {
    viewpoints.emplace_back(scenario, Presentation(*scenario.manipulator));
    for (unsigned k = 0; k < presentations; ++k)
      viewpoints.emplace_back(scenario, randomPresentation(k + 1, solver.length(), *scenario.manipulator));
  }

  std::mutex guard;
  Manipulator machine;
  std::shared_ptr<const Load> load;
  Solver<double> solver;
  Workspace<double> work;
  ConditioningProbe probe;
  std::vector<Viewpoint> viewpoints;
};

RoundingProfile::RoundingProfile(const Scenario& scenario, int instants)
    : workshop_(std::make_unique<Workshop>(scenario)) {
  Motion<double> first_of_held;
  for (int k = 0; k < instants; ++k) {
    const double t = instants > 1 ? scenario.trajectory->duration() * k / (instants - 1) : 0;
    Motion<double> motion = scenario.trajectory->at(t);
    if (k > 0 && areSame(motion, first_of_held))
      nudge(motion, k, workshop_->solver.length());  // or a held pose would be measured once, however often
    else
      first_of_held = motion;
    measured_.push_back(measure(motion, nullptr));
  }
}

RoundingProfile::~RoundingProfile() = default;

RoundingProfile::Measured RoundingProfile::measure(const Motion<double>& motion, const Vector6d* torques) const {
  Workshop& w = *workshop_;
  const std::lock_guard<std::mutex> lock(w.guard);
  Measured here;
  here.t = motion.t;
  const Conditioning conditioning = w.probe.at(motion);
  const Vector6d commanded = w.solver.inverseDynamics(motion, w.work, loadAtP(w.load.get(), motion));
  w.solver.inverseKinematics(motion, w.work);
  w.solver.jacobians(motion, w.work);
  const Matrix6d effort = w.solver.T(w.work).transpose() * w.solver.massMatrixAtP(motion, w.work);
  std::vector<View> views;
  for (Viewpoint& viewpoint : w.viewpoints)
    views.push_back(viewpoint.at(motion, torques != nullptr ? *torques : otherTorques(commanded)));
  here.spread = spreadOf(w.machine, views, effort, conditioning.length);
  divideByShape(conditioning, here.spread);
  return here;
}

Conditioning RoundingProfile::leveled(const Motion<double>& motion, const Measured* itself) const {
  Conditioning out;
  {
    const std::lock_guard<std::mutex> lock(workshop_->guard);
    out = workshop_->probe.at(motion);
  }
  const auto after = std::lower_bound(measured_.begin(), measured_.end(), motion.t,
                                      [](const Measured& each, double t) { return each.t < t; });
  const auto i = static_cast<std::size_t>(after - measured_.begin());
  const std::size_t first = i > neighbours ? i - neighbours : 0;
  const std::size_t last = std::min(i + neighbours, measured_.size() - 1);
  out.levels = itself != nullptr ? itself->spread : uniformLevels(0);
  for (std::size_t k = std::min(first, last); k <= last; ++k)
    for (std::size_t q = 0; q < rounded_count; ++q) out.levels[q] = larger(out.levels[q], measured_[k].spread[q]);
  Conditioning even = out;
  even.kappa_B = even.kappa_legs = 1;
  for (std::size_t q = 0; q < rounded_count; ++q)
    out.levels[q] = floorOf(out, even, static_cast<Rounded>(q)) + rounding_safety * out.levels[q];
  return out;
}

Conditioning RoundingProfile::at(const Motion<double>& motion) const { return leveled(motion, nullptr); }

Conditioning RoundingProfile::closer(const Motion<double>& motion, const Vector6d* torques) const {
  const Measured here = measure(motion, torques);
  return leveled(motion, &here);
}

double SecondLook::limit(double error, const Conditioning& at, Rounded quantity, const Motion<double>& motion,
                         double factor, const Vector6d* torques) {
  const double first = factor * at.rounding(quantity);
  if (error <= first || confirmed_ || !std::isfinite(error)) return first;
  const RoundingLevels levels = profile_.closer(motion, torques).levels;
  const double second = factor * at.shape(quantity) * levels[static_cast<std::size_t>(quantity)];
  confirmed_ = error > second;
  return second;
}

std::vector<double> RoundingProfile::spreads(Rounded quantity) const {
  std::vector<double> out;
  for (const Measured& each : measured_) out.push_back(each.spread[static_cast<std::size_t>(quantity)]);
  return out;
}

}  // namespace ursula

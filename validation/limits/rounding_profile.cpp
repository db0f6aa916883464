#include "validation/limits/rounding_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "nocsolver/noc/noc.h"
#include "validation/limits/engine_view.h"
#include "validation/limits/moved_inputs.h"
#include "validation/limits/solver_rounding.h"
#include "validation/limits/spreads.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

/// Changes of the engines' inputs, and of their frame.
constexpr unsigned engine_moves = 3, frame_changes = 3;
/// Number of instants on either side whose spread counts.
constexpr std::size_t neighbours = 2;

/// Divides by the shape, or by the floor if that is larger; infinite if there is a spread without either.
void divideByShape(const Conditioning& at, RoundingLevels& spread) {
  for (std::size_t q = 0; q < rounded_count; ++q) {
    const double shape = std::max(at.floors[q], at.shape(static_cast<Rounded>(q)));
    if (spread[q] != 0) spread[q] = shape > 0 ? spread[q] / shape : std::numeric_limits<double>::infinity();
  }
}

/// The least level: rounding_floor, or less where condition numbers alone would exceed floor_share.
double floorOf(const Conditioning& at, Rounded quantity) {
  Conditioning well_conditioned = at;
  well_conditioned.kappa_B = well_conditioned.kappa_legs = 1;
  const double share = floor_share / std::numeric_limits<double>::epsilon();
  const double shape = at.shape(quantity);
  return shape > 0 ? std::min(rounding_floor, share * well_conditioned.shape(quantity) / shape) : rounding_floor;
}

/// The length of the shortest link that has a direction of its own, m.
double shortestLink(const Manipulator& machine) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Leg& leg : machine.parameters().legs) {
    const bool turns = !rowOf(leg.kind).hasCarriage() && !rowOf(leg.kind).isTelescopic();
    shortest = std::min(shortest, turns ? std::min(leg.proximal.length, leg.distal.length) : leg.distal.length);
  }
  return shortest;
}

/// The largest spread of `quantity` that rounding explains, in units of its shape. Its size adds at most two norms of
/// 18 components, as for T. A link's motion loses what its ends lose over its length; the shape has the machine's.
double mostSpread(const Conditioning& at, double shortest_link, Rounded quantity) {
  const bool of_links = quantity <= Rounded::twist_rates;
  return 2 * std::sqrt(18.0) * most_spread * (of_links ? std::max(1.0, at.length / shortest_link) : 1);
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
  Workspace(const Scenario& scenario, const FormulationFaults& faults)
      : machine(*scenario.manipulator),
        noc(machine),
        solver(machine, scenario.load, faults.solver),
        probe(machine, scenario.load),
        shortest_link(shortestLink(machine)) {
    engines.emplace_back(scenario, FrameChange(machine), faults);
    for (unsigned k = 0; k < engine_moves; ++k)
      engines.emplace_back(moved(scenario, k + 1), FrameChange(machine), faults);
    for (unsigned k = 0; k < frame_changes; ++k)
      elsewhere.emplace_back(scenario, randomFrameChange(k + 1, noc.machine().length, machine), faults);
  }

  std::mutex guard;
  Manipulator machine;
  Noc<double> noc;
  NocWorkspace<double> work;
  SolverRounding solver;
  ConditioningProbe probe;
  double shortest_link;
  std::vector<EngineFrameChange> engines;    ///< with the given numbers, then with changed ones
  std::vector<EngineFrameChange> elsewhere;  ///< in other changes of frame
};

RoundingProfile::RoundingProfile(const Scenario& scenario, int instants, const Deadline& deadline,
                                 const FormulationFaults& faults)
    : sizes_(scenario, deadline), workspace_(std::make_unique<Workspace>(scenario, faults)) {
  Motion<double> last_distinct;
  for (int k = 0; k < instants; ++k) {
    deadline.require();
    const double t = instants > 1 ? scenario.trajectory->duration() * k / (instants - 1) : 0;
    Motion<double> motion = scenario.trajectory->at(t);
    if (k > 0 && sameState(motion, last_distinct))
      nudge(motion, k, workspace_->noc.machine().length);  // without this a held pose would repeat one measurement
    else
      last_distinct = motion;
    std::vector<std::size_t> frames;  // one in turn, or several if there are fewer instants
    for (std::size_t j = k % frame_changes; j < frame_changes; j += instants) frames.push_back(j);
    motions_.push_back(motion);
    measured_.push_back(measure(motion, nullptr, frames));
  }
}

RoundingProfile::~RoundingProfile() = default;

RoundingProfile::Measured RoundingProfile::measure(const Motion<double>& motion, const Vector6d* torques,
                                                   const std::vector<std::size_t>& frames) const {
  Workspace& w = *workspace_;
  const std::lock_guard<std::mutex> lock(w.guard);
  Measured here;
  here.t = motion.t;
  Conditioning conditioning = w.probe.at(motion);
  conditioning.floors = sizes_.floors();
  const Vector6d commanded = w.solver.torques(motion), others = torques != nullptr ? *torques : otherTorques(commanded);
  const std::vector<SolverView> solver = w.solver.at(motion, others);
  std::vector<EngineView> engines;
  for (std::size_t k = 0; k < w.engines.size(); ++k)
    engines.push_back(w.engines[k].at(k == 0 ? motion : moved(motion, static_cast<unsigned>(k)), commanded, others));
  w.noc.displacements(motion, w.work);
  const Matrix6d to_efforts = solver.front().T.transpose() * w.noc.massMatrixAtP(motion, w.work);
  const JointMotion& simbody = engines.front().joints;
  const Motors motors = w.machine.motors();
  const DrivenMotion driven = {simbody.q_dot.driven(motors), simbody.q_ddot.driven(motors)};
  here.solver = spreadOfSolver(w.machine, solver, driven, to_efforts, conditioning.length);
  const auto apart = [&](const std::vector<EngineView>& views) {
    return spreadOfEngines(w.machine, views, solver.front(), to_efforts, conditioning.length);
  };
  here.engines = apart(engines);
  for (const std::size_t k : frames) {
    const RoundingLevels here_and_there = apart({engines.front(), w.elsewhere[k].at(motion, commanded, others)});
    for (std::size_t q = 0; q < rounded_count; ++q)
      here.across_frames[q] = larger(here.across_frames[q], here_and_there[q]);
  }
  for (RoundingLevels* each : {&here.solver, &here.engines, &here.across_frames}) divideByShape(conditioning, *each);
  return here;
}

std::pair<std::size_t, std::size_t> RoundingProfile::nearest(double t) const {
  const auto after = std::lower_bound(measured_.begin(), measured_.end(), t,
                                      [](const Measured& each, double at) { return each.t < at; });
  const std::size_t i = after - measured_.begin();
  const std::size_t first = i > neighbours ? i - neighbours : 0;
  const std::size_t last = std::min(i + neighbours, measured_.size() - 1);
  return {std::min(first, last), last};
}

Conditioning RoundingProfile::withLevels(const Motion<double>& motion, const Measured* measured_here) const {
  Conditioning out;
  {
    const std::lock_guard<std::mutex> lock(workspace_->guard);
    out = workspace_->probe.at(motion);
  }
  out.floors = sizes_.floors();
  std::vector<const Measured*> about;
  if (measured_here != nullptr) about.push_back(measured_here);
  const auto [first, last] = nearest(motion.t);
  for (std::size_t k = first; k <= last; ++k) about.push_back(&measured_[k]);
  for (std::size_t q = 0; q < rounded_count; ++q) {
    const double most = mostSpread(out, workspace_->shortest_link, static_cast<Rounded>(q));
    double of_both = 0;
    for (const Measured* each : about) {
      const double solver = each->solver[q], engine = each->engines[q];
      of_both = larger(of_both, solver + engine);  // a limit covers the difference of both sides
      if (!(solver <= most)) out.noisy[q] = Noisy::solver;
      if (!(engine <= most)) out.noisy[q] = Noisy::engine;
    }
    out.levels[q] = out.noisy[q] == Noisy::nobody ? floorOf(out, static_cast<Rounded>(q)) + rounding_safety * of_both
                                                  : std::numeric_limits<double>::infinity();
  }
  return out;
}

Conditioning RoundingProfile::at(const Motion<double>& motion) const { return withLevels(motion, nullptr); }

Conditioning RoundingProfile::closer(const Motion<double>& motion, const Vector6d* torques) const {
  const Measured here = measure(motion, torques, {});
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
  const auto q = static_cast<std::size_t>(quantity);
  std::vector<double> out;
  for (const Measured& each : measured_) out.push_back(each.solver[q] + each.engines[q]);
  return out;
}

double RoundingProfile::largestOfOne(Rounded quantity) const {
  const auto q = static_cast<std::size_t>(quantity);
  double out = 0;
  for (std::size_t k = 0; k < measured_.size(); ++k)
    out = larger(out, larger(measured_[k].solver[q], measured_[k].engines[q]) /
                          mostSpread(at(motions_[k]), workspace_->shortest_link, quantity));
  return out;
}

std::vector<FrameDifference> RoundingProfile::acrossFrames() const {
  std::vector<FrameDifference> out;
  for (std::size_t k = 0; k < measured_.size(); ++k) {
    Conditioning here = at(motions_[k]);
    const auto [first, last] = nearest(measured_[k].t);
    for (std::size_t q = 0; q < rounded_count; ++q) {
      const auto quantity = static_cast<Rounded>(q);
      if (!isEffortOfEngine(quantity)) continue;
      double spread = 0;
      for (std::size_t i = first; i <= last; ++i) spread = larger(spread, measured_[i].engines[q]);
      here.levels[q] = spread <= mostSpread(here, workspace_->shortest_link, quantity)
                           ? floorOf(here, quantity) + rounding_safety * spread
                           : std::numeric_limits<double>::infinity();
      const double shape = std::max(here.floors[q], here.shape(quantity));  // 0 where nothing acts
      out.push_back(
          {measured_[k].t, quantity, shape > 0 ? measured_[k].across_frames[q] * shape : 0, here.rounding(quantity)});
    }
  }
  return out;
}

}  // namespace ursula

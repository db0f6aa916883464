#include "parts/random/random_scenario.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "base/errors.h"
#include "parts/fast/solver.h"
#include "parts/random/random_parts.h"
#include "validation/limits/conditioning.h"

namespace ursula {
namespace {

constexpr double smallest_sine = 0.03;   // for a knee
constexpr double smallest_lever = 0.05;  // distance of B from its leg's axis, as a share of |AB|

/// Equally spaced instants, and four in every interval between knots.
std::vector<double> instantsOf(const Trajectory& trajectory) {
  constexpr int count = 61;
  std::vector<double> out;
  out.reserve(count);
  for (int k = 0; k < count; ++k) out.push_back(trajectory.duration() * k / (count - 1));
  const std::vector<double>& knots = trajectory.knots();
  for (std::size_t i = 1; i < knots.size(); ++i)
    for (int k = 0; k < 4; ++k) out.push_back(knots[i - 1] + (knots[i] - knots[i - 1]) * k / 4);
  std::sort(out.begin(), out.end());
  return out;
}

/// Checks poses only: whether all legs follow with a sufficient margin, on one side of the singular poses.
class Follower {
 public:
  explicit Follower(const Manipulator& manipulator) : solver_(manipulator) {}

  bool follows(const Motion<double>& motion) {
    solver_.displacements(motion, work_);
    for (int i = 0; i < solver_.machine().legs_in_all; ++i) {
      const LegMargins<double> margins = solver_.margins(work_, i);
      if (!(margins.sine >= smallest_sine && smallest_lever * margins.leverage <= 1)) return false;
    }
    solver_.jacobians(motion, work_);
    const double determinant = solver_.B(work_).determinant();
    const bool same_side = determinant * side_ >= 0;
    side_ = determinant;
    return same_side && determinant != 0;
  }

 private:
  Solver<double> solver_;
  Workspace<double> work_;
  double side_ = 0;
};

double kappaOf(const Conditioning& c) { return c.kappa_B * c.kappa_legs; }

/// Whether the machine can take the middle pose with some margin for motion.
bool canStand(const RandomRecipe& recipe, const Design& design, const Manipulator& manipulator) {
  Motion<double> motion;
  motion.p = design.position;
  motion.Q = design.orientation.toRotationMatrix();
  if (!Follower(manipulator).follows(motion)) return false;
  const double kappa = kappaOf(ConditioningProbe(manipulator, nullptr).at(motion));
  // For motions near a singularity the middle pose must be near it already; otherwise few motions come near.
  if (recipe.near_singular) return kappa > 3e3 && kappa < recipe.largestKappa();
  return 3 * kappa < recipe.largestKappa();
}

/// Whether every leg follows the whole motion, as far from singularities as the recipe requires.
bool canBeJudged(const RandomRecipe& recipe, const Scenario& scenario) {
  const std::vector<double> instants = instantsOf(*scenario.trajectory);
  Follower follower(*scenario.manipulator);
  for (const double t : instants)
    if (!follower.follows(scenario.trajectory->at(t))) return false;
  ConditioningProbe probe(*scenario.manipulator, scenario.load);
  double worst = 0;
  for (const double t : instants) {
    const double kappa = kappaOf(probe.at(scenario.trajectory->at(t)));
    if (!(kappa < recipe.largestKappa())) return false;
    worst = std::max(worst, kappa);
  }
  constexpr double near = 1e4;
  return !recipe.near_singular || worst >= near;
}

/// Tries smaller and smaller motions until the legs follow. Near a singularity it starts with larger ones and takes
/// smaller steps, so the first success comes close to it.
bool findMotion(Dice& dice, const RandomRecipe& recipe, const Design& design, int& draws, Scenario& scenario) {
  const double factor = recipe.near_singular ? 0.75 : 0.6;
  double share = recipe.near_singular ? 1.5 : 1;
  for (int k = 0; k < (recipe.near_singular ? 10 : 5); ++k, share *= factor) try {
      ++draws;
      scenario.trajectory = randomMotion(dice, recipe, design, share);
      if (canBeJudged(recipe, scenario)) return true;
    } catch (const PoseError&) {  // a leg cannot reach
    } catch (const InvalidParameter&) {
    }
  return false;
}

bool tryDesign(Dice& dice, const RandomRecipe& recipe, int& draws, Scenario& scenario) {
  ++draws;
  try {
    const Design design = randomDesign(dice, recipe);
    const auto manipulator = std::make_shared<const Manipulator>(design.machine);
    if (!canStand(recipe, design, *manipulator)) return false;
    --draws;  // the design is counted with its motions
    scenario.manipulator = manipulator;
    scenario.load = randomLoad(dice, recipe, design);
    return findMotion(dice, recipe, design, draws, scenario);
  } catch (const PoseError&) {
  } catch (const InvalidParameter&) {
  }
  return false;
}

std::string nameFor(std::uint64_t seed, RandomKind kind) {
  return kind == RandomKind::URS ? fmt::format("random-{}", seed) : fmt::format("random-{}-{}", nameOf(kind), seed);
}

/// A quarter of the machines has rotors, on some or all motors, of 0.003 to 3 times the rod's m s² or m. They have
/// their own random stream, so the other numbers do not depend on them.
bool addRotors(std::uint64_t seed, ManipulatorParameters& machine) {
  Dice dice(seed ^ 0x726f746f72);
  if (!dice.chance(0.25)) return false;
  for (Leg& leg : machine.legs)
    for (std::size_t j = 0; j < 3; ++j) {
      if (!leg.actuated[j] || !dice.chance(0.8)) continue;
      const Coordinate coordinate = rowOf(leg.kind).coordinates[j];
      const double lever = slides(coordinate) ? 1 : leg.distal.length;
      leg.rotor_inertia.on(coordinate) = dice.spread(0.003, 3) * leg.distal.mass * lever * lever;
    }
  return true;
}

}  // namespace

Scenario randomScenario(std::uint64_t seed, RandomKind kind) {
  Dice dice(seed);
  int draws = 0;
  for (int attempt = 0; attempt < 200; ++attempt) {
    const RandomRecipe recipe = randomRecipe(dice, kind);
    Scenario scenario;
    scenario.name = nameFor(seed, kind);
    scenario.file = scenario.name;
    // A recipe that no design satisfies is replaced.
    for (int design = 0; design < 100; ++design) {
      if (!tryDesign(dice, recipe, draws, scenario)) continue;
      scenario.text = fmt::format("seed {}, draw {}: {}: {}", seed, draws, scenario.trajectory->kind(), recipe.text());
      ManipulatorParameters machine = scenario.manipulator->parameters();
      if (addRotors(seed, machine)) scenario.manipulator = std::make_shared<const Manipulator>(machine);
      return scenario;
    }
  }
  throw std::runtime_error(fmt::format("seed {} gave no motion that the legs can follow", seed));
}

}  // namespace ursula

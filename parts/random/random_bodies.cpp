#include <algorithm>
#include <cmath>

#include "base/scalar.h"
#include "parts/random/random_parts.h"

namespace ursula {
namespace {

/// Draws a mass centre. At most one leg has it exactly at an end, so that no two legs share a number.
double massCentre(Dice& dice, const RandomRecipe& recipe, bool may_be_at_end, double length) {
  if (!recipe.centres_anywhere) return dice.uniform(0.2, 0.8) * length;
  if (may_be_at_end) return dice.chance(0.5) ? 0 : length;
  if (dice.chance(0.3)) {
    const double end = dice.whole(0, 1);
    return (end + dice.spreadOfEitherSign(1e-6, 0.05)) * length;
  }
  return dice.uniform(-1.5, 2.5) * length;
}

/// Squares of the mass's extents: similar, tiny relative to m l², along a line, or in a plane.
Vector3d extents(Dice& dice, Inertias kind) {
  if (kind == Inertias::mixed) kind = dice.pick<Inertias>(4);
  const double scale = kind == Inertias::points ? dice.spread(1e-6, 1e-3) : dice.spread(0.01, 0.15);
  Vector3d squares = dice.vector(0.2, 1);
  if (kind == Inertias::rods) squares.head<2>() *= dice.spread(1e-6, 1e-3);
  if (kind == Inertias::laminae) squares.z() *= dice.spread(1e-12, 1e-4);
  return scale * squares;
}

/// Principal moments within the triangle inequality, with random axes.
Matrix3d randomInertia(Dice& dice, Inertias kind, double mass, double size) {
  const Vector3d squares = mass * size * size * extents(dice, kind);
  const Vector3d moments(squares.y() + squares.z(), squares.z() + squares.x(), squares.x() + squares.y());
  const Matrix3d R = dice.turn(pi).toRotationMatrix();
  const Matrix3d I = R * moments.asDiagonal() * R.transpose();
  return (I + I.transpose()) / 2;
}

/// Up to `largest` for rotating coordinates, and up to `largest` over `length` for sliding ones.
JointFriction randomFriction(Dice& dice, LegKind kind, double largest, double length) {
  JointFriction out;
  for (const Coordinate q : rowOf(kind).coordinates)
    out.on(q) = dice.uniform(0.001, 1) * (slides(q) ? largest / length : largest);
  return out;
}

/// Draws viscous and Coulomb friction of at most a share of the weight that the leg carries.
void drawFriction(Dice& dice, const RandomRecipe& recipe, double torque, Leg& leg) {
  const double time = recipe.time(), length = recipe.length;
  if (recipe.viscous) {
    const double largest = dice.spread(0.01, 0.5) * torque * time;
    // A sliding rate is one length per time, so its coefficient is divided by the length twice.
    leg.friction = randomFriction(dice, leg.kind, largest, length * length);
  }
  leg.coulomb.smoothing_speed = dice.spread(0.003, 0.3) / time;
  if (rowOf(leg.kind).isTelescopic() || rowOf(leg.kind).hasCarriage())
    leg.coulomb.sliding_speed = dice.spread(0.003, 0.3) / time * length;
  if (recipe.coulomb)
    static_cast<JointFriction&>(leg.coulomb) = randomFriction(dice, leg.kind, dice.spread(0.01, 0.2) * torque, length);
}

/// Masses of the platform and of a mean link, kg, and the largest factor between a link and that mean.
struct MassScales {
  double platform, links, within;
};

MassScales massScales(Dice& dice, const RandomRecipe& recipe) {
  MassScales scales{recipe.mass * dice.spread(1, 50), recipe.mass, 2};
  if (recipe.masses == Masses::apart) {
    scales.platform = recipe.mass * dice.spread(1e-3, 1e3);
    scales.links = recipe.mass * dice.spread(1e-3, 1e3);
  }
  if (recipe.masses == Masses::mixed) scales.within = 1e3;
  return scales;
}

Link randomLink(Dice& dice, const RandomRecipe& recipe, const MassScales& scales, bool may_be_at_end, Link link) {
  link.mass = scales.links * dice.spread(1 / scales.within, scales.within);
  link.center_of_mass = massCentre(dice, recipe, may_be_at_end, link.length);
  link.inertia = randomInertia(dice, recipe.inertias, link.mass, link.length);
  return link;
}

}  // namespace

void drawBodies(Dice& dice, const RandomRecipe& recipe, const Vector3d& middle, ManipulatorParameters& machine) {
  const MassScales scales = massScales(dice, recipe);
  Platform& platform = machine.platform;
  platform.mass = scales.platform;
  platform.center_of_mass = middle + recipe.platform_centre * dice.direction();
  platform.inertia = randomInertia(dice, recipe.inertias, platform.mass, recipe.length);
  const std::size_t at_end = dice.pick<std::size_t>(static_cast<int>(machine.legs.size()));
  for (std::size_t i = 0; i < machine.legs.size(); ++i) {
    Leg& leg = machine.legs[i];
    const bool proximal_at_end = i == at_end && dice.chance(0.5);
    leg.proximal = randomLink(dice, recipe, scales, proximal_at_end, leg.proximal);
    leg.distal = randomLink(dice, recipe, scales, i == at_end && !proximal_at_end, leg.distal);
    const double carried =
        platform.mass / static_cast<double>(machine.legs.size()) + leg.proximal.mass + leg.distal.mass;
    drawFriction(dice, recipe, carried * recipe.acceleration * recipe.length, leg);
  }
}

namespace {

double totalMass(const ManipulatorParameters& machine) {
  double mass = machine.platform.mass;
  for (const Leg& leg : machine.legs) mass += leg.proximal.mass + leg.distal.mass;
  return mass;
}

Wrench<double> randomWrench(Dice& dice, double force, double length) {
  Wrench<double> wrench;
  wrench.force = dice.vector(force);
  wrench.moment = dice.vector(force * length);
  return wrench;
}

/// Rows that may start before the motion and end after it.
std::vector<TimedWrench> smoothRows(Dice& dice, const RandomRecipe& recipe, double force) {
  const int count = dice.whole(2, 7);
  std::vector<TimedWrench> rows;
  double time = dice.uniform(-0.2, 0.2) * recipe.duration;
  for (int k = 0; k < count; ++k) {
    rows.push_back({time, randomWrench(dice, force, recipe.length)});
    time += dice.spread(0.1, 0.8) * recipe.duration;
  }
  return rows;
}

/// Steps, each between two rows some thousandths of the machine's time apart: a millisecond for a machine of a metre.
std::vector<TimedWrench> jumpingRows(Dice& dice, const RandomRecipe& recipe, double force) {
  const int count = dice.whole(1, 3);
  std::vector<TimedWrench> rows;
  Wrench<double> wrench = randomWrench(dice, force, recipe.length);
  for (int k = 0; k < count; ++k) {
    const double time = (k + dice.uniform(0.1, 0.9)) / count * recipe.duration;
    const double gap = std::min(dice.spread(1e-3, 1e-2) * recipe.time(), 0.05 * recipe.duration / count);
    rows.push_back({time, wrench});
    wrench = randomWrench(dice, force, recipe.length);
    rows.push_back({time + gap, wrench});
  }
  return rows;
}

}  // namespace

std::shared_ptr<const Load> randomLoad(Dice& dice, const RandomRecipe& recipe, const Design& design) {
  if (recipe.load == LoadKind::none) return nullptr;
  auto load = std::make_shared<Load>();
  const double force = dice.spread(0.01, 2) * totalMass(design.machine) * recipe.acceleration;
  const double arm = recipe.load_far ? dice.spread(1, 10) : dice.uniform(0, 0.7);
  load->point = design.middle + arm * recipe.length * dice.direction();
  load->frame = dice.chance(0.5) ? Load::Frame::base : Load::Frame::platform;
  if (recipe.load == LoadKind::constant) {
    const Wrench<double> wrench = randomWrench(dice, force, recipe.length);
    load->force = wrench.force;
    load->moment = wrench.moment;
  } else {
    load->history = std::make_shared<LoadHistory>(recipe.load == LoadKind::jumps ? jumpingRows(dice, recipe, force)
                                                                                 : smoothRows(dice, recipe, force));
  }
  return load;
}

}  // namespace ursula

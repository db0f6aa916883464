#include <algorithm>

#include "studies/random/random_parts.h"

namespace ursula {
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
std::vector<TimedWrench> smoothRows(Dice& dice, const Recipe& recipe, double force) {
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
std::vector<TimedWrench> jumpingRows(Dice& dice, const Recipe& recipe, double force) {
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

std::shared_ptr<const Load> randomLoad(Dice& dice, const Recipe& recipe, const Design& design) {
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

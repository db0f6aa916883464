#include "studies/random/random_parts.h"

#include <cmath>

#include "base/angles.h"

namespace ursula {
namespace {

/// A helix with its middle at `position`; the platform takes the triad there. About a distant origin it hardly turns
/// while it covers a share of the machine.
void drawHelix(Dice& dice, const Recipe& recipe, Design& design) {
  HelixParameters& helix = design.helix;
  const Vector3d& p = design.position;
  const double way = dice.uniform(0.05, 0.25) * recipe.length;
  helix.radius = std::hypot(p.x(), p.y());
  const double sweep = std::min(dice.uniform(0.1, 0.6), way / helix.radius);
  helix.pitch = dice.spreadOfEitherSign(0.2, 1) * way / sweep;
  const double middle = dice.uniform(-pi, pi);
  helix.start_angle = middle - sweep / 2;
  helix.end_angle = middle + sweep / 2;
  if (dice.chance(0.3)) std::swap(helix.start_angle, helix.end_angle);
  helix.phase = std::atan2(p.y(), p.x()) - middle;
  helix.height_phase = p.z() / helix.pitch - middle;
  helix.duration = recipe.duration;
  if (dice.chance(0.3)) {  // otherwise at rest at both ends
    const double rate = sweep / helix.duration;
    helix.start_rate = dice.uniform(-1, 1) * rate;
    helix.end_rate = dice.uniform(-1, 1) * rate;
    helix.start_acceleration = dice.uniform(-3, 3) * rate / helix.duration;
    helix.end_acceleration = dice.uniform(-3, 3) * rate / helix.duration;
  }
}

/// The helix's triad at its middle, as in model/trajectories/helix.cpp.
Eigen::Quaterniond helixTriad(const HelixParameters& helix) {
  const double angle = (helix.start_angle + helix.end_angle) / 2 + helix.phase;
  const double c = std::cos(angle), s = std::sin(angle);
  const Vector3d e_t = Vector3d(-helix.radius * s, helix.radius * c, helix.pitch).normalized();
  const Vector3d e_n(-c, -s, 0);
  Matrix3d Q;
  Q << -e_t.cross(e_n), e_n, e_t;
  return Eigen::Quaterniond(Q);
}

/// Places the layout randomly in B, and M randomly on the platform.
void placeLegs(Dice& dice, const Recipe& recipe, const Layout& layout, Design& design) {
  const Eigen::Quaterniond turn = dice.turn(recipe.turned ? pi : 0.1);
  const Vector3d origin = recipe.offset * dice.direction();
  const auto inBase = [&](const Vector3d& v) { return Vector3d(origin + turn * (recipe.length * v)); };
  Vector3d middle = Vector3d::Zero();
  for (const LegPlace& place : layout) middle += inBase(place.B) / static_cast<double>(layout.size());
  design.position = middle + recipe.platform_offset * dice.direction();
  if (recipe.motion == MotionKind::helix) {
    drawHelix(dice, recipe, design);
    design.orientation = helixTriad(design.helix);
  } else {
    design.orientation = dice.turn(dice.chance(0.7) ? 0.5 : pi);
  }
  const Eigen::Quaterniond inverse = design.orientation.conjugate();
  design.middle = inverse * (middle - design.position);
  design.machine.legs.resize(layout.size());
  for (std::size_t i = 0; i < layout.size(); ++i) {
    Leg& leg = design.machine.legs[i];
    leg.base_point = inBase(layout[i].A);
    leg.platform_point = inverse * (inBase(layout[i].B) - design.position);
    leg.base_axis = recipe.axis_along_z ? layout[i].axis : turn * layout[i].axis;
    leg.proximal.length = layout[i].l * recipe.length;
    leg.distal.length = layout[i].s * recipe.length;
    leg.knee = layout[i].knee;
    leg.kind = recipe.legs[i].kind;
    leg.actuated = recipe.legs[i].actuated;
  }
}

Vector3d gravityDirection(Dice& dice, GravityKind kind) {
  const double around = dice.uniform(-pi, pi);
  const Vector3d sideways(std::cos(around), std::sin(around), 0);
  switch (kind) {
    case GravityKind::none:
      return Vector3d::Zero();
    case GravityKind::tilted:
      return dice.direction();
    case GravityKind::up:
      return (Vector3d::UnitZ() + dice.vector(0.1)).normalized();
    case GravityKind::sideways:
      return (sideways + dice.vector(0.05)).normalized();
    case GravityKind::down:
      break;
  }
  return (-Vector3d::UnitZ() + dice.vector(0.05)).normalized();
}

}  // namespace

Vector3d randomGravity(Dice& dice, const Recipe& recipe) {
  return recipe.acceleration * gravityDirection(dice, recipe.gravity);
}

Design randomDesign(Dice& dice, const Recipe& recipe) {
  Design design;
  placeLegs(dice, recipe, randomLayout(dice, recipe), design);
  design.machine.gravity = randomGravity(dice, recipe);
  drawBodies(dice, recipe, design.middle, design.machine);
  return design;
}

}  // namespace ursula

#include <cmath>

#include "base/scalar.h"
#include "studies/random/random_parts.h"

namespace ursula {
namespace {

Vector3d onRing(double radius, double angle) { return {radius * std::cos(angle), radius * std::sin(angle), 0}; }

/// The common numbers of a layout's legs.
struct Rings {
  double base = 1, platform = 1, height = 1;  ///< radii, and the platform's height above the base
  double turn = 0;                            ///< rotation of everything about z
  double scatter = 0;                         ///< random offset of every point, so that no two legs share a number
  double base_half = 0, platform_half = 0;    ///< half the angle between the legs of a pair
};

Rings randomRings(Dice& dice, Arrangement arrangement) {
  Rings rings;
  rings.base = dice.uniform(0.7, 1.6);
  rings.platform = rings.base * dice.uniform(0.4, 0.9);
  rings.height = dice.uniform(0.4, 1.1);
  if (dice.chance(0.15)) rings.height = -rings.height;
  rings.turn = dice.uniform(-pi, pi);
  rings.scatter = dice.uniform(0.02, 0.1);
  switch (arrangement) {
    case Arrangement::paper:
      rings.base_half = rings.platform_half = dice.uniform(1, 6) * degree;
      break;
    case Arrangement::three_three:  // shared points are nearly equal, not exactly
      rings.scatter = dice.spread(1e-3, 0.03);
      rings.platform_half = 60 * degree;
      break;
    case Arrangement::six_three:
      rings.scatter = dice.spread(1e-3, 0.03);
      rings.base_half = dice.uniform(10, 40) * degree;
      break;
    case Arrangement::ring:
      rings.base_half = dice.uniform(25, 35) * degree;
      rings.platform_half = dice.uniform(5, 55) * degree;
      break;
    case Arrangement::anywhere:
      break;
  }
  return rings;
}

Vector3d randomAxis(Dice& dice, Axes axes, double angle, double side) {
  const Vector3d radius = onRing(1, angle), tangent = onRing(side, angle + pi / 2);
  switch (axes) {
    case Axes::tilted: {  // 20° in the paper
      const double tilt = dice.uniform(5, 50) * degree;
      return std::cos(tilt) * tangent + std::sin(tilt) * Vector3d::UnitZ() + dice.vector(0.2);
    }
    case Axes::radial:
      return radius + dice.vector(0.05);
    case Axes::tangential:
      return tangent + dice.vector(0.05);
    case Axes::random:
      break;
  }
  return dice.direction();
}

LegPlace placeLeg(Dice& dice, const Recipe& recipe, const Rings& rings, int i) {
  const int slot = i * leg_count / static_cast<int>(recipe.legs.size());  // fewer legs leave some empty
  const double side = slot % 2 == 0 ? -1 : 1;
  const int pair = slot / 2;
  const double middle = rings.turn + 2 * pi / 3 * pair;
  LegPlace place;
  double angle = middle + side * rings.base_half;
  if (recipe.arrangement == Arrangement::anywhere) {
    const Vector3d around = dice.vector(1.2);
    angle = std::atan2(around.y(), around.x());
    place.A = {around.x(), around.y(), 0.4 * around.z()};
    place.B = Vector3d(0, 0, rings.height) + dice.vector(0.8);
  } else {
    place.A = onRing(rings.base, angle) + dice.vector(rings.scatter);
    place.B = onRing(rings.platform, middle + side * rings.platform_half) + Vector3d(0, 0, rings.height) +
              dice.vector(rings.scatter);
  }
  place.axis = randomAxis(dice, recipe.axes, angle, side).normalized();
  place.axis *= dice.uniform(0.5, 2);
  place.knee = dice.chance(0.5) ? Knee::positive : Knee::negative;
  return place;
}

/// Returns an axis along z, exactly or up to a hundredth off.
Vector3d axisAlongZ(Dice& dice) {
  Vector3d axis(0, 0, dice.spreadOfEitherSign(0.5, 2));
  if (dice.chance(0.5)) return axis;
  const double beside = dice.spread(1e-8, 1e-2);
  axis.head<2>() = dice.vector(beside).head<2>();
  return axis;
}

}  // namespace

Layout randomLayout(Dice& dice, const Recipe& recipe) {
  const Rings rings = randomRings(dice, recipe.arrangement);
  const int count = static_cast<int>(recipe.legs.size());
  Layout layout;
  for (int i = 0; i < count; ++i) layout.push_back(placeLeg(dice, recipe, rings, i));
  if (recipe.axis_along_z) layout[static_cast<std::size_t>(dice.whole(0, count - 1))].axis = axisAlongZ(dice);
  drawLinks(dice, recipe, layout);
  return layout;
}

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

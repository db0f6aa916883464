#include <algorithm>
#include <cmath>
#include <utility>

#include "base/scalar.h"
#include "model/legs/leg_type.h"
#include "parts/random/random_parts.h"

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

void placeLeg(Dice& dice, const RandomRecipe& recipe, const Rings& rings, int i, Leg& leg) {
  const int slot = i * leg_count / static_cast<int>(recipe.legs.size());  // fewer legs leave some empty
  const double side = slot % 2 == 0 ? -1 : 1;
  const int pair = slot / 2;
  const double middle = rings.turn + 2 * pi / 3 * pair;
  double angle = middle + side * rings.base_half;
  if (recipe.arrangement == Arrangement::anywhere) {
    const Vector3d around = dice.vector(1.2);
    angle = std::atan2(around.y(), around.x());
    leg.base_point = {around.x(), around.y(), 0.4 * around.z()};
    leg.platform_point = Vector3d(0, 0, rings.height) + dice.vector(0.8);
  } else {
    leg.base_point = onRing(rings.base, angle) + dice.vector(rings.scatter);
    leg.platform_point = onRing(rings.platform, middle + side * rings.platform_half) + Vector3d(0, 0, rings.height) +
                         dice.vector(rings.scatter);
  }
  leg.base_axis = randomAxis(dice, recipe.axes, angle, side).normalized();
  leg.base_axis *= dice.uniform(0.5, 2);
  leg.knee = dice.chance(0.5) ? Knee::positive : Knee::negative;
}

/// Returns an axis along z, exactly or up to a hundredth off.
Vector3d axisAlongZ(Dice& dice) {
  Vector3d axis(0, 0, dice.spreadOfEitherSign(0.5, 2));
  if (dice.chance(0.5)) return axis;
  const double beside = dice.spread(1e-8, 1e-2);
  axis.head<2>() = dice.vector(beside).head<2>();
  return axis;
}

LegSpan spanOf(const Leg& leg) {
  const Vector3d AB = leg.platform_point - leg.base_point;
  const double along = AB.dot(leg.base_axis.normalized());
  return {AB.norm(), along, std::sqrt(std::max(0.0, AB.squaredNorm() - along * along))};
}

void give(const LinkLengths& links, Leg& leg) {
  leg.proximal.length = links.l;
  leg.distal.length = links.s;
}

/// Makes a leg nearly stretched, folded or perpendicular to its rail; UPS has no such pose.
void closeNearly(Dice& dice, Leg& leg) {
  const double bent = dice.uniform(3, 12) * degree;
  const LegType& type = typeOf(leg.kind);
  if (!type.folds()) {
    if (const auto links = type.lengthsAtDeadCentre(spanOf(leg), bent)) give(*links, leg);
    return;
  }
  // A folded leg needs links of different lengths, otherwise B would be at A.
  const bool folded = dice.chance(0.3);
  const double gamma = folded ? bent : pi - bent, ratio = folded ? dice.uniform(2, 3) : dice.spread(0.6, 1.6);
  give(type.lengths(spanOf(leg), gamma, ratio), leg);
}

/// Changes one or two legs of those kinds, from a random one on.
template <class F>
void someOf(Dice& dice, bool (LegKindRow::*is)() const, std::vector<Leg>& legs, const F& change) {
  const int count = static_cast<int>(legs.size());
  const int first = dice.whole(0, count - 1);
  int left = dice.whole(1, 2);
  for (int k = 0; k < count && left > 0; ++k) {
    Leg& leg = legs[(first + k) % count];
    if (!(rowOf(leg.kind).*is)()) continue;
    change(leg);
    --left;
  }
}

void nearStrokeEnd(Dice& dice, Leg& leg) {
  const double beside = dice.spread(0.003, 0.05);
  const double share = dice.chance(0.5) ? beside : 1 - beside;
  give(lengthsAtStroke(spanOf(leg).distance, share, leg.proximal.length / leg.distal.length), leg);
}

/// Draws the links of placed legs.
void drawLinks(Dice& dice, const RandomRecipe& recipe, std::vector<Leg>& legs) {
  const double unequal = recipe.unequal_links ? 5 : 1.5;
  const int count = static_cast<int>(legs.size());
  for (Leg& leg : legs) {
    const double gamma = dice.uniform(20, 160) * degree;
    give(typeOf(leg.kind).lengths(spanOf(leg), gamma, dice.spread(1 / unequal, unequal)), leg);
  }
  if (recipe.stroke_end) someOf(dice, &LegKindRow::isTelescopic, legs, [&](Leg& leg) { nearStrokeEnd(dice, leg); });
  if (recipe.far_zero)
    someOf(dice, &LegKindRow::hasCarriage, legs,
           [&](Leg& leg) { leg.base_point += dice.spreadOfEitherSign(1, 30) * leg.base_axis.normalized(); });
  if (!recipe.near_singular || dice.chance(0.4)) return;
  const int first = dice.whole(0, count - 1), some = dice.whole(1, 2);
  for (int k = 0; k < some; ++k) closeNearly(dice, legs[(first + k) % count]);
}

/// Returns legs that reach their platform points, with lengths in the machine's own and points relative to the middle
/// of the base; z points from the base to the platform. Base and platform are drawn first, then links that close the
/// loops. The triangle A R B of URS, or of RUS in the view along the axis, has a knee angle of 20° to 160°. The rod of
/// PUS is at 20° to 70° to its rail; UPS is within the middle 70 % of its stroke. One or two legs exceed this on
/// machines near a singularity or near a stroke's end.
std::vector<Leg> randomLayout(Dice& dice, const RandomRecipe& recipe) {
  const Rings rings = randomRings(dice, recipe.arrangement);
  std::vector<Leg> legs = recipe.legs;
  const int count = static_cast<int>(legs.size());
  for (int i = 0; i < count; ++i) placeLeg(dice, recipe, rings, i, legs[i]);
  if (recipe.axis_along_z) legs[dice.whole(0, count - 1)].base_axis = axisAlongZ(dice);
  drawLinks(dice, recipe, legs);
  return legs;
}

/// A helix with its middle at `position`; the platform takes the triad there. About a distant origin it hardly turns
/// while it covers a share of the machine.
void drawHelix(Dice& dice, const RandomRecipe& recipe, Design& design) {
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

/// Places a layout randomly in B, and M randomly on the platform.
void placeLegs(Dice& dice, const RandomRecipe& recipe, std::vector<Leg> legs, Design& design) {
  const Eigen::Quaterniond turn = dice.turn(recipe.turned ? pi : 0.1);
  const Vector3d origin = recipe.offset * dice.direction();
  const auto inBase = [&](const Vector3d& v) { return Vector3d(origin + turn * (recipe.length * v)); };
  Vector3d middle = Vector3d::Zero();
  for (const Leg& leg : legs) middle += inBase(leg.platform_point) / static_cast<double>(legs.size());
  design.position = middle + recipe.platform_offset * dice.direction();
  if (recipe.motion == MotionKind::helix) {
    drawHelix(dice, recipe, design);
    design.orientation = helixTriad(design.helix);
  } else {
    design.orientation = dice.turn(dice.chance(0.7) ? 0.5 : pi);
  }
  const Eigen::Quaterniond inverse = design.orientation.conjugate();
  design.middle = inverse * (middle - design.position);
  for (Leg& leg : legs) {
    leg.base_point = inBase(leg.base_point);
    leg.platform_point = inverse * (inBase(leg.platform_point) - design.position);
    if (!recipe.axis_along_z) leg.base_axis = turn * leg.base_axis;
    leg.proximal.length *= recipe.length;
    leg.distal.length *= recipe.length;
  }
  design.machine.legs = std::move(legs);
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

Design randomDesign(Dice& dice, const RandomRecipe& recipe) {
  Design design;
  placeLegs(dice, recipe, randomLayout(dice, recipe), design);
  design.machine.gravity = recipe.acceleration * gravityDirection(dice, recipe.gravity);  // exactly zero for none
  drawBodies(dice, recipe, design.middle, design.machine);
  return design;
}

}  // namespace ursula

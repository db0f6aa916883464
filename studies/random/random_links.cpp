// Links that join base and platform, for each kind of leg.

#include <cmath>

#include "base/angles.h"
#include "model/legs/leg_type.h"
#include "studies/random/random_parts.h"

namespace ursula {
namespace {

LegSpan spanOf(const LegPlace& place) {
  const Vector3d AB = place.B - place.A;
  const double along = AB.dot(place.axis.normalized());
  return {AB.norm(), along, std::sqrt(std::max(0.0, AB.squaredNorm() - along * along))};
}

void give(const LinkLengths& links, LegPlace& place) {
  place.l = links.l;
  place.s = links.s;
}

/// Makes a leg nearly stretched, folded or perpendicular to its rail; UPS has no such pose.
void closeNearly(Dice& dice, LegKind kind, LegPlace& place) {
  const double bent = dice.uniform(3, 12) * degree;
  const LegType& type = typeOf(kind);
  if (!type.folds()) {
    if (const auto links = type.lengthsAtDeadCentre(spanOf(place), bent)) give(*links, place);
    return;
  }
  // A folded leg needs links of different lengths, otherwise B would be at A.
  const bool folded = dice.chance(0.3);
  const double gamma = folded ? bent : pi - bent, ratio = folded ? dice.uniform(2, 3) : dice.spread(0.6, 1.6);
  give(type.lengths(spanOf(place), gamma, ratio), place);
}

/// Changes one or two legs of those kinds, from a random one on.
template <class F>
void someOf(Dice& dice, const Recipe& recipe, bool (LegKindRow::*is)() const, Layout& layout, const F& change) {
  const int count = static_cast<int>(layout.size());
  const int first = dice.whole(0, count - 1);
  int left = dice.whole(1, 2);
  for (int k = 0; k < count && left > 0; ++k) {
    const auto i = static_cast<std::size_t>((first + k) % count);
    if (!(rowOf(recipe.legs[i].kind).*is)()) continue;
    change(layout[i]);
    --left;
  }
}

void nearStrokeEnd(Dice& dice, LegPlace& place) {
  const double beside = dice.spread(0.003, 0.05);
  const double share = dice.chance(0.5) ? beside : 1 - beside;
  give(lengthsAtStroke(spanOf(place).distance, share, place.l / place.s), place);
}

}  // namespace

void drawLinks(Dice& dice, const Recipe& recipe, Layout& layout) {
  const double unequal = recipe.unequal_links ? 5 : 1.5;
  const int count = static_cast<int>(layout.size());
  for (std::size_t i = 0; i < layout.size(); ++i) {
    const double gamma = dice.uniform(20, 160) * degree;
    give(typeOf(recipe.legs[i].kind).lengths(spanOf(layout[i]), gamma, dice.spread(1 / unequal, unequal)), layout[i]);
  }
  if (recipe.stroke_end)
    someOf(dice, recipe, &LegKindRow::isTelescopic, layout, [&](LegPlace& place) { nearStrokeEnd(dice, place); });
  if (recipe.far_zero)
    someOf(dice, recipe, &LegKindRow::hasCarriage, layout,
           [&](LegPlace& place) { place.A += dice.spreadOfEitherSign(1, 30) * place.axis.normalized(); });
  if (!recipe.near_singular || dice.chance(0.4)) return;
  const int first = dice.whole(0, count - 1), some = dice.whole(1, 2);
  for (int k = 0; k < some; ++k) {
    const auto i = static_cast<std::size_t>((first + k) % count);
    closeNearly(dice, recipe.legs[i].kind, layout[i]);
  }
}

}  // namespace ursula

// Links that join base and platform, for each kind of leg.

#include <cmath>

#include "studies/random/random_layout.h"

namespace ursula {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double degree = pi / 180;

/// What the kinds of legs close, from an angle that is between 20° and 160° where nothing is near.
struct Span {
  double distance, along, across;  ///< from A to B: all of it, along the leg's axis, across it
};

Span spanOf(const LegPlace& place) {
  const Vector3d AB = place.B - place.A;
  const double along = AB.dot(place.axis.normalized());
  return {AB.norm(), along, std::sqrt(std::max(0.0, AB.squaredNorm() - along * along))};
}

/// Far side of a triangle with angle gamma between sides ratio and 1, over which `side` is to be.
double unitOf(double side, double gamma, double ratio) {
  return side / std::sqrt(ratio * ratio + 1 - 2 * ratio * std::cos(gamma));
}

/// |AB|² = l² + s² − 2 l s cos γ, γ the angle at the knee.
void closeTriangle(double gamma, double ratio, LegPlace& place) {
  place.s = unitOf((place.B - place.A).norm(), gamma, ratio);
  place.l = ratio * place.s;
}

/// The same across the axis, where the rod is as long as what it has along the axis leaves.
void closeCrank(double gamma, double ratio, LegPlace& place) {
  const Span span = spanOf(place);
  const double c = unitOf(span.across, gamma, ratio);
  place.l = ratio * c;
  place.s = std::hypot(c, span.along);
}

/// d = s + f l, f the share of the stroke that is used.
void closeStroke(double f, double ratio, LegPlace& place) {
  place.s = spanOf(place).distance / (1 + f * ratio);
  place.l = ratio * place.s;
}

/// s sin θ is what B is off the rail; the carriage's length is for drawing only.
void closeRod(double theta, double ratio, LegPlace& place) {
  place.s = spanOf(place).across / std::sin(theta);
  place.l = 0.3 * ratio * place.s;
}

/// An ordinary leg; `gamma` between 20° and 160°.
void close(LegKind kind, double gamma, double ratio, LegPlace& place) {
  switch (kind) {
    case LegKind::URS:
      return closeTriangle(gamma, ratio, place);
    case LegKind::UPS:
      return closeStroke(0.15 + 0.7 * (gamma / degree - 20) / 140, ratio, place);
    case LegKind::RUS:
      return closeCrank(gamma, ratio, place);
    case LegKind::PUS:
      return closeRod(20 * degree + (gamma - 20 * degree) * 50 / 140, ratio, place);
  }
}

/// A leg nearly stretched, folded or across its rail; of UPS nothing is.
void closeNearly(Dice& dice, LegKind kind, LegPlace& place) {
  const double bent = dice.uniform(3, 12) * degree;
  if (kind == LegKind::PUS) return closeRod(pi / 2 - bent, 1, place);
  if (kind == LegKind::UPS) return;
  // A folded leg has links of different lengths, else B would be at A.
  const bool folded = dice.chance(0.3);
  const double gamma = folded ? bent : pi - bent, ratio = folded ? dice.uniform(2, 3) : dice.spread(0.6, 1.6);
  kind == LegKind::RUS ? closeCrank(gamma, ratio, place) : closeTriangle(gamma, ratio, place);
}

/// One leg or two of the kind, from any on.
template <class F>
void someOf(Dice& dice, const Recipe& recipe, LegKind kind, Layout& layout, const F& change) {
  const int count = static_cast<int>(layout.size());
  const int first = dice.whole(0, count - 1);
  int left = dice.whole(1, 2);
  for (int k = 0; k < count && left > 0; ++k) {
    const auto i = static_cast<std::size_t>((first + k) % count);
    if (recipe.legs[i].kind != kind) continue;
    change(layout[i]);
    --left;
  }
}

void nearStrokeEnd(Dice& dice, LegPlace& place) {
  const double beside = dice.spread(0.003, 0.05);
  closeStroke(dice.chance(0.5) ? beside : 1 - beside, place.l / place.s, place);
}

}  // namespace

void drawLinks(Dice& dice, const Recipe& recipe, Layout& layout) {
  const double unequal = recipe.unequal_links ? 5 : 1.5;
  const int count = static_cast<int>(layout.size());
  for (std::size_t i = 0; i < layout.size(); ++i) {
    const double gamma = dice.uniform(20, 160) * degree;
    close(recipe.legs[i].kind, gamma, dice.spread(1 / unequal, unequal), layout[i]);
  }
  if (recipe.stroke_end)
    someOf(dice, recipe, LegKind::UPS, layout, [&](LegPlace& place) { nearStrokeEnd(dice, place); });
  if (recipe.far_zero)
    someOf(dice, recipe, LegKind::PUS, layout,
           [&](LegPlace& place) { place.A += dice.spreadOfEitherSign(1, 30) * place.axis.normalized(); });
  if (!recipe.near_singular || dice.chance(0.4)) return;
  const int first = dice.whole(0, count - 1), some = dice.whole(1, 2);
  for (int k = 0; k < some; ++k) {
    const auto i = static_cast<std::size_t>((first + k) % count);
    closeNearly(dice, recipe.legs[i].kind, layout[i]);
  }
}

}  // namespace ursula

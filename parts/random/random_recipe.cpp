#include "parts/random/random_recipe.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>

#include "base/scalar.h"

namespace ursula {
namespace {

/// The number of motors per leg: one each, and the rest on random legs.
std::vector<int> randomMotorCounts(Dice& dice, RandomKind kind) {
  if (kind != RandomKind::mixture && kind != RandomKind::two_motors) return std::vector<int>(leg_count, 1);
  const bool few = kind == RandomKind::two_motors;
  const int legs = few ? (dice.chance(0.6) ? 3 : dice.whole(3, 5)) : dice.whole(4, 6);
  std::vector<int> counts(legs, 1);
  const bool even = few && legs == 3 && dice.chance(0.7);
  if (even) return {2, 2, 2};
  for (int left = motor_count - legs; left > 0;) {
    int& count = counts[dice.whole(0, legs - 1)];
    if (count == 3) continue;
    ++count;
    --left;
  }
  return counts;
}

/// The default driven coordinate of the leg's kind, then random others.
std::array<bool, 3> randomMotors(Dice& dice, LegKind kind, int count, bool other_motors) {
  std::array<bool, 3> driven = {false, false, false};
  if (!other_motors) {
    driven[rowOf(kind).actuated] = true;
    --count;
  }
  while (count > 0) {
    bool& one = driven[dice.whole(0, 2)];
    if (one) continue;
    one = true;
    --count;
  }
  return driven;
}

LegKind randomLegKind(Dice& dice, RandomKind kind) {
  const bool of_one_kind = kind < RandomKind::mixture;  // these come first, in the order of LegKind
  return of_one_kind ? static_cast<LegKind>(kind) : dice.pick<LegKind>(static_cast<int>(leg_kind_count));
}

std::string wordsOf(const Leg& leg) {
  std::string words = rowOf(leg.kind).name;
  for (std::size_t j = 0; j < 3; ++j)
    if (leg.actuated[j]) words += fmt::format(" {}", nameOf(rowOf(leg.kind).coordinates[j]));
  return words;
}

/// Returns three to six legs with six motors; for URS it draws no random number. With `other_motors`, motors may drive
/// any coordinate.
std::vector<Leg> randomLegs(Dice& dice, RandomKind kind, bool other_motors) {
  if (kind == RandomKind::URS) return std::vector<Leg>(leg_count);
  std::vector<Leg> legs;
  const bool alike = kind == RandomKind::two_motors && dice.chance(0.5);
  for (const int motors : randomMotorCounts(dice, kind)) {
    const LegKind of = alike && !legs.empty() ? legs.front().kind : randomLegKind(dice, kind);
    legs.emplace_back();
    legs.back().kind = of;
    legs.back().actuated = randomMotors(dice, of, motors, other_motors);
  }
  return legs;
}

/// "UPS d", or one such text per leg.
std::string wordsOf(const std::vector<Leg>& legs) {
  std::vector<std::string> words;
  for (const Leg& leg : legs) words.push_back(wordsOf(leg));
  if (std::all_of(words.begin(), words.end(), [&](const std::string& each) { return each == words.front(); }))
    return fmt::format("{} legs {}", words.size(), words.front());
  return fmt::format("legs {}", fmt::join(words, ", "));
}

/// Draws whether an unusual property occurs, and notes it.
class Oddities {
 public:
  Oddities(Dice& dice, RandomRecipe& recipe) : dice_(dice), recipe_(recipe) {}
  bool happens(double probability, const char* words) {
    const bool odd = dice_.chance(probability);
    if (odd) recipe_.unusual.emplace_back(words);
    return odd;
  }

 private:
  Dice& dice_;
  RandomRecipe& recipe_;
};

/// Masses grow with the volume as for the paper's machine, 10 kg at 1.4 m, or are independent of it.
void drawUnits(Dice& dice, Oddities& odd, RandomRecipe& recipe) {
  recipe.length = dice.spread(0.4, 4);
  if (odd.happens(0.2, "size")) recipe.length = dice.spread(2e-3, 300);
  const double volume = std::pow(recipe.length, 3);
  recipe.mass = odd.happens(0.15, "masses of another size") ? dice.spread(1e-3, 1e3) : dice.spread(1, 15) * volume;
  recipe.acceleration = dice.uniform(9.78, 9.83);
  if (odd.happens(0.15, "gravity's size")) recipe.acceleration = dice.spread(1.6, 274);
}

void drawGeometry(Dice& dice, Oddities& odd, RandomRecipe& recipe) {
  if (dice.chance(0.6)) {
    recipe.arrangement = dice.pick<Arrangement>(5);
    recipe.axes = dice.pick<Axes>(4);
  }
  recipe.unequal_links = odd.happens(0.1, "unequal links");
  recipe.axis_along_z = odd.happens(0.05, "an axis along z");
  recipe.turned = !recipe.axis_along_z && odd.happens(0.15, "turned");
  recipe.offset = dice.uniform(0, 1) * recipe.length;
  // Beyond a million lengths, doubles cannot resolve the joints' positions.
  if (odd.happens(0.12, "far from the origin"))
    recipe.offset = dice.spread(10 * recipe.length, std::min(1e6 * recipe.length, 1e5));
  recipe.platform_offset = dice.uniform(0, 0.4) * recipe.length;
  if (odd.happens(0.12, "P off the platform")) recipe.platform_offset = dice.spread(1, 30) * recipe.length;
}

/// Properties that only other kinds of legs than URS can have.
void drawLegs(Dice& dice, Oddities& odd, RandomRecipe& recipe) {
  const RandomKind kind = recipe.kind;
  const bool of_any = kind == RandomKind::mixture || kind == RandomKind::two_motors;
  const bool other_motors = kind != RandomKind::URS && odd.happens(of_any ? 0.4 : 0.15, "other motors");
  recipe.legs = randomLegs(dice, kind, other_motors);
  const auto some = [&](bool (LegKindRow::*is)() const) {
    return std::any_of(recipe.legs.begin(), recipe.legs.end(),
                       [is](const Leg& leg) { return (rowOf(leg.kind).*is)(); });
  };
  recipe.stroke_end = some(&LegKindRow::isTelescopic) && odd.happens(0.15, "near a stroke's end");
  recipe.far_zero = some(&LegKindRow::hasCarriage) && odd.happens(0.15, "carriage far from its zero");
}

void drawBodies(Dice& dice, Oddities& odd, RandomRecipe& recipe) {
  if (odd.happens(0.15, "links' masses unlike the platform's")) recipe.masses = Masses::apart;
  if (odd.happens(0.1, "masses mixed")) recipe.masses = Masses::mixed;
  recipe.centres_anywhere = odd.happens(0.15, "mass centres outside of links");
  recipe.platform_centre = dice.uniform(0, 1) * recipe.length;
  if (odd.happens(0.1, "platform's mass centre away")) recipe.platform_centre = dice.spread(1, 10) * recipe.length;
  if (odd.happens(0.15, "inertias")) recipe.inertias = static_cast<Inertias>(dice.whole(1, 4));
  recipe.viscous = dice.chance(0.5);
  recipe.coulomb = dice.chance(0.25);
}

void drawSurroundings(Dice& dice, Oddities& odd, RandomRecipe& recipe) {
  if (odd.happens(0.15, "gravity's direction")) recipe.gravity = dice.pick<GravityKind>(4);
  if (dice.chance(0.2)) recipe.load = LoadKind::constant;
  if (dice.chance(0.15)) recipe.load = LoadKind::table;
  if (odd.happens(0.08, "load jumps")) recipe.load = LoadKind::jumps;
  recipe.load_far = recipe.load != LoadKind::none && odd.happens(0.2, "load far off");
}

void drawMotion(Dice& dice, Oddities& odd, RandomRecipe& recipe) {
  const double kind = dice.uniform(0, 1);
  recipe.motion = kind < 0.3    ? MotionKind::helix
                  : kind < 0.42 ? MotionKind::hold
                  : kind < 0.75 ? MotionKind::waypoints
                                : MotionKind::samples;
  if (recipe.motion == MotionKind::waypoints && odd.happens(0.15, "tight waypoints")) recipe.pace = Pace::tight;
  if (recipe.motion == MotionKind::waypoints && odd.happens(0.15, "abrupt waypoints")) recipe.pace = Pace::abrupt;
  if (recipe.motion == MotionKind::samples && odd.happens(0.15, "many samples")) recipe.pace = Pace::tight;
  recipe.noisy = recipe.motion == MotionKind::samples && odd.happens(0.3, "noisy samples");
  recipe.near_singular = odd.happens(0.08, "near a singularity");
  double units = dice.spread(1, 8);
  if (odd.happens(0.08, "short")) units = dice.spread(0.02, 1);
  if (odd.happens(0.06, "long")) units = dice.spread(8, 60);
  recipe.duration = units * recipe.time();
}

}  // namespace

std::string RandomRecipe::text() const {
  static constexpr const char* arrangements[] = {"the paper's layout", "a ring", "3-3", "6-3", "no order"};
  static constexpr const char* directions[] = {"tilted", "radial", "tangential", "random"};
  const std::string odd = unusual.empty() ? "nothing unusual" : fmt::format("{}", fmt::join(unusual, ", "));
  const std::string stands_on = kind == RandomKind::URS ? "" : wordsOf(legs) + ", ";
  return stands_on + fmt::format("L {:.3g} m, m {:.3g} kg, a {:.3g} m/s^2, {:.3g} T, {}, {} axes; {}", length, mass,
                                 acceleration, duration / time(), arrangements[static_cast<int>(arrangement)],
                                 directions[static_cast<int>(axes)], odd);
}

double RandomRecipe::largestKappa() const {
  // P far from the platform's points increases the condition of B by as many lengths.
  return near_singular || platform_offset > length ? 1e6 : 1e4;
}

RandomRecipe randomRecipe(Dice& dice, RandomKind kind) {
  RandomRecipe recipe;
  recipe.kind = kind;
  Oddities odd(dice, recipe);
  drawUnits(dice, odd, recipe);
  drawLegs(dice, odd, recipe);
  drawGeometry(dice, odd, recipe);
  drawBodies(dice, odd, recipe);
  drawSurroundings(dice, odd, recipe);
  drawMotion(dice, odd, recipe);
  return recipe;
}

}  // namespace ursula

#include "studies/random/random_kind.h"

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
  std::vector<int> counts(static_cast<std::size_t>(legs), 1);
  const bool even = few && legs == 3 && dice.chance(0.7);
  if (even) return {2, 2, 2};
  for (int left = motor_count - legs; left > 0;) {
    int& count = counts[static_cast<std::size_t>(dice.whole(0, legs - 1))];
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
    bool& one = driven[static_cast<std::size_t>(dice.whole(0, 2))];
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

std::string wordsOf(const LegRecipe& leg) {
  std::string words = rowOf(leg.kind).name;
  for (std::size_t j = 0; j < 3; ++j)
    if (leg.actuated[j]) words += fmt::format(" {}", nameOf(rowOf(leg.kind).coordinates[j]));
  return words;
}

}  // namespace

std::vector<LegRecipe> randomLegs(Dice& dice, RandomKind kind, bool other_motors) {
  std::vector<LegRecipe> legs;
  if (kind == RandomKind::URS) return std::vector<LegRecipe>(leg_count);
  const bool alike = kind == RandomKind::two_motors && dice.chance(0.5);
  for (const int motors : randomMotorCounts(dice, kind)) {
    const LegKind of = alike && !legs.empty() ? legs.front().kind : randomLegKind(dice, kind);
    legs.push_back({of, randomMotors(dice, of, motors, other_motors)});
  }
  return legs;
}

std::string wordsOf(const std::vector<LegRecipe>& legs) {
  std::vector<std::string> words;
  for (const LegRecipe& leg : legs) words.push_back(wordsOf(leg));
  if (std::all_of(words.begin(), words.end(), [&](const std::string& each) { return each == words.front(); }))
    return fmt::format("{} legs {}", words.size(), words.front());
  return fmt::format("legs {}", fmt::join(words, ", "));
}

}  // namespace ursula

#pragma once

#include <array>
#include <string>
#include <vector>

#include "model/leg_kind.h"
#include "studies/random/dice.h"

namespace ursula {

/// What a random machine stands on: six legs of one kind; four to six legs of any kinds; three to five legs of which
/// some have two motors or three. All but URS may drive any of a leg's coordinates.
enum class RandomKind { URS, UPS, RUS, PUS, mixture, two_motors };
inline constexpr std::array<const char*, 6> random_kind_names = {"URS", "UPS", "RUS", "PUS", "mixture", "two-motors"};

constexpr const char* nameOf(RandomKind kind) { return random_kind_names[static_cast<std::size_t>(kind)]; }

/// What a leg is to be, before any of its numbers.
struct LegRecipe {
  LegKind kind = LegKind::URS;
  std::array<bool, 3> actuated = {true, false, false};
};

/// Three to six legs with six motors; URS throws no dice. `other_motors` drives any coordinates.
std::vector<LegRecipe> randomLegs(Dice& dice, RandomKind kind, bool other_motors);

/// "UPS d", or one of these for each leg.
std::string wordsOf(const std::vector<LegRecipe>& legs);

}  // namespace ursula

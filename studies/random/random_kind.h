#pragma once

#include <array>
#include <string>
#include <vector>

#include "model/leg_kind.h"
#include "studies/random/dice.h"

namespace ursula {

/// The legs of a random machine: six of one kind; four to six of any kinds; three to five, some with two or three
/// motors. All kinds except URS may drive any of a leg's coordinates.
enum class RandomKind { URS, UPS, RUS, PUS, mixture, two_motors };
inline constexpr std::array<const char*, 6> random_kind_names = {"URS", "UPS", "RUS", "PUS", "mixture", "two-motors"};

constexpr const char* nameOf(RandomKind kind) { return random_kind_names[static_cast<std::size_t>(kind)]; }

/// The properties of a leg that precede its numbers.
struct LegRecipe {
  LegKind kind = LegKind::URS;
  std::array<bool, 3> actuated = {true, false, false};
};

/// Returns three to six legs with six motors; for URS it draws no random number. With `other_motors`, motors may drive
/// any coordinate.
std::vector<LegRecipe> randomLegs(Dice& dice, RandomKind kind, bool other_motors);

/// "UPS d", or one such text per leg.
std::string wordsOf(const std::vector<LegRecipe>& legs);

}  // namespace ursula

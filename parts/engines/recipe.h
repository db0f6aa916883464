#pragma once

namespace ursula {

/// A way to get the efforts of a closed loop from an engine. Only the first is right; the others are usual mistakes.
enum class Recipe {
  exact,             ///< tree dynamics with multipliers of the loop closures
  open,              ///< inverse dynamics of the trees without the loops
  no_bias,           ///< the exact recipe without J̇ u in the joints' accelerations
  least_squares,     ///< the smallest forces on all coordinates, read at the motors
  own_inverse,       ///< the engine's own answer with loops of default softness: inverse dynamics, or a driven step
  own_inverse_hard,  ///< the same with the hardest loops that it allows
};

/// Returns the enumerator's name, "own_inverse".
const char* name(Recipe recipe);

}  // namespace ursula

#pragma once

#include <string>
#include <utility>
#include <vector>

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

/// An engine's setting of the loops' rigidity, in its own names.
struct Rigidity {
  std::string name;  ///< "default"
  double step = 0;   ///< time for which efforts are held, s
  /// Efforts are held over a step at their values of this instant, a share of the step. It is chosen so that the steps
  /// follow a motion best.
  double instant = 0;
  std::vector<std::pair<std::string, double>> settings;  ///< {"solref_timeconst", 0.02}
};

}  // namespace ursula

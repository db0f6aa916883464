#include "parts/engines/loop_engine.h"

#include <array>
#include <stdexcept>

#include "parts/engines/closing.h"

namespace ursula {

const char* name(Recipe recipe) {
  constexpr std::array names = {"exact", "open", "no_bias", "least_squares", "own_inverse", "own_inverse_hard"};
  return names.at(static_cast<std::size_t>(recipe));
}

double largestGap(const PlacedTree& tree, const Manipulator& manipulator) {
  double out = 0;
  for (int i = 0; i < manipulator.legCount(); ++i) out = larger(out, tree.gaps[i].norm());
  return out;
}

double sag(const PlacedTree& tree, const Manipulator& manipulator) {
  const Vector6d moved = displacement(tree, tree.gaps, manipulator);
  double out = 0;
  for (int i = 0; i < manipulator.legCount(); ++i) out = larger(out, (tree.legs[i].P * moved).norm());
  return out;
}

Vector6d LoopEngine::efforts(Recipe recipe, const Motion<double>& motion) {
  switch (recipe) {
    case Recipe::exact:
      return closed(motion, Bias::kept);
    case Recipe::open:
      return openEfforts(tree(motion, Bias::kept), manipulator_);
    case Recipe::no_bias:
      return closed(motion, Bias::left_out);
    case Recipe::least_squares:
      return leastEfforts(tree(motion, Bias::kept), manipulator_);
    case Recipe::own_inverse:
    case Recipe::own_inverse_hard:
      break;
  }
  return ownInverse(motion, recipe == Recipe::own_inverse_hard);
}

Vector6d LoopEngine::closed(const Motion<double>& motion, Bias bias) {
  return closedEfforts(tree(motion, bias), manipulator_);
}

Vector6d LoopEngine::ownInverse(const Motion<double>&, bool) {
  throw std::logic_error("the engine has no inverse dynamics of closed loops");
}

std::unique_ptr<SteppedLoop> LoopEngine::stepped(const Rigidity&) const {
  throw std::logic_error("the engine moves nothing in time");
}

}  // namespace ursula

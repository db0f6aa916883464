// A solver as a process that asks MuJoCo, on the model that `ursula export --format mjcf` wrote:
//
//   ursula export scenario.toml --format mjcf --out machine.xml
//   ursula validate scenario.toml --solver 'mujoco_solver machine.xml [RECIPE]'
//
// RECIPE is exact, or one that is often taken instead and is wrong: inverse, tree, least_squares, no_bias,
// global_angular. A scenario's load is not in the file, nor the smoothing of its dry friction.

#include <cstdio>
#include <exception>
#include <stdexcept>

#include "examples/engines/closed_chain_internal.h"

int main(int argc, char** argv) try {
  if (argc < 2) throw std::runtime_error("usage: mujoco_solver MODEL.xml [RECIPE]");
  closed_chain::Machine machine(argv[1]);
  closed_chain::answerAll(machine, closed_chain::recipeOf(argc > 2 ? argv[2] : "exact"));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}

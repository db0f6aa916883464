// A solver as a process that asks MuJoCo, on the model that `ursula export --format mjcf` wrote:
//
//   ursula export scenario.toml --format mjcf --out machine.xml
//   ursula validate scenario.toml --solver 'mujoco_solver machine.xml [RECIPE]'
//
// RECIPE is exact, or one that is often taken instead and is wrong: inverse, tree, least_squares, no_bias,
// global_angular. A scenario's load is not in the file, nor the smoothing of its dry friction.

#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>

#include "examples/engines/closed_chain_internal.h"

namespace {

closed_chain::Recipe recipeOf(const std::string& name) {
  using closed_chain::Recipe;
  static const std::map<std::string, Recipe> recipes = {
      {"exact", Recipe::exact},     {"inverse", Recipe::inverse},
      {"tree", Recipe::tree},       {"least_squares", Recipe::least_squares},
      {"no_bias", Recipe::no_bias}, {"global_angular", Recipe::global_angular},
  };
  const auto found = recipes.find(name);
  if (found == recipes.end()) throw std::runtime_error("no recipe " + name);
  return found->second;
}

/// t, p, q, v, w, a, alpha, with commas between.
closed_chain::Motion motionOf(const std::string& line) {
  std::array<double, 20> value{};
  const char* at = line.c_str();
  for (double& each : value) {
    char* end = nullptr;
    each = std::strtod(at, &end);
    at = end + (*end == ',' ? 1 : 0);
  }
  const auto vector = [&value](std::size_t first) {
    return Eigen::Vector3d(value[first], value[first + 1], value[first + 2]);
  };
  const Eigen::Quaterniond q(value[4], value[5], value[6], value[7]);
  return {vector(1), vector(8), vector(11), vector(14), vector(17), q.normalized()};
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) throw std::runtime_error("usage: mujoco_solver MODEL.xml [RECIPE]");
  closed_chain::Machine machine(argv[1]);
  const closed_chain::Recipe recipe = recipeOf(argc > 2 ? argv[2] : "exact");
  for (std::string line; std::getline(std::cin, line);) {
    const Eigen::VectorXd tau = machine.efforts(motionOf(line), recipe);
    for (Eigen::Index k = 0; k < tau.size(); ++k) std::printf(k == 0 ? "%.17g" : ",%.17g", tau(k));
    std::printf("\n");
    std::fflush(stdout);
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}

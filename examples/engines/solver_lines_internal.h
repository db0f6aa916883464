#pragma once

// What the solver processes of all engines share: the question, the recipes, and the last step to the efforts,
//
//   Gᵀλ + Sτ = f                                                                (1)
//
// with f the forces of the trees' inverse dynamics, G the Jacobian of the loops' gaps, S the motors' columns.

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>

namespace closed_chain {

/// What is easily asked instead, and is wrong.
enum class Recipe {
  exact,
  inverse,         ///< MuJoCo's mj_inverse, read at the motors
  tree,            ///< inverse dynamics of the trees, their loops ignored
  least_squares,   ///< the smallest forces on all coordinates, motor or not, as a pseudoinverse gives
  no_bias,         ///< Ġq̇ left out of the accelerations of the joints
  global_angular,  ///< ω and α of the base's axes given to MuJoCo's free joint, which wants its own
};

/// The motion of the platform's frame, in the world's axes.
struct Motion {
  Eigen::Vector3d p, v, w, a, alpha;
  Eigen::Quaterniond q;
};

/// Throws std::runtime_error for a name that is no recipe.
inline Recipe recipeOf(const std::string& name) {
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
inline Motion motionOf(const std::string& line) {
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

struct Efforts {
  Eigen::VectorXd motors, multipliers;
};

/// Rows of (1) without a motor give λ, those with one give τ.
inline Efforts effortsOf(Recipe recipe, const Eigen::MatrixXd& G, const Eigen::MatrixXd& S, const Eigen::VectorXd& f) {
  if (recipe == Recipe::inverse || recipe == Recipe::tree) return {S.transpose() * f, {}};
  if (recipe == Recipe::least_squares)
    return {S.transpose() * (f - G.transpose() * (G * G.transpose()).ldlt().solve(G * f)), {}};
  Eigen::MatrixXd unknown(G.cols(), G.rows() + S.cols());
  if (unknown.rows() < unknown.cols())
    throw std::runtime_error("expected no more motors than the machine has freedoms");
  unknown << G.transpose(), S;
  const bool square = unknown.rows() == unknown.cols();
  // Free rods leave rows over, which hold by themselves.
  const Eigen::VectorXd found =
      square ? Eigen::VectorXd(unknown.partialPivLu().solve(f)) : unknown.colPivHouseholderQr().solve(f);
  if (!square && (unknown * found - f).norm() > 1e-9 * f.norm())
    throw std::runtime_error("expected as many motors as the machine has freedoms, but for rods that spin");
  return {found.tail(S.cols()), found.head(G.rows())};
}

/// Answers each line of standard input with a line of efforts.
template <class Machine>
void answerAll(Machine& machine, Recipe recipe) {
  for (std::string line; std::getline(std::cin, line);) {
    const Eigen::VectorXd tau = machine.efforts(motionOf(line), recipe);
    for (Eigen::Index k = 0; k < tau.size(); ++k) std::printf(k == 0 ? "%.17g" : ",%.17g", tau(k));
    std::printf("\n");
    std::fflush(stdout);
  }
}

}  // namespace closed_chain

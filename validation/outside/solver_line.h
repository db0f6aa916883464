#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include "model/motion.h"

namespace ursula {

/// The solver's process did not answer as it has to: with what it was asked and what came.
class SolverProcessError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a solver's process is asked for a motion, without the line's end: t, p, q, v, w, a, alpha as in the program's
/// files, in B, SI, q with w ≥ 0, 17 significant digits, commas between.
std::string solverQuestion(const Motion<double>& motion);

/// Six numbers with commas between, efforts in the order of the motors, N·m or N. Throws SolverProcessError that says
/// what is wrong with `line`.
Vector6d solverAnswer(const std::string& line);

/// Of an answer, in messages: bytes.
constexpr std::size_t most_shown = 600;

}  // namespace ursula

#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include "model/motion.h"

namespace ursula {

/// A wrong answer of the solver's process, with question and answer.
class SolverProcessError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The question for one motion without line end: t, p, q, v, w, a, alpha as in the program's files. They are in B, SI,
/// with w ≥ 0 in q, 17 significant digits, separated by commas.
std::string solverQuestion(const Motion<double>& motion);

/// Parses six comma-separated efforts in the order of the motors, N·m or N. Throws SolverProcessError with the defect
/// of `line`.
Vector6d solverAnswer(const std::string& line);

/// The largest part of an answer in messages, in bytes.
constexpr std::size_t most_shown = 600;

}  // namespace ursula

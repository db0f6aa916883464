#pragma once

#include <cstddef>
#include <string>

namespace ursula {

/// The origin of a subject's formulas: the paper's, the users' kernels, or another program.
enum class Formulation { noc, fast, external };
/// "noc", "fast" or "external".
inline const char* name(Formulation formulation) {
  constexpr const char* names[] = {"noc", "fast", "external"};
  return names[static_cast<std::size_t>(formulation)];
}

/// How a user calls a subject: nothing or a function in a program, or by the option of that name.
enum class CalledBy { program, torques, solver, simulator, trajectory };

/// The judged solver or file.
struct JudgedSubject {
  std::string name;  ///< "noc", a file's name, a solver's command, a function's name
  Formulation formulation = Formulation::external;
  CalledBy called_by = CalledBy::program;
  std::string map = {};      ///< columns that the user named, as TorqueFile has them
  std::string torques = {};  ///< of `--trajectory`: the file of its efforts; empty for the right ones
};

}  // namespace ursula

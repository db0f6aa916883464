#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "validation/verdict/result.h"

namespace ursula::report {

// The words of results of mechanisms: motors have names, and there are no legs.

/// Returns the motors' names in the order of efforts; empty for a manipulator, whose motors have numbers.
std::vector<std::string> motorNames(const ValidationResult& result);

/// Returns the motor's name, or its number from 1.
std::string motorName(const std::vector<std::string>& names, std::size_t motor);

struct MotorDeviation;

/// What the motor was given at its worst instant and what is expected, in one unit, with digits that tell them apart to
/// a tenth of their difference; "no number" for what is none.
std::pair<std::string, std::string> toldApart(const MotorDeviation& motor);

/// What a check is called and what it means for a machine of this kind ("manipulator", "mechanism"); as in the
/// catalogue but for words that only the other kind has.
struct CheckWords {
  std::string title, proves;
};
CheckWords checkWords(const std::string& check, const std::string& kind);

/// Returns "crank was given 3.06 N·m where 3.03 N·m is expected, 1 % of the largest torque too much, at t = 0.3 s" for
/// the motor that is most off, "motor 3 was …" of a manipulator; empty if no effort is wrong.
std::string worstMotor(const ValidationResult& result);

/// Returns "3 motors drive 13 bodies through 18 joints, 6 of which close loops · delta.xml · fourier, 2 s".
std::string mechanismLine(const MechanismPicture& picture);

}  // namespace ursula::report

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/mechanism_picture.h"
#include "report/page/picture.h"
#include "report/page/plots.h"
#include "validation/verdict/result.h"

namespace ursula::report {

/// Returns a verdict as a sign and a word, so that it does not depend on colour.
std::string verdictBadge(Verdict verdict);
/// The same with other words.
std::string badge(Verdict verdict, const std::string& words);

/// Returns the checks in groups; groups with checks that did not pass come first and are unfolded. Each check has a bar
/// of value over limit on a logarithmic scale. Folded below are its meaning, its result and the origin of its limit.
/// Needs no script. `kind` is that of the machine, whose words are used.
std::string checksList(const std::vector<Check>& checks, const std::string& kind = "manipulator");

/// Returns machine, load and motion as tables.
std::string inputCard(const Picture& picture);
/// The same of a mechanism; what was odd on reading its model comes first.
std::string inputCard(const MechanismPicture& picture);

/// Returns the machine and its motion in one line: "six U–R–S legs under a platform of 500 kg · helix of 3 s".
std::string machineLine(const Picture& picture);

/// Returns a table of the errors over time: maximum with its instant, root mean square, last value, and a histogram of
/// their decades. Empty if there are no errors.
std::string statisticsTable(const ValidationResult& result);

/// Deviation of one motor's efforts.
struct MotorDeviation {
  int motor = 0;                   ///< 0-based
  std::string unit = "Nm";         ///< unit of its efforts, as in columns
  double largest = 0, t = 0;       ///< largest deviation in that unit, and its instant, s
  double given = 0, expected = 0;  ///< there
  double share = 0;                ///< its share of the largest expected effort of that unit; 0 if there is none
  bool right = false;              ///< whether it is within the derived limit at every instant
  std::optional<double> factor;    ///< a factor that alone explains all but a hundredth of the deviation's norm
  std::optional<double> offset;    ///< an offset that does so, in that unit
};

/// Returns the motor that is most off, as a share of the largest effort; nullopt if all are within their limits.
std::optional<MotorDeviation> worstOf(const std::vector<MotorDeviation>& motors);

/// Returns the numbers from 0 of the motors to be marked as wrong: if all of several are, the worst alone, since a mark
/// on each would show nothing.
std::vector<int> markedOf(const std::vector<MotorDeviation>& motors);

/// Returns the deviation of every motor from the columns of the subject's and Simbody's efforts. Empty if no check says
/// that efforts are wrong, or if the columns are missing.
std::vector<MotorDeviation> motorsOff(const ValidationResult& result);

/// Returns the machine at the start of its motion, with its path and the legs' numbers, for readers without WebGL and
/// for paper. The legs in `wrong`, from 0, are marked.
std::string svgMachine(const Picture& picture, const std::vector<int>& wrong);
/// The same of a mechanism, with its motors' names; `wrong` are numbers of motors.
std::string svgMachine(const MechanismPicture& picture, const std::vector<int>& wrong);

/// "1.003", or "(1 + 10⁻⁶)" where few digits would hide the difference.
std::string factorText(double factor);

/// Returns a row for each motor: given and expected where they differ most, the difference, the instant, and the one
/// number that would correct it. Empty if motorsOff is.
std::string motorsTable(const ValidationResult& result);

}  // namespace ursula::report

#pragma once

#include <string>
#include <vector>

#include "model/scenario.h"

namespace ursula {

/// Returns `file:line:column: warning: key: …` for unusual but possible values, each with the suspicious number. A
/// value that all legs inherit gives one warning. If the motion is impossible (tryMotion), only the numbers are
/// checked.
std::vector<std::string> warnings(const Scenario& scenario);

/// A value that a machine or motion may have, but rarely has.
struct Oddity {
  std::string key;           ///< dotted, of the scenario: `manipulator.leg[2].proximal.mass`
  std::string what;          ///< the number, the usual value, and the probable intention
  std::string hint = {};     ///< "did you mean …?", if another unit makes it usual
  std::string subject = {};  ///< tells several oddities of one key apart: "stamp"
};

/// "did you mean mm? 1300 mm are 1.3 m", of a number that was read in metres.
std::string inMillimetres(double value);

std::vector<Oddity> oddMachine(const Scenario& scenario);
std::vector<Oddity> oddMotion(const Scenario& scenario);

}  // namespace ursula

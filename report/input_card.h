#pragma once

#include <string>

#include "report/picture.h"

namespace ursula::report {

/// Returns machine, load and motion as tables.
std::string inputCard(const Picture& picture);

/// Returns the machine and its motion in one line: "six U–R–S legs under a platform of 500 kg · helix of 3 s".
std::string machineLine(const Picture& picture);

}  // namespace ursula::report

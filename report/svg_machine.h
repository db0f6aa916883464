#pragma once

#include <string>

#include "report/picture.h"

namespace ursula::report {

/// Returns the machine at the start of its motion, with its path, for readers without WebGL and for paper.
std::string svgMachine(const Picture& picture);

}  // namespace ursula::report

#pragma once

#include <string>

#include "report/picture.h"

namespace ursula::report {

/// The machine at the start of its motion, with its path: a drawing for readers without WebGL, and for paper.
std::string svgMachine(const Picture& picture);

}  // namespace ursula::report

#pragma once

#include <string>

#include "report/picture.h"

namespace ursula::report {

/// Returns the machine's points and directions at the picture's instants as JSON, with the errors, efforts and
/// reactions of `series` there.
std::string machineJson(const Picture& picture, const TimeSeries& series);

}  // namespace ursula::report

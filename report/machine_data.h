#pragma once

#include <string>

#include "report/picture.h"

namespace ursula::report {

/// The machine's points and directions at the picture's instants as JSON, with errors, efforts and reactions that
/// `series` has there.
std::string machineJson(const Picture& picture, const TimeSeries& series);

}  // namespace ursula::report

#pragma once

#include <string>
#include <vector>

#include "validation/verdict/result.h"

namespace ursula::compare_parts {

/// Gives every quaternion of `series` (columns …q_w, …q_x, …q_y, …q_z) the sign nearer to its predecessor. q and −q are
/// the same rotation, and interpolation needs continuous signs.
void makeContinuous(TimeSeries& series);

/// Gives every quaternion of `rows` in `test` the sign nearer to the continuous reference's at that time.
void alignQuaternions(const TimeSeries& reference, const std::vector<std::size_t>& rows, TimeSeries& test);

/// Whether one of `patterns` matches the column; `*` matches anything. An empty list matches all.
bool isChosen(const std::string& column, const std::vector<std::string>& patterns);

}  // namespace ursula::compare_parts

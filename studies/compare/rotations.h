#pragma once

#include <string>
#include <vector>

#include "validation/verdict/result.h"

namespace ursula::compare_parts {

/// `series` with every quaternion (columns …q_w, …q_x, …q_y, …q_z) of the sign that is nearer to the one before, since
/// q and −q are the same rotation: then what lies between two of them can be interpolated.
TimeSeries alignQuaternions(const TimeSeries& series);

/// `test` with every quaternion of `rows` of the sign that is nearer to the reference's at that time.
TimeSeries alignQuaternions(const TimeSeries& reference, const TimeSeries& test, const std::vector<std::size_t>& rows);

/// Whether one of `patterns` names the column; `*` stands for anything. No pattern: every column.
bool isChosen(const std::string& column, const std::vector<std::string>& patterns);

}  // namespace ursula::compare_parts

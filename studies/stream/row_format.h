#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "validation/verdict/result.h"

namespace ursula {

/// How rows are written. `csv`: a header line, then numbers with 17 significant digits. `binary`: one line of JSON with
/// `columns`, `rows`, `dtype` ("<f8") and `offset` (how many bytes the line has, a multiple of 64), then the rows as
/// little-endian doubles, one after the other.
enum class RowFormat { csv, binary };

/// What stands before the rows.
std::string rowHeader(RowFormat format, const std::vector<std::string>& names, std::size_t rows);

/// Appends the rows of `series` to `out`.
void appendRows(RowFormat format, const TimeSeries& series, std::string& out);

}  // namespace ursula

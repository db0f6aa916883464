#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "validation/verdict/result.h"

namespace ursula {

/// Formats of rows. `csv` is a header line, then numbers with 17 significant digits. `binary` is one line of JSON with
/// `columns`, `rows`, `dtype` ("<f8") and `offset` (the length of the line in bytes, a multiple of 64), then the rows
/// as consecutive little-endian doubles.
enum class RowFormat { csv, binary };

/// Returns the text before the rows.
std::string rowHeader(RowFormat format, const std::vector<std::string>& names, std::size_t rows);

/// Appends the rows of `series` to `out`.
void appendRows(RowFormat format, const TimeSeries& series, std::string& out);

}  // namespace ursula

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/csv.h"

namespace ursula {

/// The header line: "t_s,p_x_m\n".
std::string csvHeader(const std::vector<std::string>& names);

/// Appends a text as a cell. It is quoted as in RFC 4180 if needed; terminal control characters are escaped.
void appendCsvCell(std::string_view text, std::string& out);

/// Appends a line for each row, as csvText writes it. All columns are equally long.
void appendCsvRows(const std::vector<std::vector<double>>& columns, std::string& out, NanAs nan = NanAs::word);

}  // namespace ursula

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/csv.h"

namespace ursula {

/// The header line: "t_s,p_x_m\n".
std::string csvHeader(const std::vector<std::string>& names);

/// Appends a text as a cell: quoted as RFC 4180 has it where it needs it; what a terminal would obey is escaped.
void appendCsvCell(std::string_view text, std::string& out);

/// Appends a line for each row of `columns`, all of them equally long, as csvText writes it.
void appendCsvRows(const std::vector<std::vector<double>>& columns, std::string& out, NanAs nan = NanAs::word);

}  // namespace ursula

#pragma once

#include <string>
#include <vector>

#include "model/csv.h"

namespace ursula {

/// The header line: "t_s,p_x_m\n".
std::string csvHeader(const std::vector<std::string>& names);

/// Appends a line for each row of `columns`, all of them equally long, as csvText writes it.
void appendCsvRows(const std::vector<std::vector<double>>& columns, std::string& out, NanAs nan = NanAs::word);

}  // namespace ursula

#pragma once

#include <functional>
#include <string_view>

#include "studies/sweep/sqlite.h"

namespace ursula {

/// Every point a row, by ascending id: `id`, `verdict`, a column for each varied number by its key, one for each result
/// by its name, for checks followed by NAME.limit and NAME.verdict, and `error`. 17 significant digits; what is not
/// there is an empty cell. Texts are quoted as RFC 4180 has it, where they need it. Times of computing stay out: the
/// same points give the same bytes. Throws DatabaseError.
void writeSweepCsv(Sqlite& database, const std::function<void(std::string_view)>& sink);

}  // namespace ursula

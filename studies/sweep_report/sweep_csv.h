#pragma once

#include <functional>
#include <string_view>

#include "studies/sweep/sqlite.h"

namespace ursula {

/// Writes a row per point by ascending id: `id`, `verdict`, a column per varied number by its key, and one per result
/// by its name. For checks NAME.limit and NAME.verdict follow; the last column is `error`. Numbers have 17 significant
/// digits; missing values are empty cells. Texts are quoted as in RFC 4180 if needed. Computing times are omitted, so
/// equal points give equal bytes. Throws DatabaseError.
void writeSweepCsv(Sqlite& database, const std::function<void(std::string_view)>& sink);

}  // namespace ursula

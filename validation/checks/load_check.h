#pragma once

#include <functional>
#include <vector>

#include "model/load.h"
#include "validation/checks/file_as_written.h"
#include "validation/verdict/result.h"

namespace ursula {

/// `motion.load`: the load as every formulation is given it, over time. `written` may be null: a tabulated load is then
/// held against what it says itself at its rows.
Check judgeLoad(const Load& load, double duration, const LoadAsWritten* written);

/// Its part for a table: `at` goes through the rows by the quintics that LoadHistory promises, and is constant beyond.
Check judgeLoadTable(const std::vector<TimedWrench>& rows, const std::function<Wrench<double>(double)>& at);

}  // namespace ursula

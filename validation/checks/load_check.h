#pragma once

#include <functional>
#include <vector>

#include "model/load.h"
#include "validation/verdict/result.h"

namespace ursula {

/// `motion.load`: the load as every formulation is given it, over time, against its rows or its force and moment.
Check judgeLoad(const Load& load, double duration);

/// Its part for a table: `at` goes through the rows by the quintics that LoadHistory promises, and is constant beyond.
Check judgeLoadTable(const std::vector<TimedWrench>& rows, const std::function<Wrench<double>(double)>& at);

}  // namespace ursula

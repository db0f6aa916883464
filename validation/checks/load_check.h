#pragma once

#include <functional>
#include <vector>

#include "model/load.h"
#include "validation/verdict/result.h"

namespace ursula {

/// `motion.load` compares the load that every formulation uses, over time, with its rows or with its force and moment.
Check judgeLoad(const Load& load, double duration);

/// The part for a table: `at` interpolates the rows by the quintics that LoadHistory promises, and is constant beyond.
Check judgeLoadTable(const std::vector<TimedWrench>& rows, const std::function<Wrench<double>(double)>& at);

}  // namespace ursula

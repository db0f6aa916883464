#pragma once

#include <string>
#include <vector>

#include "report/picture.h"
#include "report/plots.h"
#include "validation/verdict/result.h"

namespace ursula::report {

/// What the page's script draws, as JSON that can stand in a <script> block: charts, the machine along its motion,
/// events. Thinned for the eye; numbers with six digits.
/// `picture` may be null.
std::string pageData(const ValidationResult& result, const Picture* picture, const std::vector<Plot>& plots);

/// The same for a page of charts alone.
std::string chartData(const std::string& title, const std::vector<Plot>& plots);

}  // namespace ursula::report

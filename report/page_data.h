#pragma once

#include <string>
#include <vector>

#include "report/picture.h"
#include "report/plots.h"
#include "validation/verdict/result.h"

namespace ursula::report {

/// Returns the data of the page's script as JSON for a <script> block: charts, the machine along its motion, events. It
/// is thinned to visible detail; numbers have six digits. `picture` may be null.
std::string pageData(const ValidationResult& result, const Picture* picture, const std::vector<Plot>& plots);

/// The same for a page with charts only.
std::string chartData(const std::string& title, const std::vector<Plot>& plots);

}  // namespace ursula::report

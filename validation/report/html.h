#pragma once

#include <string>
#include <vector>

#include "validation/report/report.h"

namespace ursula::report {

/// `report.html`: one file that needs no network. Verdict and checks are plain HTML; only the charts need its script.
std::string reportHtml(const ValidationResult& result);

/// `index.html` of a suite; no script at all.
std::string indexHtml(const std::vector<SuiteEntry>& entries);

}  // namespace ursula::report

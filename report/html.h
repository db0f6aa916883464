#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace ursula::report {

/// `report.html`: one file that needs no network. Verdict, checks, drawings and tables are plain HTML; its script draws
/// the charts and animates the machine. In a suite it links to the index.
std::string reportHtml(const ValidationResult& result, Place place = Place::alone);

/// `index.html` of a suite; its script only sorts and filters.
std::string indexHtml(const std::vector<SuiteEntry>& entries);

}  // namespace ursula::report

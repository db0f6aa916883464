#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace ursula::report {

/// JUnit XML with a suite per scenario and a case per check. Undecided checks are `skipped`, which CI systems show and
/// do not count as passed; an entry's error text is an `error`. A verdict that no case explains (for instance without
/// checks) gets its own case, so no suite looks better than its verdict. Elements and attributes follow Jenkins'
/// junit-10.xsd.
std::string junitXml(const std::vector<SuiteEntry>& entries);

}  // namespace ursula::report

#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace ursula::report {

/// JUnit XML: a suite for each scenario, a case for each check. What cannot be judged is `skipped`, which CI systems
/// show and do not count as passed; an entry's error text is an `error`. A verdict that no case accounts for (no check
/// at all, say) gets a case of its own, so that no suite looks better than its verdict. Elements and
/// attributes are those of Jenkins' junit-10.xsd.
std::string junitXml(const std::vector<SuiteEntry>& entries);

}  // namespace ursula::report

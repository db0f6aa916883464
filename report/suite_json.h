#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace ursula::report {

/// As for checks: nothing validated is not a success.
Verdict suiteVerdict(const std::vector<SuiteEntry>& entries);

std::size_t countOf(const std::vector<SuiteEntry>& entries, Verdict verdict);

/// Wall time of all, one after the other, s.
double secondsOf(const std::vector<SuiteEntry>& entries);

/// `suite.json`: verdict, counts and wall times of all and of each scenario.
std::string suiteJson(const std::vector<SuiteEntry>& entries);

}  // namespace ursula::report

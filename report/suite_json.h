#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace ursula::report {

/// The verdict over all entries; as for checks, an empty suite is no success.
Verdict suiteVerdict(const std::vector<SuiteEntry>& entries);

std::size_t countOf(const std::vector<SuiteEntry>& entries, Verdict verdict);

/// The sum of all wall times, s.
double secondsOf(const std::vector<SuiteEntry>& entries);

/// `suite.json`: verdict, counts and wall times of all and of each scenario.
std::string suiteJson(const std::vector<SuiteEntry>& entries);

}  // namespace ursula::report

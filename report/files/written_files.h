#pragma once

#include <string>
#include <vector>

#include "report/files/report.h"
#include "validation/verdict/result.h"

namespace ursula::report {

/// `report.html`: one file that needs no network. Verdict, checks, drawings and tables are plain HTML; its script draws
/// the charts and animates the machine. In a suite it links to the index.
std::string reportHtml(const ValidationResult& result, Place place = Place::alone);

/// `index.html` of a suite; its script only sorts and filters.
std::string indexHtml(const std::vector<SuiteEntry>& entries);

/// JUnit XML with a suite per scenario and a case per check. Undecided checks are `skipped`, which CI systems show and
/// do not count as passed; an entry's error text is an `error`. A verdict that no case explains (for instance without
/// checks) gets its own case, so no suite looks better than its verdict. Elements and attributes follow Jenkins'
/// junit-10.xsd.
std::string junitXml(const std::vector<SuiteEntry>& entries);

/// The verdict over all entries; as for checks, an empty suite is no success.
Verdict suiteVerdict(const std::vector<SuiteEntry>& entries);

/// The verdict in one word, or "error" if there is no result.
std::string wordOf(const SuiteEntry& entry);
/// The number of entries with that word.
std::size_t countOf(const std::vector<SuiteEntry>& entries, const std::string& word);
/// "1 passed, 0 failed, 2 inconclusive, 1 in error"; `whole` follows the first number, as in "1 of 4 scenarios passed".
std::string countsOf(const std::vector<SuiteEntry>& entries, const std::string& whole = "");

/// The sum of all wall times, s.
double secondsOf(const std::vector<SuiteEntry>& entries);

/// `suite.json`: verdict, counts and wall times of all and of each scenario.
std::string suiteJson(const std::vector<SuiteEntry>& entries);

/// Returns the result with the run in its provenance, as files contain it: see run.h.
ValidationResult stamped(const ValidationResult& result);

/// `summary.json`. A number that is not finite becomes null; findings and provenance are ordered objects.
std::string summaryJson(const ValidationResult& result);

/// Checked scenarios as JSON: an object of one, an array of several.
std::string checkedJson(const std::vector<CheckedScenario>& checked);

/// An array of `{mistake, cause, largest}`, with `alike` for further sentences of the same cause.
std::string blindJsonText(const std::vector<BlindSpot>& blind);

/// The summary of a scenario with an error: scenario, verdict "error" and error.
std::string errorJson(const std::string& scenario, const std::string& error);

}  // namespace ursula::report

#pragma once

#include <filesystem>
#include <vector>

#include "report/report.h"

namespace ursula {

/// What `validate` says on standard output.
enum class Said { table, verdict, json };

/// Of one scenario, whose results are in `dir`.
void printResult(const ValidationResult& result, const std::filesystem::path& dir, Said said);

/// Of several, in the order given. As JSON: an array of the summaries that are in their folders, in its place for one
/// in error an object of scenario, verdict "error" and error.
void printSuite(const std::vector<SuiteEntry>& entries, const std::filesystem::path& dir, Said said);

int exitCode(Verdict verdict);

/// One in error is a failure: something was written, so this is no bad input.
int exitCode(const std::vector<SuiteEntry>& entries);

}  // namespace ursula

#pragma once

#include <filesystem>
#include <vector>

#include "report/report.h"

namespace ursula {

/// The output of `validate` on standard output.
enum class PrintedForm { table, verdict, json };

/// Prints one scenario's result; `dir` contains its files.
void printResult(const ValidationResult& result, const std::filesystem::path& dir, PrintedForm form);

/// Prints several results in the given order. JSON is an array of the summaries in their folders. A scenario with an
/// error has an object of scenario, verdict "error" and error instead.
void printSuite(const std::vector<SuiteEntry>& entries, const std::filesystem::path& dir, PrintedForm form);

int exitCode(Verdict verdict);

/// Returns the exit code. An entry with an error counts as a failure and not as bad input, because results were
/// written.
int exitCode(const std::vector<SuiteEntry>& entries);

}  // namespace ursula

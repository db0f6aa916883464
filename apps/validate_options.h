#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "report/files/report.h"
#include "validation/subject/torque_file.h"

namespace ursula {

/// Adds the repeatable option `--map NAME=COLUMN`.
void addMapOption(CLI::App& verb, std::vector<std::string>& map);

/// Reads a torque file and reports once on stderr how it was interpreted and which columns were ignored. Throws
/// CsvError like readTorqueFile and parseColumnMap.
TorqueFile readTorquesAloud(const std::string& file, const std::vector<std::string>& map, const Motors& motors);
/// Says on standard error how the columns of a file of efforts were read, and which are ignored; `wanted` are
/// targetNames().
void sayHowRead(const std::string& file, const std::string& read_as, const std::vector<std::string>& ignored,
                const std::vector<std::string>& wanted);

/// The output of `validate` on standard output.
enum class PrintedForm { groups, table, verdict, json };

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

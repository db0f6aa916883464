#pragma once

#include <filesystem>
#include <vector>

#include "report/files/report.h"
#include "validation/verdict/result.h"

namespace ursula::test {

/// Made-up results in the form of real ones, with every chart, two curves, findings and provenance.
ValidationResult passedSample();
/// Torques alone, with two checks beyond their limits and one that was not made.
ValidationResult failedSample();
ValidationResult inconclusiveSample();
/// A file's efforts with a factor on one motor, of which the likely cause is known. Three telescopic legs carry the
/// platform, and the replay stopped on the way.
ValidationResult externalSample();
/// Markup, control characters and broken UTF-8 in every text, and non-finite values in every number.
ValidationResult hostileSample();

/// Writes the index of a suite into `dir`; the scenarios' folders stay.
void writeSuiteIndex(const std::vector<SuiteEntry>& entries, const std::filesystem::path& dir);

}  // namespace ursula::test

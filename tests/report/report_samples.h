#pragma once

#include <filesystem>
#include <vector>

#include "report/report.h"
#include "validation/verdict/result.h"

namespace ursula::test {

/// Made-up results with the shapes that real ones have: every chart, two curves, findings, provenance.
ValidationResult passedSample();
/// Two checks beyond their limits, one that was not made, and torques alone.
ValidationResult failedSample();
ValidationResult inconclusiveSample();
/// A file's efforts with a factor on one motor: what is off and why is known. Three telescopic legs carry the platform,
/// and the replay stopped on the way.
ValidationResult externalSample();
/// Markup, control characters and broken UTF-8 wherever text goes, numbers that are not finite wherever numbers go.
ValidationResult hostileSample();

/// The index of a suite in `dir`, whose folders of scenarios stay.
void writeSuiteIndex(const std::vector<SuiteEntry>& entries, const std::filesystem::path& dir);

}  // namespace ursula::test

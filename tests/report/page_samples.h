#pragma once

#include <filesystem>

#include "studies/audit/audit.h"
#include "studies/prove/prove_page.h"
#include "validation/verdict/result.h"

namespace ursula::test {

/// A test's history beside that of the passed sample: one effort 0.1 % off, one channel that is missing.
TimeSeries comparedSample();

/// The passed sample stretched to sixty seconds at a kilohertz, with a ripple that thinning must keep.
ValidationResult longSample();

/// A made-up proof: defects that are caught by several checks, by one, and not at all.
ProveFound proveSample(bool weak);

/// A made-up audit of rows that the paper has.
Audit auditSample();

/// Writes `comparison/`, `same/`, `prove.html`, `weak.html` and `audit.html` into `dir`.
void writePageSamples(const std::filesystem::path& dir);

}  // namespace ursula::test

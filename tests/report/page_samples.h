#pragma once

#include <filesystem>

#include "parts/audit/audit.h"
#include "parts/prove/prove.h"
#include "validation/verdict/result.h"

namespace ursula::test {

/// A history to compare with the passed sample's: one effort is 0.1 % off, and one channel is missing.
TimeSeries comparedSample();

/// The passed sample stretched to sixty seconds at a kilohertz, with a ripple that thinning must keep.
ValidationResult longSample();

/// A made-up proof, with defects that several checks catch, one catches, or none.
ProveResult proveSample(bool weak);

/// A made-up audit with equations of the paper.
Audit auditSample();

/// Writes `comparison/`, `same/`, `prove.html`, `weak.html` and `audit.html` into `dir`.
void writePageSamples(const std::filesystem::path& dir);

}  // namespace ursula::test

#pragma once

#include <string>

#include <filesystem>

#include "parts/prove/prove.h"
#include "validation/verdict/result.h"

namespace ursula::test {

/// A history to compare with the passed sample's: one effort is 0.1 % off, and one channel is missing.
TimeSeries comparedSample();

/// The passed sample stretched to sixty seconds at a kilohertz, with a ripple that thinning must keep.
ValidationResult longSample();

/// The passed sample with the machine of a shipped scenario.
ValidationResult machineSample(const std::string& name);

/// A made-up proof, with defects that several checks catch, one catches, or none.
ProveResult proveSample(bool weak);

/// Writes `comparison/`, `same/`, `prove.html` and `weak.html` into `dir`.
void writePageSamples(const std::filesystem::path& dir);

}  // namespace ursula::test

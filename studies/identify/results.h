#pragma once

#include "studies/identify/identify.h"
#include "studies/identify/judge.h"
#include "studies/identify/physical.h"

namespace ursula::identification {

/// "mass of leg 3's distal link", "mass × mass centre x of the platform": what efforts are linear in, in words.
std::string wordsOf(const Direction& direction);

MeasuredCause measuredCause(const FoundCause& cause);
void addCombinations(const BaseFit& fit, const Comparison& comparison, IdentifyResult& out);
void addNumbers(const PhysicalEstimate& estimate, double quantile, IdentifyResult& out);
/// Efforts measured, of the model and with what they may be off by, N·m or N.
void addEfforts(const Comparison& comparison, const Eigen::MatrixXd& u_val, IdentifyResult& out);
/// Those of the fitted model, and the spectra of what it leaves.
void addSeries(const Comparison& comparison, const BaseFit& fit, const FilteredLog& filtered, IdentifyResult& out);
std::string identifySentence(const IdentifyResult& result);

/// The scenario with the numbers of which the log says something, each with its standard uncertainty as a tolerance.
/// Empty for a scenario that a program made.
std::string identifiedScenario(const Scenario& scenario, const PhysicalEstimate& estimate);

}  // namespace ursula::identification

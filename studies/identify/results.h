#pragma once

#include "studies/identify/identify.h"
#include "studies/identify/judge.h"

namespace ursula::identification {

/// Finds saturation, and marks its rows as missing. Also finds quantisation that is coarser than the noise.
void findSigns(MeasuredLog& log, const Motors& motors, std::vector<LogFinding>& findings);

/// Finds efforts of exchanged motors, of the other sign, or in other units than the model's.
void findMistakes(const ModelledLog& modelled, const Motors& motors, std::vector<LogFinding>& findings,
                  std::vector<MeasuredCause>& causes);

/// Returns a linear parameter in words: "mass of leg 3's distal link", "mass × mass centre x of the platform".
std::string wordsOf(const Direction& direction);

void addCombinations(const BaseFit& fit, const Comparison& comparison, IdentifyResult& out);
void addNumbers(const PhysicalEstimate& estimate, double quantile, IdentifyResult& out);
/// Adds measured and modelled efforts and their uncertainty, N·m or N.
void addEfforts(const Comparison& comparison, const Eigen::MatrixXd& u_val, IdentifyResult& out);
/// Adds efforts of the fitted model, and the spectra of its residual.
void addSeries(const Comparison& comparison, const BaseFit& fit, const FilteredLog& filtered, IdentifyResult& out);
std::string identifySentence(const IdentifyResult& result);

/// Returns the scenario with the numbers that the log shows, each with its standard uncertainty as tolerance. Returns
/// "" for a scenario that a program made.
std::string identifiedScenario(const Scenario& scenario, const PhysicalEstimate& estimate);

/// Adds what a log in milliseconds or microseconds shows: it lasts a thousand or a million times the scenario's motion.
void findUnitOfTime(double duration, double of_motion, std::vector<LogFinding>& findings,
                    std::vector<MeasuredCause>& causes);

/// Whether no coordinate moves by more than its noise.
bool isStill(const MeasuredLog& log);

}  // namespace ursula::identification

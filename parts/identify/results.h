#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "parts/identify/estimate.h"
#include "parts/identify/identify.h"

namespace ursula::identification {

/// A possible difference from the model.
struct Suspect {
  Direction direction;
  Eigen::VectorXd column;  ///< column in the square root's rows
  double tolerance = 0;    ///< stated tolerance; 0 for none
};

struct Judgement {
  std::vector<MeasuredCause> causes;
  double squares = 0;        ///< squared deviation in units of tolerances and noise
  Eigen::Index freedom = 0;  ///< expected squares of a right model
  double squares_limit = 0;
  double threshold = 0;   ///< limit of a score
  bool deviates = false;  ///< whether a cause was found or the squares exceed their limit
  /// Deviations of numbers with a tolerance that would be found in 95 % of all cases, by the number's path.
  std::map<std::string, double> least_found;
};

/// Returns every number of the machine and of the log. Numbers that are equal on all legs also stand together as one.
std::vector<Suspect> suspectsOf(const SquareRoot& model, const Comparison& comparison,
                                const ManipulatorParameters& machine, const NumberTolerances& tolerances);

/// Returns the remaining delay, s, and its standard uncertainty. The numbers stay the scenario's within their
/// tolerances, because a free fit of all of them trades the delay for masses and friction. Only numbers that must be
/// wrong whatever the delay is are free.
std::pair<double, double> delayLeft(const SquareRoot& model, const Comparison& comparison,
                                    const std::vector<Suspect>& suspects, Eigen::Index noise_freedom);

/// Judges the deviations against tolerances, the delay's uncertainty and noise. A right model passes in 95 % of all
/// cases.
Judgement judge(const SquareRoot& model, const Comparison& comparison, const std::vector<Suspect>& suspects,
                double delay_deviation, Eigen::Index noise_freedom);

/// Returns the uncertainty of the efforts from tolerances, as root sum of squares; an instant in each row.
Eigen::MatrixXd inputUncertainty(const Comparison& comparison, const ManipulatorParameters& machine,
                                 const NumberTolerances& tolerances);

/// Finds saturation, and marks its rows as missing. It also finds quantisation that is coarser than the noise.
/// Efforts of the other sign are found by findMistakes().
void findSaturation(MeasuredLog& log, const Motors& motors, IdentifyResult& out);

/// Finds efforts of exchanged motors, of the other sign, or in other units than the model's.
void findMistakes(const ModelledLog& modelled, const Motors& motors, IdentifyResult& out);

/// Returns a linear parameter in words: "mass of leg 3's distal link", "mass × mass centre x of the platform".
std::string wordsOf(const Direction& direction);

void addCombinations(const BaseFit& fit, const Comparison& comparison, IdentifyResult& out);
void addNumbers(const std::vector<NumberEstimate>& estimates, double quantile, IdentifyResult& out);
/// Adds measured and modelled efforts and their uncertainty, N·m or N.
void addEfforts(const Comparison& comparison, const Eigen::MatrixXd& u_val, IdentifyResult& out);
/// Adds efforts of the fitted model, and the spectra of its residual.
void addSeries(const Comparison& comparison, const BaseFit& fit, const FilteredLog& filtered, IdentifyResult& out);
std::string identifySentence(const IdentifyResult& result);

/// Returns the scenario with the numbers that the log shows, each with its standard uncertainty as tolerance. Returns
/// "" for a scenario that a program made.
std::string identifiedScenario(const Scenario& scenario, const std::vector<NumberEstimate>& estimates);

/// Adds what a log in milliseconds or microseconds shows: it lasts a thousand or a million times the scenario's motion.
void findUnitOfTime(double of_motion, IdentifyResult& out);

/// Returns whether no coordinate moves by more than its noise.
bool isStill(const MeasuredLog& log);

}  // namespace ursula::identification

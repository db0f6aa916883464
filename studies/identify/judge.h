#pragma once

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "studies/identify/estimate.h"
#include "studies/identify/identify.h"

namespace ursula::identification {

/// A rotor that the scenario lacks gets the smallest inertia (withRotors), so that it has a derivative.
inline double stated(double nominal) { return std::abs(nominal) < 1e-300 ? 0 : nominal; }

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

/// Returns every number of the machine and of the log, and those that are equal on all legs also together.
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

}  // namespace ursula::identification

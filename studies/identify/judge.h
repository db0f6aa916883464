#pragma once

#include <string>
#include <utility>
#include <vector>

#include "studies/identify/estimate.h"

namespace ursula::identification {

/// One thing that may be other than the model has it.
struct Suspect {
  Direction direction;
  Eigen::VectorXd column;  ///< in the square root's rows
  double tolerance = 0;    ///< stated; 0: none
};

/// A suspect whose change explains the deviation beyond what tolerances and noise do.
struct FoundCause {
  Direction direction;
  double change = 0, deviation = 0;  ///< from the nominal value, and the standard uncertainty of that
  double tolerance = 0;
  double score = 0;                ///< change over what tolerances and noise let it be
  double explained = 0;            ///< share of the deviation's square in units of what is allowed
  std::vector<Direction> as_well;  ///< that cannot be told from it
  bool outside = false;            ///< no combination of masses, inertias and friction does the same
};

struct Judgement {
  std::vector<FoundCause> causes;
  double squares = 0;        ///< of the deviation, in units of tolerances and noise
  Eigen::Index freedom = 0;  ///< what it would be on average, were the model right
  double squares_limit = 0;
  double threshold = 0;   ///< of a score
  bool deviates = false;  ///< a cause was found, or the squares are beyond their limit
};

/// Every number of the machine, and of the log; numbers that are the same on all legs also together.
std::vector<Suspect> suspectsOf(const SquareRoot& model, const Comparison& comparison,
                                const ManipulatorParameters& machine, const NumberTolerances& tolerances);

/// The delay that is left, s, and its standard uncertainty. The numbers are the scenario's within their tolerances: a
/// free fit of all of them trades the delay for masses and friction.
std::pair<double, double> delayLeft(const SquareRoot& model, const Comparison& comparison,
                                    const std::vector<Suspect>& suspects);

/// Deviations are right where tolerances, the delay's uncertainty and noise let them be so in 95 % of all cases.
Judgement judge(const SquareRoot& model, const Comparison& comparison, const std::vector<Suspect>& suspects,
                double delay_deviation, Eigen::Index noise_freedom);

/// What tolerances make of the efforts, root sum of squares: an instant a row.
Eigen::MatrixXd inputUncertainty(const Comparison& comparison, const ManipulatorParameters& machine,
                                 const NumberTolerances& tolerances);

}  // namespace ursula::identification

#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "parts/causes/hypotheses.h"
#include "parts/causes/tried_causes.h"

// How causes are fitted: those of parts/causes/, and some with ways of their own.

namespace ursula {

/// Σ aₖ·bₖ.
inline double dot(const std::vector<Vector6d>& a, const std::vector<Vector6d>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k].dot(b[k]);
  return sum;
}
inline double norm(const std::vector<Vector6d>& rows) { return std::sqrt(dot(rows, rows)); }

/// Fits all causes to the residual to first order on a few instants. It fits the likely ones there by Gauss–Newton, and
/// the best on all instants. It drops causes without effect, without a fit, or incompatible with the motion. The order
/// is that of `causes`.
std::vector<Hypothesis> fitCauses(const std::vector<Cause>& causes, const TorqueResidual& data);

/// A part of the torques, or the difference that a wrong formula makes.
struct TorqueTerm {
  std::string name;
  std::string term = {}, body = {};    ///< names in the contract; empty if it has none
  std::optional<double> fixed = {};    ///< known multiple in the residual; empty if it is to be fitted
  double gravity = 0;                  ///< m/s², of the part that is gravity's
  std::vector<Vector6d> torques = {};  ///< N·m, one for each motion
};

/// Gravity, inertia, velocity terms, friction and load as parts; formulas as printed or with omitted terms as
/// differences. The NOC computes them with changed parameters or motions. Terms that throw for this motion are skipped.
std::vector<TorqueTerm> torqueTerms(const Scenario& scenario, const std::vector<Motion<double>>& motions,
                                    const std::vector<Vector6d>& exact);

/// How far the efforts found of motor i are from ± those right of motor j.
struct MotorPairs {
  Eigen::MatrixXd sign, cost;

  /// One motor in each row.
  MotorPairs(const Eigen::MatrixXd& found, const Eigen::MatrixXd& right);
  double signAt(std::size_t i, std::size_t j) const {
    return sign(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }
  /// The order of least cost; of many motors each takes the nearest.
  std::vector<std::size_t> best(double& least) const;
};

/// Tries every order of the legs with the best signs, in the unit that the torques' size suggests. Returns nullopt if
/// neither order nor signs differ.
std::optional<Hypothesis> signsAndOrder(const TorqueResidual& data);

/// Finds torques of another time, τ(t + dt), with dt in ms and in samples. Uses the samples whose shifted time is
/// within the motion; returns nullopt if they are too few.
std::optional<Hypothesis> timeShift(const Scenario& scenario, const TorqueResidual& data);

/// Tries efforts of an engine whose soft constraints close the loops, as mj_inverse has them: open loops, with forces
/// in proportion to J̇ u. One number per leg is fitted. Returns nullopt if a leg's number is not positive or has no
/// effect.
std::optional<Hypothesis> softLoops(const Scenario& scenario, const TorqueResidual& data);

/// Tries every vector of the machine with all its entries wrong: gravity, mass centres, points, axes. It fits two or
/// three numbers each, and drops those that leave more than a thousandth.
std::vector<Hypothesis> fitVectors(const Scenario& scenario, const TorqueResidual& data);

}  // namespace ursula

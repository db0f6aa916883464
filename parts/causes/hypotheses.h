#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Names of motors in texts.
struct MotorNames {
  bool one_a_leg = true;  ///< whether a motor can have the name of its leg
  PerMotor<bool> slides = {};

  const char* kind() const { return one_a_leg ? "leg" : "motor"; }
  std::string operator()(int k) const { return std::string(kind()) + ' ' + std::to_string(k + 1); }
  bool allSlide() const {
    return std::all_of(slides.begin(), slides.end(), [](bool one) { return one; });
  }
  const char* unit(int k) const { return slides[k] ? "N" : "N m"; }
};
MotorNames motorNames(const Manipulator& machine);

/// Says in a cause which motors, 0-based, it is about: one, some or all.
void nameMotors(const std::vector<int>& motors, NamedCause& cause);

/// Torques that differ from the exact ones, for an explanation.
struct TorqueResidual {
  std::vector<Motion<double>> motions;
  std::vector<Vector6d> exact;     ///< of the NOC, N·m
  std::vector<Vector6d> residual;  ///< subject's torques minus exact, N·m
  std::vector<Vector6d> limit;     ///< possible difference of right torques: rounding and the file's digits, N·m
  /// Number of rows along the commanded motion; further rows are a solver's answers to separate questions.
  std::size_t commanded = 0;
  MotorNames motors;
  std::vector<double> instants;  ///< all of the given torques, s; empty if unknown

  void add(const Motion<double>& motion, const Vector6d& right, const Vector6d& found, const Vector6d& within);
  /// Adds a row of `other`.
  void add(const TorqueResidual& other, std::size_t row);
  Vector6d found(std::size_t row) const { return exact[row] + residual[row]; }
  /// Only the rows along the commanded motion.
  TorqueResidual alongMotion() const;
  /// At most `most` rows, evenly picked; half of them lie along the motion if a solver also answered separate
  /// questions.
  TorqueResidual picked(std::size_t most) const;

  double norm() const;
  /// How many times larger the subject's torques are than the right ones, at least 1; their rounding grows so too.
  double growth() const;
  /// The largest ratio of an entry of `left`, one row per instant, to its limit.
  double beyond(const std::vector<Vector6d>& left) const;
};

/// One possible cause of a difference in torques.
struct Hypothesis {
  std::string text;                                         ///< "gravity left out"
  double unexplained = 1;                                   ///< ‖residual − predicted‖ / ‖residual‖
  int free_numbers = 0;                                     ///< number of fitted numbers
  double beyond = std::numeric_limits<double>::infinity();  ///< the largest remainder, in multiples of the limit
  std::optional<NamedCause> named = {};                     ///< nullopt if the contract has no name for it
  bool is_possible = true;                                  ///< whether bodies can have the fitted number
  double of_found = 1;                                      ///< ‖residual − predicted‖ / ‖subject's torques‖
  /// The text for an uncertainty that is so many times as large; empty if it says none.
  std::function<std::string(double wider)> says = {};
  double explained() const { return 1 - unexplained; }
};

/// Tries what an expert would, likely and simple causes first, each fitted to the residual by least squares. Terms may
/// be omitted or scaled (gravity, inertia, velocity terms, friction, load). Signs, leg order, units, time, scale
/// factors and offsets may differ. Then come the formulas as printed, every machine parameter, and other
/// interpretations of the motion. It drops causes without effect on this motion, and those with as many free numbers as
/// data. The regressors are the NOC's own torques with changed parameters.
std::vector<Hypothesis> fitHypotheses(const Scenario& scenario, const TorqueResidual& data);

/// The usual name of a scale factor of these motors' efforts ("kN m for N m", "kN for N"); empty if it has none.
std::string unitOf(double factor, const MotorNames& motors);

}  // namespace ursula

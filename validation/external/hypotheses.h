#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/verdict/likely_cause.h"

namespace ursula {

/// How motors are called in texts.
struct MotorNames {
  bool one_a_leg = true;  ///< so that a motor can be called by its leg
  std::array<bool, motor_count> slides = {};

  const char* kind() const { return one_a_leg ? "leg" : "motor"; }
  std::string operator()(int k) const { return std::string(kind()) + ' ' + std::to_string(k + 1); }
  const char* unit(int k) const { return slides[static_cast<std::size_t>(k)] ? "N" : "N m"; }
};
MotorNames motorNames(const Manipulator& machine);

/// Torques that differ from the exact ones: what an explanation has to account for.
struct TorqueResidual {
  std::vector<Motion<double>> motions;
  std::vector<Vector6d> exact;     ///< of the NOC, N·m
  std::vector<Vector6d> residual;  ///< torques on trial less exact, N·m
  std::vector<Vector6d> limit;     ///< by how much right ones may differ: rounding and the file's digits, N·m
  /// Rows along the commanded motion; those after them are of a solver that was asked for one thing at a time.
  std::size_t commanded = 0;
  MotorNames motors;

  void add(const Motion<double>& motion, const Vector6d& right, const Vector6d& found, const Vector6d& within);
  /// The rows along the commanded motion alone.
  TorqueResidual alongMotion() const;

  double norm() const;
  /// The largest share of its limit that an entry of `left`, one row for each instant, has.
  double beyond(const std::vector<Vector6d>& left) const;
};

/// One way in which torques may have come to differ.
struct Hypothesis {
  std::string text;                                         ///< "gravity left out"
  double unexplained = 1;                                   ///< ‖residual − predicted‖ / ‖residual‖
  int free_numbers = 0;                                     ///< that were fitted
  double beyond = std::numeric_limits<double>::infinity();  ///< what remains, in limits, where that is largest
  std::optional<NamedCause> named = {};                     ///< none for what has no name in the contract
  double explained() const { return 1 - unexplained; }
};

/// Everything that a person would try, likely and simple ones first, each fitted to the residual by least squares:
/// terms left out or scaled (gravity, inertia, velocity terms, friction, load), signs, orders of the legs and units, a
/// time shift, scale factors, offsets, the formulas as printed, every parameter of the machine and the motion read
/// otherwise. Left out are those that have no effect on this motion and those with as many free numbers as there are
/// data. The regressors are the NOC's own torques with parameters changed.
std::vector<Hypothesis> fitHypotheses(const Scenario& scenario, const TorqueResidual& data);

/// How a scale factor is known to people ("kN m for N m"); empty for one that is not.
std::string unitOf(double factor);

}  // namespace ursula

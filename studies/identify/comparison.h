#pragma once

#include <array>
#include <string>
#include <vector>

#include "model/machine_numbers.h"
#include "model/number_tolerances.h"
#include "nocsolver/fast/effort_derivatives.h"
#include "studies/identify/filtered_log.h"

namespace ursula::identification {

enum class DirectionKind { linear, offset, delay, number, scale, encoder, elastic, backlash, load_friction };
/// "effort_scale", "encoder_offset", …: as `summary.json` names what may have caused a deviation.
const char* name(DirectionKind kind);

/// One way in which measured efforts may come to differ from the model's, by a number that is zero where they agree.
struct Direction {
  DirectionKind kind = DirectionKind::linear;
  std::string path;   ///< of a number of the machine, or of what efforts are linear in; empty of the log's own
  std::string words;  ///< "offset of motor 3's effort"
  std::string unit;
  int motor = -1;        ///< 0-based; −1: of no motor
  double nominal = 0;    ///< what the model has
  double plausible = 1;  ///< a size that a difference may have
};

/// Efforts, a row an instant and a column a motor; and of each motor a table with a row an instant.
using MotorTables = std::array<Eigen::MatrixXd, motor_count>;

/// What was measured beside what the model says, after both low passes, and what would change it.
struct Comparison {
  Eigen::VectorXd t;                ///< s, of the motion
  Eigen::MatrixXd measured, model;  ///< N·m or N
  Eigen::MatrixXd model_rate;       ///< N·m/s or N/s
  std::vector<Segment> segments;
  std::vector<Direction> directions;      ///< all linear ones first, then six offsets, then the delay
  Vector6d numerical = Vector6d::Zero();  ///< what the low passes may be off by, root mean square, N·m or N
  MotorTables columns;                    ///< their derivatives of the measured efforts
  Eigen::Index linear = 0;                ///< how many are linear

  Eigen::Index offsets() const { return linear; }
  Eigen::Index delay() const { return linear + motor_count; }
  Eigen::Index further() const { return delay() + 1; }
};

/// The motion that a log has, and the efforts that a scenario's machine needs for it.
class ModelledLog {
 public:
  /// Throws CsvError where the machine cannot follow the log's motion, with what may be the reason.
  ModelledLog(const Scenario& scenario, const MeasuredLog& log, const FilteredLog& filtered);

  const FilteredLog& filtered() const { return filtered_; }
  const Eigen::MatrixXd& efforts() const { return efforts_; }
  /// By how much measured efforts come after those of the motion, s, to a step of the filter: where they are likest.
  double coarseDelay(double most) const;

  /// For efforts that come `delay` s late. Directions that do not change with the delay are made once.
  void compare(double delay, Comparison& out) const;
  /// All directions; slow.
  Comparison directions(bool with_further) const;
  /// By the driven coordinates, their rates and accelerations: root mean squares of ∂τᵢ/∂qₖ, 6 × 6 each; empty for
  /// poses.
  std::array<Matrix6d, 3> sensitivity() const;

 private:
  void placeMotions(const MeasuredLog& log);
  [[noreturn]] void refuse(const MeasuredLog& log, Eigen::Index at) const;
  Vector6d numericalError() const;
  void addLinear(Comparison& out) const;
  void addOfLog(Comparison& out) const;
  void addNumbers(Comparison& out) const;
  void addSeries(Comparison& out) const;
  void add(Comparison& out, const Direction& direction, const Eigen::MatrixXd& columns) const;
  Eigen::MatrixXd changedBy(int motor, const Eigen::MatrixXd& error) const;
  Eigen::MatrixXd effortsOf(const Manipulator& machine) const;

  const Scenario& scenario_;
  const FilteredLog& filtered_;
  bool has_poses_;
  MotorChain chain_;
  std::vector<Motion<double>> motions_;
  std::vector<Vector6d> loads_;
  Eigen::MatrixXd efforts_, driven_rates_;
};

/// A machine on whose driven coordinates rotors have an inertia, if only the smallest.
ManipulatorParameters withRotors(ManipulatorParameters machine);

}  // namespace ursula::identification

#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "model/machine_numbers.h"
#include "model/number_tolerances.h"
#include "parts/derivatives/effort_derivatives.h"
#include "parts/identify/filtered_log.h"

namespace ursula::identification {

/// From `offset` on, a direction belongs to one motor and is a possible cause.
enum class DirectionKind { linear, number, numerical, delay, offset, scale, encoder, elastic, backlash, load_friction };
/// Returns the kind's name in `summary.json`: "effort_scale", "encoder_offset", …
const char* name(DirectionKind kind);

/// A possible difference between measured and modelled efforts. Its number is zero if they agree.
struct Direction {
  DirectionKind kind = DirectionKind::linear;
  std::string path;   ///< path of a machine's number or of a linear parameter; empty for the log's own
  std::string words;  ///< "offset of motor 3's effort"
  std::string unit;
  int motor = -1;        ///< 0-based; −1 for no motor
  double nominal = 0;    ///< the model's value
  double plausible = 1;  ///< plausible size of a difference

  const std::string& name() const { return path.empty() ? words : path; }
};

/// Tables of efforts, one for each motor, with an instant in each row.
using MotorTables = PerMotor<Eigen::MatrixXd>;

/// Measured and modelled efforts after both low passes, and the directions that change the model.
struct Comparison {
  Eigen::VectorXd t;  ///< instants of the motion, s
  /// Efforts, N·m or N. Both keep all noise of the motion; its likely part was taken out of the other members.
  Eigen::MatrixXd measured, model;
  Eigen::MatrixXd model_rate;  ///< N·m/s or N/s
  std::vector<Segment> segments;
  std::vector<Direction> directions;      ///< linear ones first, then six offsets, the delay, six errors of the low
                                          ///< passes, and further ones
  Vector6d numerical = Vector6d::Zero();  ///< error of the low passes, root mean square, N·m or N
  std::vector<Eigen::MatrixXd> slopes;  ///< derivatives of an instant's efforts by value, rate and acceleration of each
                                        ///< channel of the motion, 6 × 3 channels
  std::vector<Eigen::Index> kept;       ///< rows among the settled instants
  MotorTables columns;                  ///< derivatives of measured efforts by the directions
  Eigen::Index linear = 0;              ///< number of linear directions

  Eigen::Index offsets() const { return linear; }
  Eigen::Index delay() const { return linear + motor_count; }
  Eigen::Index further() const { return delay() + 1; }  ///< first of the errors of the low passes
};

/// The log's motion, and the efforts that a scenario's machine needs for it.
class ModelledLog {
 public:
  /// Throws CsvError with a likely reason if the machine cannot follow the log's motion.
  ModelledLog(const Scenario& scenario, const MeasuredLog& log, const FilteredLog& filtered);

  const FilteredLog& filtered() const { return filtered_; }
  const Eigen::MatrixXd& efforts() const { return efforts_; }
  /// Returns the delay of the measured efforts behind the motion that has the best correlation, s. Returns 0 if the
  /// efforts correlate about as well without a delay. Its resolution is a step of the filter; |delay| <= `most`.
  double coarseDelay(double most) const;

  /// Makes all directions. This is slow.
  Comparison directions() const;

 private:
  void placeMotions(const MeasuredLog& log);
  [[noreturn]] void refuse(const MeasuredLog& log, Eigen::Index at) const;
  void addLinear(Comparison& out) const;
  void addOfLog(Comparison& out) const;
  void addNumerical(Comparison& out) const;
  void addNumbers(Comparison& out) const;
  void addSeries(Comparison& out) const;
  void add(Comparison& out, const Direction& direction, const Eigen::MatrixXd& columns) const;
  std::vector<Eigen::MatrixXd> slopes() const;
  std::vector<Eigen::Index> steadyRows(const std::vector<Eigen::MatrixXd>& slopes) const;
  void keepSteady(Comparison& out) const;
  Eigen::MatrixXd effortsOf(const Manipulator& machine) const;
  /// Returns the platform's motion for a state near that of instant `i`, if the machine can take it.
  std::optional<Motion<double>> motionNear(Eigen::Index i, const MeasuredState& state) const {
    return has_poses_ ? motionOfPoses(state) : chain_.follow(state, motions_[i]);
  }

  const Scenario& scenario_;
  const FilteredLog& filtered_;
  bool has_poses_;
  MotorChain chain_;
  std::vector<Motion<double>> motions_;
  std::vector<Vector6d> loads_;
  Eigen::MatrixXd efforts_, driven_rates_;
};

/// Returns the machine with a positive rotor inertia on every driven coordinate, however small. A rotor of zero has no
/// column in the regressor.
ManipulatorParameters withRotors(ManipulatorParameters machine);

/// Returns the number as the scenario has it: 0 for a rotor that withRotors() added.
inline double stated(double nominal) { return std::abs(nominal) < 1e-300 ? 0 : nominal; }

}  // namespace ursula::identification

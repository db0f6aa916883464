#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/deadline.h"
#include "model/mechanism_scenario.h"
#include "nocsolver/loops/loop_solver.h"
#include "validation/verdict/result.h"

namespace ursula {

class SimbodyMechanism;

/// The relative rounding of a double.
constexpr double rounding = std::numeric_limits<double>::epsilon();

/// Efforts of all motors, one entry each.
using MotorEfforts = Eigen::VectorXd;

/// Returns the sine of a small turn between two displacements of a body. How far an idle one has turned about its own
/// line is anybody's choice: then it is that between the lines.
inline double turnBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, const IdleBody* idle) {
  const Matrix3d apart = a.linear() - b.linear();
  return idle != nullptr ? (apart * idle->line).norm() : apart.norm() / std::sqrt(2.0);
}

/// What a solver is asked about one instant: the motors' motion, and all other joints'.
struct MechanismQuestion {
  MotorMotion motion;
  std::vector<LoopSolver::JointValue> joints;
};

/// Efforts at instants of their own, from a file or a program.
struct GivenEfforts {
  std::string name;
  bool is_read = false;
  std::vector<double> t;
  std::vector<MotorEfforts> efforts;
  std::vector<MotorEfforts> precision;  ///< half a unit of the last digit printed; zero if exact
  std::vector<double> time_precision;   ///< the same of the instants, s; empty if they are exact
  std::string read_as;
  std::vector<std::string> ignored;
  std::string derived_from;  ///< where the precision comes from, if not from printed digits
  bool all_single = false;   ///< every effort is a single-precision number, as printed
};

/// Whose efforts are judged. Without `answers` and `given` it is this program's NOC.
struct MechanismSubject {
  JudgedSubject about = {"noc", Formulation::noc};
  std::function<std::vector<MotorEfforts>(const std::vector<MechanismQuestion>&)> answers;
  /// The same between the samples; empty if it is the same.
  std::function<std::vector<MotorEfforts>(const std::vector<MechanismQuestion>&)> answers_between;
  bool gives_accelerations = false;  ///< the answers come from accelerations, whose rounding they have
  /// What the answers say by themselves, so that no cause is sought; empty if nothing. Asked after all else.
  std::function<std::string()> no_cause;
  std::shared_ptr<const GivenEfforts> given;

  /// Instants between the samples, and the most samples of a solver that is not asked thoroughly.
  int between = 600, most_samples = std::numeric_limits<int>::max();

  bool isNoc() const { return !answers && !given; }
};

/// An engine that computes the same efforts from raw parameters alone. It is asked along the motion, in order of time.
struct MechanismEngine {
  std::string check;   ///< row of the catalogue: "torque.pointwise"
  std::string voice;   ///< "Simbody, other joints cut"
  std::string engine;  ///< as in CheckRow::engine
  std::function<MotorEfforts(const MotorMotion&)> efforts;
  /// Set for one engine: the loop that its efforts place, of which bodies and accelerations are asked then.
  std::shared_ptr<SimbodyMechanism> placed;
  /// Its rounding in units of MechanismEvidence::shape, measured with inputs changed by one rounding.
  double level = 0;
};
/// Makes an engine for a mechanism; null if this build or machine has none.
using MakeMechanismEngine = std::function<std::unique_ptr<MechanismEngine>(const MechanismScenario&)>;

/// What was computed at one judged instant. Nothing here judges.
struct MechanismSample {
  MotorMotion motion;
  MotorEfforts subject, noc;
  MotorEfforts scale;                 ///< size of the terms that cancel in (37), of each motor
  MotorEfforts given;                 ///< possible error by missing digits
  double condition = 1;               ///< of the passive rates
  std::vector<MotorEfforts> engines;  ///< in the order of MechanismEvidence::engines
  MotorEfforts acceleration;          ///< of the motors by Simbody under the subject's efforts
  MotorEfforts direct;                ///< by the NOC, (36), under its own efforts
  Eigen::MatrixXd inverse_inertia;
  double position = 0, twist = 0, twist_rate = 0;  ///< largest difference of a body from Simbody's, lengths
  double twist_size = 0, twist_rate_size = 0;
  double across = 0;                                         ///< ‖D T‖ / ‖T‖, lengths
  int rank = 0;                                              ///< of T
  Eigen::Isometry3d output = Eigen::Isometry3d::Identity();  ///< the output body's frame
};

/// The same efforts by the NOC of a changed machine, at one instant.
struct InvarianceSample {
  double t = 0;
  double condition = 1;
  MotorEfforts difference, scale;
};
struct MechanismInvariance {
  std::string check;
  std::vector<InvarianceSample> samples;
};

/// Simbody's motion in one window under the subject's efforts.
struct MechanismWindow {
  double start = 0, end = 0;
  double position = 0, orientation = 0;              ///< error of the output body at the end, m and rad
  double position_limit = 0, orientation_limit = 0;  ///< what longer steps and the efforts' rounding change of it
  double closure_position = 0, closure_velocity = 0;
  double closure_position_limit = 0, closure_velocity_limit = 0;
  double order_gain = 0;  ///< how much finer steps moved the end, m
};

/// The motors' power against what the engine's energies and losses need, at an instant, W.
struct MechanismPower {
  double t = 0, error = 0, limit = 0;
  double size = 0;   ///< of the motors' powers
  double given = 0;  ///< possible error by missing digits
};

/// What of the motion the rows of a file tell.
struct Cover {
  double begin = 0, end = 0;  ///< first and last row, s
  double widest_gap = 0;      ///< between rows, and from the ends of the motion to them, s
  double largest = 0;         ///< the NOC's effort along the whole motion, in the shown unit
  bool is_cut = false;        ///< an end of the motion lies farther from the rows than these from each other
  /// Straight lines through rows as far apart as the widest gap miss the right efforts by less than their mean does, by
  /// root mean square, wherever such rows begin. Rows that are farther apart say nothing of what is between them.
  bool is_resolved = true;
  bool isWhole() const { return !is_cut && is_resolved; }
};

/// Returns what rows at these increasing instants tell of the motion. A motion of constant efforts is whole by one row.
Cover coverOf(const std::vector<double>& rows, const LoopMotion& motion, const MotorEfforts& efforts_in);

struct MechanismEvidence {
  const MechanismScenario* scenario = nullptr;
  const LoopMotion* motion = nullptr;
  std::vector<MechanismEngine> engines;
  std::vector<MechanismSample> samples;
  std::vector<MechanismSample> between;  ///< with subject, noc, scale and condition alone
  std::vector<MechanismInvariance> invariances;
  std::vector<MechanismWindow> windows;
  std::vector<MechanismPower> powers;
  MotorEfforts efforts_in;  ///< what turns each motor's effort into the shown unit: 1, or the length if motors differ
  double level = 25;        ///< units of rounding that add up from the base to an effort
  double motion_level = 0;  ///< that of the NOC's efforts, if motion and time change by one rounding, measured
  double acceleration_level = 0;  ///< that of Simbody's accelerations under efforts, measured
  double largest = 0;             ///< effort along the motion, in the shown unit
  std::string unit;               ///< "N m", or "N" if all motors slide
  std::string not_replayed, out_of_time, no_cause;
  std::string replay_diverged;       ///< why no window could be judged
  bool all_single = false;           ///< as GivenEfforts::all_single, also of answers
  bool gives_accelerations = false;  ///< as in MechanismSubject
  /// A solver, to be asked for terms apart; empty if the subject is none.
  std::function<std::vector<MotorEfforts>(const std::vector<MechanismQuestion>&)> ask;
  Cover cover;  ///< by a file's rows; of other subjects only the widest gap

  /// The growth of rounding in an effort of motor k with pose and machine, in the shown unit.
  double shape(const MechanismSample& sample, Eigen::Index k) const;
  /// The bound of rounding in that effort: of the NOC and of an engine with this level.
  double limit(const MechanismSample& sample, Eigen::Index k, double level_of_engine = 0) const {
    return (level + level_of_engine) * shape(sample, k);
  }
  /// What errors of one unit of shape in all efforts change of the motors' accelerations.
  MotorEfforts response(const MechanismSample& sample) const;
  /// The loop that the engines' efforts have placed. Throws std::logic_error if no engine has one.
  SimbodyMechanism& placed() const;
  /// The largest level of Simbody's trees.
  double levelOfSimbody() const;
};

/// What turns each motor's effort into the unit that is shown: 1, or the machine's length for a slide beside hinges.
MotorEfforts effortsInOneUnit(const Mechanism& mechanism);

/// Runs all experiments. After the deadline, it returns what was complete by then and why the rest is missing.
MechanismEvidence gatherMechanism(const MechanismScenario& scenario, const LoopMotion& motion,
                                  const MechanismSubject& subject, const std::vector<MakeMechanismEngine>& makers,
                                  const Deadline& deadline, const std::function<void(double share)>& progress);

/// Sets the levels: how efforts and accelerations change if their inputs change by one rounding.
void measureLevels(MechanismEvidence& evidence);

/// Compares powers at some of the samples; where no motor moves, there is nothing to compare. Needs the levels.
std::vector<MechanismPower> powersOf(const MechanismEvidence& evidence, const Deadline& deadline);

/// Runs the replays; `efforts` are those of the subject at any instant.
void replayMechanism(const std::function<MotorEfforts(double t)>& efforts, const Deadline& deadline,
                     MechanismEvidence& evidence);

/// Efforts of changed machines: `invariance.*`.
std::vector<MechanismInvariance> askInvariances(const MechanismScenario& scenario, const LoopMotion& motion);

/// The checks of the catalogue that the evidence holds.
std::vector<Check> judgeMechanism(const MechanismEvidence& evidence, const MechanismSubject& subject);

/// How large wrong efforts are, and what the scenario can leave out so that they are right by all formulations. Returns
/// nullopt if no effort is beyond its limit. Needs the result's deviation and cause.
std::optional<FailureSize> failureSize(const MechanismEvidence& evidence,
                                       const std::vector<MakeMechanismEngine>& makers, const ValidationResult& result);

/// Returns the machine turned, moved, in other units, relabelled or heavier; also what turns its efforts back.
struct ChangedMechanism {
  std::string check;
  MechanismParameters machine;
  MotorEfforts back;         ///< factor of each effort
  MotorEfforts coordinates;  ///< factor of each motor's coordinate
  double time = 1;           ///< factor of time
  bool reversed = false;
  std::vector<std::size_t> motor_of;  ///< the new place of each motor
};
std::vector<ChangedMechanism> changedMechanisms(const Mechanism& mechanism);

}  // namespace ursula

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/mechanism_scenario.h"
#include "model/scenario.h"
#include "nocsolver/noc/noc.h"
#include "parts/engines/loop_engine.h"

namespace ursula {

/// Efforts by one recipe, compared with the NOC's.
struct RecipeResult {
  Recipe recipe = Recipe::exact;
  double error = 0;         ///< largest deviation divided by the motion's largest effort in that motor's unit
  double at = 0;            ///< instant of that deviation, s
  int motor = 0;            ///< its motor, 0-based
  double deviation = 0;     ///< that deviation, N·m or N
  double power = 0;         ///< largest deviation of the motors' power divided by their largest power; NaN at rest
  double seconds = 0;       ///< median measured time of a pose
  std::string refused;      ///< reason why the engine has no such answer; the rest is empty then
  Eigen::MatrixXd efforts;  ///< instants × motors
};

/// The engine moves the closed loop under the NOC's efforts. Gap, sag and away are the largest over that time.
struct TimeSteppingResult {
  Rigidity rigidity;
  int steps = 0;        ///< steps taken
  double gap = 0;       ///< gap of the loops, m
  double sag = 0;       ///< deviation of the platform's joints at the motors' coordinates, m
  double away = 0;      ///< deviation of P from the commanded motion, m; it includes unstable growth
  double energy = 0;    ///< gained energy at the end minus all work done on the machine, J
  double work = 0;      ///< absolute work of motors, friction and load, summed over the steps, J
  double seconds = 0;   ///< median measured time of a step
  std::string gave_up;  ///< the engine's message; empty if it did not give up
};

struct EngineResult {
  const LoopEngineKind* kind = nullptr;
  std::string version;
  std::string refused;  ///< reason why the engine refuses this machine
  bool of_mechanism = false;
  std::vector<std::string> cut;             ///< joints at which its tree is cut; of a mechanism
  double gap = 0;                           ///< largest gap of the loops at the poses asked for, m
  std::vector<RecipeResult> recipes;        ///< the exact one first
  std::vector<TimeSteppingResult> in_time;  ///< the default rigidity first

  const RecipeResult& of(Recipe recipe) const;
};

struct SideBySide {
  struct Motor {
    std::string name, unit;  ///< "crank_hinge", "N m"
    double largest = 0;      ///< effort
  };

  std::string scenario;
  std::string model;  ///< the file of a mechanism; the engines build its parameters, not the file
  int instants = 0;
  std::vector<Motor> motors;
  std::vector<double> t;    ///< s
  Eigen::MatrixXd efforts;  ///< of the NOC, instants × motors
  double largest_effort = 0;
  std::string unit;          ///< "N m", or "N" if all motors slide
  double largest_force = 0;  ///< largest force beside the largest torque, N; 0 unless there are motors of both kinds
  double moved = 0;          ///< duration of the stepped motion from its start, s
  std::vector<EngineResult> engines;
  std::vector<const LoopEngineKind*> missing;  ///< engines that this build lacks
};

struct SideBySideOptions {
  int samples = 101;                           ///< instants at which efforts are asked for, >= 2
  double moved = 0.5;                          ///< duration of the stepped motion, s; at most the whole motion
  std::vector<const LoopEngineKind*> engines;  ///< engines to ask; empty for all in this build
  std::function<void(double share, const std::string&)> on_progress;  ///< progress callback; may be empty
};

/// Asks each engine by each recipe along the motion, then lets it step the loop. Throws PoseError if the motion cannot
/// be made, and std::runtime_error if it needs no efforts. An engine that refuses the machine becomes an entry with the
/// reason.
SideBySide engineSideBySide(const Scenario& scenario, const SideBySideOptions& options);
/// Asks for a mechanism. Throws LoopError if the loops cannot follow, ScenarioError for a wrong number of motors.
SideBySide engineSideBySide(const MechanismScenario& scenario, const SideBySideOptions& options);

/// Accepts "mujoco" and "MuJoCo"; returns null for an unknown name.
const LoopEngineKind* loopEngineNamed(const std::string& name);

/// Says how to use the engine and how wrong its obvious call is, from the numbers found.
std::string sentence(const EngineResult& engine);
/// Sums up all engines.
std::string sentence(const SideBySide& found);
std::string sentenceOfMissing(const LoopEngineKind& kind);
/// Returns "12 %", "230 times", or the share itself if it is below a millionth.
std::string errorText(double error);
/// Returns "203 N", or "4.14 kN·m and 812 N" for motors of both kinds.
std::string largestText(const SideBySide& found);
/// Returns the recipe in words, "loops left open".
const char* inWords(Recipe recipe);
/// Returns the motor and instant of the largest deviation: "crank by 0.3 N·m at 0.4 s".
std::string worstText(const RecipeResult& found, const SideBySide& in);
/// Returns `before` and where the engine's tree is cut; empty for a manipulator.
std::string cutText(const EngineResult& engine, const char* before);
/// Returns what there is to say about a mechanism's motors and file.
std::vector<std::string> remarks(const SideBySide& found);
/// Returns how to be right with the engine, as an imperative.
const char* exactCall(const EngineResult& engine);

/// Returns text for a terminal.
std::string sideBySideText(const SideBySide& found);
std::string sideBySideJson(const SideBySide& found);
/// Returns a row for each recipe and each rigidity, with blank cells for quantities that do not apply.
std::string sideBySideCsv(const SideBySide& found);
/// Returns the efforts of the NOC, then those of each engine's recipes: tau_1_Nm, mujoco_exact_tau_1_Nm.
std::string effortsCsv(const SideBySide& found);
/// Returns one page that needs no network.
std::string sideBySideHtml(const SideBySide& found);

/// The reference for every engine: the paper's method as a validation judges it.
class EngineReference {
 public:
  struct Here {
    Motion<double> motion;
    Vector6d efforts, q_dot;  ///< motors' efforts and rates, in their order
  };

  explicit EngineReference(const Scenario& scenario);

  Here at(double t);
  /// Returns the machine's characteristic length, m.
  double length() const { return noc_.machine().length; }

 private:
  const Scenario& scenario_;
  Noc<double> noc_;
  NocWorkspace<double> work_;
};

}  // namespace ursula

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engines/loop_engine.h"
#include "model/scenario.h"

namespace ursula {

/// Efforts by one recipe, held against the NOC's.
struct RecipeFound {
  Recipe recipe = Recipe::exact;
  double error = 0;    ///< the largest deviation, over the largest effort of the motion with that motor's unit
  double at = 0;       ///< where that is, s
  int motor = 0;       ///< and on which motor, 0-based
  double power = 0;    ///< the largest deviation of the motors' power, over their largest power; NaN at rest
  double seconds = 0;  ///< a pose, median; a measurement
};

/// The closed loop moved by the engine under the NOC's efforts. Gap, sag and away are the largest of that time.
struct InTimeFound {
  Rigidity rigidity;
  int steps = 0;        ///< taken
  double gap = 0;       ///< of the loops, m
  double sag = 0;       ///< of the platform's joints, with the motors where they are, m
  double away = 0;      ///< of P from the commanded motion, m: growth of what is unstable included
  double energy = 0;    ///< what the machine has gained at the end beside all work done on it, J
  double work = 0;      ///< by motors, friction and load, taken as positive, J
  double seconds = 0;   ///< a step, median; a measurement
  std::string gave_up;  ///< the engine's words where it did
};

struct EngineFound {
  const LoopEngineKind* kind = nullptr;
  std::string version;
  std::string refused;               ///< why it cannot be asked about this machine
  double gap = 0;                    ///< of the loops at the poses asked for, m
  std::vector<RecipeFound> recipes;  ///< the exact one first
  std::vector<InTimeFound> in_time;  ///< the default rigidity first

  const RecipeFound& of(Recipe recipe) const;
};

struct SideBySide {
  std::string scenario;
  int instants = 0;
  double largest_effort = 0;
  std::string unit;          ///< "N m", or "N" if all motors slide
  double largest_force = 0;  ///< N, beside a largest torque; 0 unless there are motors of both kinds
  double moved = 0;          ///< of the motion in time, from its start, s
  std::vector<EngineFound> engines;
  std::vector<const LoopEngineKind*> missing;  ///< in this build
};

struct SideBySideOptions {
  int samples = 101;                                           ///< instants at which efforts are asked for, >= 2
  double moved = 0.5;                                          ///< s, or the whole motion where that is shorter
  std::vector<const LoopEngineKind*> engines;                  ///< empty: all that this build has
  std::function<void(double share, const std::string&)> told;  ///< of progress; may be empty
};

/// Asks each engine by each recipe along the motion, then has it move the loop. Throws PoseError where the motion
/// cannot be made, std::runtime_error where it needs no efforts. An engine that refuses the machine is an entry that
/// says so.
SideBySide engineSideBySide(const Scenario& scenario, const SideBySideOptions& options);

/// "mujoco" or "MuJoCo"; null where there is none.
const LoopEngineKind* loopEngineNamed(const std::string& name);

/// What to do with the engine and how wrong its obvious call is, of the numbers found.
std::string sentence(const EngineFound& engine);
/// Over all engines.
std::string sentence(const SideBySide& found);
std::string sentenceOfMissing(const LoopEngineKind& kind);
/// Returns "12 %", or the share itself if it is below a millionth.
std::string errorText(double error);
/// Returns "203 N", or "4.14 kN·m and 812 N" for motors of both kinds.
std::string largestText(const SideBySide& found);
/// "loops left open".
const char* inWords(Recipe recipe);

/// For a terminal.
std::string sideBySideText(const SideBySide& found);
std::string sideBySideJson(const SideBySide& found);
/// A row for each recipe and each rigidity; blank where a quantity does not apply.
std::string sideBySideCsv(const SideBySide& found);
/// One page that needs no network.
std::string sideBySideHtml(const SideBySide& found);

}  // namespace ursula

#pragma once

#include <memory>

#include "model/joint_variables.h"
#include "model/load.h"
#include "model/manipulator.h"
#include "model/motion.h"

namespace ursula {

/// A further formulation of the torques, beside those of the solver and of Simbody's loop with six balls. It is another
/// engine or method with its own geometry, built from raw parameters. Not thread-safe; each thread needs its own.
class Engine {
 public:
  Engine() = default;
  virtual ~Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Efforts of the motors for the motion, N·m or N, conjugate to the rates of their coordinates. Throws
  /// std::domain_error if a leg cannot reach.
  virtual Vector6d inverseDynamics(const Motion<double>& motion) = 0;
};

using MakeEngine = std::unique_ptr<Engine>(const Manipulator& manipulator, std::shared_ptr<const Load> load);

inline bool alwaysAvailable() { return true; }

/// Everything that the validation knows of a further formulation: a row of furtherEngines().
struct EngineKind {
  const char* check;    ///< name of the check that compares the subject with it
  const char* name;     ///< in a list of formulations: "MuJoCo"
  const char* made_of;  ///< follows "torques against": "MuJoCo's trees, closed by Lagrange multipliers"
  bool (*available)();  ///< whether this build has it
  MakeEngine* make;
};

}  // namespace ursula

#pragma once

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

}  // namespace ursula

#pragma once

#include <functional>
#include <vector>

#include "parts/engines/side_by_side/side_by_side.h"
#include "validation/mechanism/validate_mechanism.h"

namespace ursula {

/// A machine that an engine moves in time, and what it should do.
struct Moving {
  struct State : MechanismCalls::Moved {
    double sag = 0;
  };
  std::function<State()> start;
  std::function<void(const Eigen::VectorXd& efforts)> step;
  std::function<State()> read;
  std::function<Eigen::VectorXd(double t)> efforts;
  std::function<Vector3d(double t)> position;
  double length = 1;
};

/// Moves a machine for a time; `make` may throw, which becomes the reason why the engine gave up.
TimeSteppingResult moveInTime(const Rigidity& rigidity, double moved, const std::function<Moving()>& make);

// Both keep their arguments but the rigidity.
Moving movingManipulator(const LoopEngine& engine, const Rigidity& rigidity, EngineReference& reference);
Moving movingMechanism(MechanismCalls& engine, const Rigidity& rigidity, const MechanismAlong& along);

/// Reorders its copy of the values. Returns 0 for none.
double median(std::vector<double> values);

}  // namespace ursula

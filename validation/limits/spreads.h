#pragma once

#include <vector>

#include "model/manipulator.h"
#include "validation/limits/conditioning.h"
#include "validation/limits/engine_view.h"
#include "validation/limits/solver_rounding.h"

namespace ursula {

/// Rates and accelerations of the driven coordinates.
struct DrivenMotion {
  Vector6d q_dot, q_ddot;
};

/// The largest differences of the NOC's answers, each in its quantity's unit. `driven` is Simbody's; `to_efforts` is
/// T_PᵀM_P: efforts per acceleration of the platform. `length` is the machine's. An engine's level also contains the
/// solver's spread.
RoundingLevels spreadOfSolver(const Manipulator& machine, const std::vector<SolverView>& views,
                              const DrivenMotion& driven, const Matrix6d& to_efforts, double length);

/// The largest differences of the engines' answers. `solver` is the NOC's view of the given numbers.
RoundingLevels spreadOfEngines(const Manipulator& machine, const std::vector<EngineView>& views,
                               const SolverView& solver, const Matrix6d& to_efforts, double length);

}  // namespace ursula

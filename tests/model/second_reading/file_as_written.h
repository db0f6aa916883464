#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/load.h"
#include "model/manipulator.h"
#include "model/scenario.h"
#include "model/trajectories/trajectories.h"
#include "model/trajectory.h"

namespace ursula {

/// `[trajectory]` as its file has it; members of other kinds keep their defaults.
struct TrajectoryAsWritten {
  std::string kind;
  double duration = 0;           ///< of helix and hold
  HelixParameters helix;         ///< of a helix
  std::vector<TimedPose> poses;  ///< of waypoints, samples; the one of hold
};

/// `[load]` as its file has it.
struct LoadAsWritten {
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero(), point = Vector3d::Zero();
  std::string frame;
  bool tabulated = false;
  std::vector<TimedWrench> rows;
};

struct FileAsWritten {
  ManipulatorParameters machine;
  TrajectoryAsWritten trajectory;
  std::optional<LoadAsWritten> load;
};

/// A scenario's text read a second time, by code that shares with model/scenario*.cpp, model/toml_reader.h and
/// base/csv.h nothing but toml++. It refuses nothing; a number that is missing or of another type is NaN, which equals
/// none.
FileAsWritten asWritten(const Scenario& scenario);

}  // namespace ursula
